// Classes of light paths, by Heckbert's letters (1990): L light, D a scattering that is not (near-)specular, S one that is, E the eye.
//
//   direct    L E and L D S* E      straight from a light, or scattered once
//   caustic   L S+ D S* E           gathered by mirrors and glass on the first surface that is neither
//   indirect  L (S|D)* D S* D S* E  the rest
//   specular  L S+ E                a light, seen in mirrors or through glass
// where "first" is as seen from the eye. Every path is in one of them: they add up to the picture.
#pragma once

#include "spectrum/spectrum.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

enum class LightClass : std::uint8_t { Direct, Caustic, Indirect, Specular };

/// Radiance by class.
struct SeenLight {
    std::array<Spectrum, 4> of;
    Spectrum& operator[](LightClass c) { return of[static_cast<std::size_t>(c)]; }
    [[nodiscard]] Spectrum total() const { return of[0] + of[1] + of[2] + of[3]; }
    SeenLight& operator*=(float s) {
        for (Spectrum& light : of) light *= s;
        return *this;
    }
    SeenLight& operator+=(SeenLight const& b) {
        for (std::size_t i = 0; i < of.size(); ++i) of[i] += b.of[i];
        return *this;
    }
};

/// What has happened to a path so far, from the end where it began.
class PathClass {
  public:
    void scatter(bool specular) {
        if (first_) began_specular_ = specular;
        first_ = false;
        specular_since_ = specular;
        if (!specular && diffuse_ < 2) ++diffuse_;
    }
    /// The class of a path from the eye that ends on a light now.
    [[nodiscard]] LightClass ends_on_light() const {
        if (diffuse_ == 0) return specular_since_ ? LightClass::Specular : LightClass::Direct;
        if (diffuse_ == 1) return specular_since_ ? LightClass::Caustic : LightClass::Direct;
        return LightClass::Indirect;
    }
    /// … that scatters once more first.
    [[nodiscard]] LightClass ends_after(bool specular) const {
        PathClass next = *this;
        next.scatter(specular);
        return next.ends_on_light();
    }
    /// The class of a path from a light that scatters once more, and is seen there by the eye.
    [[nodiscard]] LightClass seen_after(bool specular) const {
        PathClass whole = *this;
        whole.scatter(specular);
        if (whole.diffuse_ == 0) return LightClass::Specular;
        if (whole.diffuse_ > 1) return LightClass::Indirect;
        return whole.began_specular_ ? LightClass::Caustic : LightClass::Direct;
    }
    /// No D so far: what a path from the eye sees in mirrors, or one from a light that makes caustics.
    [[nodiscard]] bool all_specular() const { return diffuse_ == 0; }
    /// The first scattering was S.
    [[nodiscard]] bool began_specular() const { return began_specular_; }
    /// The last scattering was the first D.
    [[nodiscard]] bool just_landed() const { return diffuse_ == 1 && !specular_since_; }
    /// The last scattering was S.
    [[nodiscard]] bool specular_since() const { return specular_since_; }

  private:
    std::uint8_t diffuse_ = 0;
    bool specular_since_ = false;
    bool first_ = true, began_specular_ = false;
};

}  // namespace nephroid
