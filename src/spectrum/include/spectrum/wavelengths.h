// What the four lanes of a Spectrum mean along one path.
//
// Spectral: four wavelengths in nm, drawn together from one number (hero wavelengths, Wilkie et al. 2014), with the density
// p(l) = sech^2(a (l - 538)) of visible light (Radziszewski et al. 2009; PBRT 4th ed., 4.5.4). Each lane is a stratified
// sample of the same density, and keeps its own pdf (1/nm).
// Rgb: linear sRGB in lanes 0..2; the pdfs are 1 and nothing is wavelength-dependent.
#pragma once

#include "spectrum/spectrum.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nephroid {

enum class ColorMode : std::uint8_t { Rgb, Spectral };

inline constexpr float kLambdaMin = 360.0f;
inline constexpr float kLambdaMax = 830.0f;

/// Density of visible_wavelength over [360, 830] nm, 1/nm.
inline float visible_wavelength_pdf(float lambda) {
    if (lambda < kLambdaMin || lambda > kLambdaMax) return 0.0f;
    return 0.0039398042f / sqr(std::cosh(0.0072f * (lambda - 538.0f)));
}
/// Inverse of the cumulative distribution: u in [0,1) to nm.
inline float visible_wavelength(float u) {
    return 538.0f - 138.888889f * std::atanh(0.85691062f - 1.82750197f * u);
}

/// visible_wavelength by cubics between 513 nodes with the function's own slopes, right to 0.001 nm: four inverse hyperbolic
/// tangents were a tenth of a diffuse path.
class WavelengthTable {
  public:
    WavelengthTable();
    [[nodiscard]] float operator()(float u) const {
        float const x = u * static_cast<float>(kCells);
        int const i = static_cast<int>(x) < kCells ? static_cast<int>(x) : kCells - 1;
        float const t = x - static_cast<float>(i);
        Node const& a = nodes_[static_cast<std::size_t>(i)];
        Node const& b = nodes_[static_cast<std::size_t>(i) + 1];
        // Hermite's form, in powers of t.
        float const step = b.lambda - a.lambda;
        float const c2 = 3.0f * step - 2.0f * a.slope - b.slope;
        float const c3 = a.slope + b.slope - 2.0f * step;
        return a.lambda + t * (a.slope + t * (c2 + t * c3));
    }

  private:
    static constexpr int kCells = 512;
    struct Node {
        float lambda = 0, slope = 0;  // nm, nm per cell
    };
    std::array<Node, kCells + 1> nodes_;
};
extern WavelengthTable const kWavelengthTable;

class Wavelengths {
  public:
    static Wavelengths rgb() { return {}; }
    static Wavelengths spectral(float u) {
        Wavelengths w;
        w.mode_ = ColorMode::Spectral;
        for (int i = 0; i < 4; ++i) {
            float ui = u + 0.25f * static_cast<float>(i);
            if (ui >= 1.0f) ui -= 1.0f;
            w.lambda_.set(i, clamp(kWavelengthTable(ui), kLambdaMin, kLambdaMax));
            // The density at that wavelength without a hyperbolic cosine: sech^2(atanh t) = 1 - t^2.
            float const t = 0.85691062f - 1.82750197f * ui;
            w.pdf_.set(i, 0.0039398042f * (1.0f - t * t));
        }
        return w;
    }

    [[nodiscard]] ColorMode mode() const { return mode_; }
    [[nodiscard]] bool is_rgb() const { return mode_ == ColorMode::Rgb; }
    /// nm; meaningless in rgb mode.
    [[nodiscard]] float lambda(int i) const { return lambda_[i]; }
    [[nodiscard]] Spectrum pdf() const { return pdf_; }
    [[nodiscard]] bool hero_only() const { return hero_only_; }

    /// After a wavelength-dependent direction only the hero lane can go on: the others' weight becomes 0 and the hero stands
    /// for all four (PBRT 4th ed., TerminateSecondary).
    void keep_hero() {
        if (hero_only_ || is_rgb()) return;
        hero_only_ = true;
        pdf_ = Spectrum(pdf_[0] / 4.0f, 0, 0, 0);
    }

    /// radiance lanes / pdf, 0 where the pdf is 0: what the film's sensor averages.
    [[nodiscard]] Spectrum weigh(Spectrum radiance) const {
        Spectrum r;
        for (int i = 0; i < 4; ++i) r.set(i, pdf_[i] > 0.0f ? radiance[i] / pdf_[i] : 0.0f);
        return r;
    }

  private:
    Spectrum lambda_;
    Spectrum pdf_{1.0f};
    ColorMode mode_ = ColorMode::Rgb;
    bool hero_only_ = false;
};

}  // namespace nephroid
