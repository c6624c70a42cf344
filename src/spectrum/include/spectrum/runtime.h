// Spectral distributions, ready for a pass: a small value that gives four lanes for a path's wavelengths.
#pragma once

#include "math/vec.h"
#include "spectrum/spd.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

#include <array>
#include <cstdint>
#include <deque>

namespace nephroid {

inline constexpr int kDenseCount = 471;  // 360 … 830 nm, each nm
using DenseTable = std::array<float, kDenseCount>;

/// c0 l^2 + c1 l + c2 through a sigmoid: a smooth reflectance in [0,1] (Jakob & Hanika 2019).
struct SigmoidPolynomial {
    float c0 = 0, c1 = 0, c2 = 0;

    [[nodiscard]] float at(float lambda) const {
        float const x = (c0 * lambda + c1) * lambda + c2;
        // 1/2 + x / (2 sqrt(1+x^2)), with its limits for an infinite c2 (rgb 0 and 1).
        if (!(std::abs(x) < 1e18f)) return x > 0.0f ? 1.0f : 0.0f;
        return 0.5f + x / (2.0f * std::sqrt(1.0f + x * x));
    }
    [[nodiscard]] Spectrum operator()(Wavelengths const& w) const {
        return {at(w.lambda(0)), at(w.lambda(1)), at(w.lambda(2)), at(w.lambda(3))};
    }
};

/// A compiled distribution. Cheap to copy; `table` belongs to the SpectrumStore that compiled it.
class RuntimeSpectrum {
  public:
    RuntimeSpectrum() = default;  // black

    [[nodiscard]] Spectrum sample(Wavelengths const& w) const {
        if (w.is_rgb()) return {rgb_.x, rgb_.y, rgb_.z, 0.0f};
        switch (kind_) {
            case Kind::Constant:
                return Spectrum(scale_);
            case Kind::Sigmoid:
                return sigmoid_(w) * scale_;
            case Kind::Dense:
                return dense(w) * scale_;
            case Kind::SigmoidTimesDense:
                return sigmoid_(w) * dense(w) * scale_;
        }
        return {};
    }
    /// Does the value change with the wavelength? (A dispersive index of refraction makes paths keep their hero lane only.)
    [[nodiscard]] bool is_constant() const { return kind_ == Kind::Constant; }
    [[nodiscard]] bool is_black() const;
    [[nodiscard]] Vec3 rgb() const { return rgb_; }
    /// The largest value over the visible wavelengths (in either mode).
    [[nodiscard]] float max_value() const;
    [[nodiscard]] RuntimeSpectrum scaled(float s) const;
    /// Slow: value at one wavelength.
    [[nodiscard]] float at(float lambda) const;

  private:
    friend class SpectrumStore;
    enum class Kind : std::uint8_t { Constant, Sigmoid, Dense, SigmoidTimesDense };

    [[nodiscard]] Spectrum dense(Wavelengths const& w) const {
        Spectrum r;
        for (int i = 0; i < 4; ++i) {
            float const x = w.lambda(i) - kLambdaMin;
            int j = static_cast<int>(x);
            j = j < 0 ? 0 : (j > kDenseCount - 2 ? kDenseCount - 2 : j);
            float const t = x - static_cast<float>(j);
            float const a = (*table_)[static_cast<std::size_t>(j)];
            float const b = (*table_)[static_cast<std::size_t>(j) + 1];
            r.set(i, a + t * (b - a));
        }
        return r;
    }

    DenseTable const* table_ = nullptr;
    SigmoidPolynomial sigmoid_;
    float scale_ = 0;
    Vec3 rgb_{0, 0, 0};
    Kind kind_ = Kind::Constant;
};

/// Compiles descriptions and owns their tables (addresses stay valid while the store lives).
class SpectrumStore {
  public:
    /// Throws Error(Input) for an unknown name, NaN, wavelengths that do not increase, or a negative temperature.
    RuntimeSpectrum compile(Spd const& spd, SpectrumRole role);
    [[nodiscard]] std::size_t bytes() const { return tables_.size() * sizeof(DenseTable); }

  private:
    /// Equal tables are kept once.
    DenseTable const* keep(DenseTable const& t);

    std::deque<DenseTable> tables_;
};

}  // namespace nephroid
