// Photons: packets of power that light paths leave where they land (Jensen 1996).
#pragma once

#include "math/frame.h"
#include "math/vec.h"
#include "spectrum/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace nephroid {

/// A photon as it lands, in full.
struct PhotonRecord {
    Vec3 p{0, 0, 0};
    Vec3 wi{0, 0, 1};  // unit, back to where it came from
    Vec3 n{0, 0, 1};   // of the surface, geometric, unit, on the side of wi
    Spectrum power;    // W (per nm in spectral mode), already divided by the paths emitted in the pass
    std::uint32_t bounces = 0;  // scatterings on the way: 0 is direct light
    std::uint32_t light = 0;    // as LightRay::light
    bool caustic = false;       // all of them specular, and at least one
    bool hero_only = false;     // the power is in the hero lane alone, which stands for all four
};

/// A unit vector in 2 B bits: the octahedron unfolded (Cigolle et al. 2014).
template <class Bits>
std::array<Bits, 2> pack_direction(Vec3 v) {
    constexpr auto kMost = static_cast<float>(static_cast<Bits>(~Bits{0}));
    float const s = 1.0f / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
    float x = v.x * s, y = v.y * s;
    if (v.z < 0.0f) {
        float const fx = (1.0f - std::abs(y)) * (x < 0.0f ? -1.0f : 1.0f);
        y = (1.0f - std::abs(x)) * (y < 0.0f ? -1.0f : 1.0f);
        x = fx;
    }
    auto const pack = [&](float a) {
        return static_cast<Bits>(std::floor((a * 0.5f + 0.5f) * kMost + 0.5f));
    };
    return {pack(x), pack(y)};
}
/// … and back, of no particular length.
template <class Bits>
Vec3 unfold_direction(std::array<Bits, 2> const& packed) {
    constexpr float kStep = 2.0f / static_cast<float>(static_cast<Bits>(~Bits{0}));
    float x = static_cast<float>(packed[0]) * kStep - 1.0f, y = static_cast<float>(packed[1]) * kStep - 1.0f;
    float const z = 1.0f - std::abs(x) - std::abs(y);
    if (z < 0.0f) {
        float const fx = (1.0f - std::abs(y)) * (x < 0.0f ? -1.0f : 1.0f);
        y = (1.0f - std::abs(x)) * (y < 0.0f ? -1.0f : 1.0f);
        x = fx;
    }
    return {x, y, z};
}
template <class Bits>
Vec3 unpack_direction(std::array<Bits, 2> const& packed) {
    return normalize(unfold_direction(packed));
}

/// A photon as maps keep it, 32 bytes. Directions are right to 5e-5, normals to a degree; the largest lane of the power to
/// rounding, the others to 1e-5 of it.
class Photon {
  public:
    Photon() = default;
    explicit Photon(PhotonRecord const& r)
        : p_(r.p),
          wi_(pack_direction<std::uint16_t>(r.wi)),
          n_(pack_direction<std::uint8_t>(r.n)),
          bounces_(static_cast<std::uint8_t>(std::min<std::uint32_t>(r.bounces, 255))),
          flags_(static_cast<std::uint8_t>((r.caustic ? kCaustic : 0) | (r.hero_only ? kHeroOnly : 0))) {
        float const most = r.power.max();
        unit_ = most / kRatio;
        if (most > 0.0f)
            for (int i = 0; i < 4; ++i)
                ratio_[static_cast<std::size_t>(i)] =
                    static_cast<std::uint16_t>(std::floor(r.power[i] / most * kRatio + 0.5f));
    }

    [[nodiscard]] Vec3 p() const { return p_; }
    [[nodiscard]] Vec3 wi() const { return unpack_direction(wi_); }
    [[nodiscard]] Vec3 n() const { return unpack_direction(n_); }
    /// Along n, not a unit vector: less work where only the angle to it matters.
    [[nodiscard]] Vec3 along_n() const { return unfold_direction(n_); }
    /// n as it is kept: equal for photons of one normal.
    [[nodiscard]] std::uint32_t packed_n() const { return static_cast<std::uint32_t>(n_[0]) << 8 | n_[1]; }
    [[nodiscard]] Spectrum power() const {
        // All lanes at once, which compilers do not see by themselves.
        typedef std::uint16_t Ratios __attribute__((vector_size(8)));
        Ratios ratios;
        std::memcpy(&ratios, ratio_.data(), sizeof(ratios));
        return unit_ * Spectrum(__builtin_convertvector(ratios, Spectrum::Lanes));
    }
    [[nodiscard]] std::uint32_t bounces() const { return bounces_; }
    [[nodiscard]] bool caustic() const { return (flags_ & kCaustic) != 0; }
    [[nodiscard]] bool hero_only() const { return (flags_ & kHeroOnly) != 0; }

  private:
    static constexpr float kRatio = 65535.0f;
    static constexpr std::uint8_t kCaustic = 1, kHeroOnly = 2;

    Vec3 p_{0, 0, 0};
    float unit_ = 0;  // power = unit * ratio
    std::array<std::uint16_t, 4> ratio_{};
    std::array<std::uint16_t, 2> wi_{};
    std::array<std::uint8_t, 2> n_{};
    std::uint8_t bounces_ = 0, flags_ = 0;
};
static_assert(sizeof(Photon) == 32);

}  // namespace nephroid
