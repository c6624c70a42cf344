// A piecewise-linear density over [0,1] that lives on the stack: for densities that are known at a few points only, and only when
// they are wanted. Drawn by inversion, and the density it answers is that of what it draws.
#pragma once

#include "sampling/warp.h"

#include <array>

namespace nephroid {

template <int N>
class TabulatedDensity {
  public:
    TabulatedDensity() = default;
    /// `nodes`: values >= 0, up to a factor, at 0, 1/N, ..., 1.
    explicit TabulatedDensity(std::array<float, N + 1> const& nodes) : f_(nodes) {
        for (std::size_t i = 0; i < kCells; ++i) cdf_[i + 1] = cdf_[i] + mass(i);
    }

    /// Is it 0 everywhere? Then nothing can be drawn.
    [[nodiscard]] bool empty() const { return !(cdf_[kCells] > 0); }
    /// The trapezoid sum, of the nodes as they were given.
    [[nodiscard]] float integral() const { return static_cast<float>(cdf_[kCells] / (2.0 * N)); }

    /// x in [0, 1), where the density is positive.
    [[nodiscard]] float sample(float u) const {
        double const target = static_cast<double>(u) * cdf_[kCells];
        std::size_t i = 0;
        for (std::size_t k = 1; k < kCells; ++k) i += cdf_[k] <= target ? 1 : 0;
        while (i > 0 && mass(i) == 0) --i;  // the last cells may be empty
        auto const rest = static_cast<float>((target - cdf_[i]) / mass(i));
        // sample_linear squares its numbers: shares of the cell cannot underflow.
        auto const a = static_cast<float>(f_[i] / mass(i));
        float t = sample_linear(clamp(rest, 0.0f, kOneMinusEpsilon), a, 1.0f - a);
        // Not on a node of density 0, not even when the sum below is rounded.
        if (f_[i] == 0.0f) t = max(t, kStep);
        if (f_[i + 1] == 0.0f) t = min(t, 1.0f - kStep);
        return min((static_cast<float>(i) + t) * (1.0f / N), kOneMinusEpsilon);
    }
    [[nodiscard]] float pdf(float x) const {
        if (!(x >= 0.0f && x <= 1.0f) || empty()) return 0.0f;
        Place const p = place(x);
        return static_cast<float>(2 * N * lerp(p.t, f_[p.cell], f_[p.cell + 1]) / cdf_[kCells]);
    }
    /// The u of which sample() makes x.
    [[nodiscard]] float invert(float x) const {
        Place const p = place(x);
        double const part =
            static_cast<double>(invert_linear(p.t, f_[p.cell], f_[p.cell + 1])) * mass(p.cell);
        return clamp(static_cast<float>((cdf_[p.cell] + part) / cdf_[kCells]), 0.0f, kOneMinusEpsilon);
    }

  private:
    static constexpr std::size_t kCells = N;
    static constexpr float kStep = N * 0x1p-23f;
    struct Place {
        std::size_t cell;
        float t;
    };
    static Place place(float x) {
        float const at = clamp(x, 0.0f, 1.0f) * N;
        auto const i = at < N - 1 ? static_cast<std::size_t>(at) : kCells - 1;
        return {i, min(at - static_cast<float>(i), 1.0f)};
    }
    [[nodiscard]] double mass(std::size_t i) const {
        return static_cast<double>(f_[i]) + static_cast<double>(f_[i + 1]);
    }

    std::array<float, N + 1> f_{};
    std::array<double, N + 1> cdf_{};  // of twice the cells' masses, in units of 1/N
};

}  // namespace nephroid
