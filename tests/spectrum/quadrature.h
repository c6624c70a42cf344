// Integrals over all wavelengths as the renderer estimates them, on an even grid of u instead of random numbers.
#pragma once

#include "spectrum/color.h"

#include <cstdint>

namespace nephroid {

/// Mean of f(Wavelengths) -> Vec3 over u in [0,1).
template <class F>
Vec3 mean_over_wavelengths(F const& f, int n = 1000) {
    double sum[3] = {0, 0, 0};
    for (int i = 0; i < n; ++i) {
        // The four lanes repeat each quarter.
        float const u = 0.25f * (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
        Vec3 const v = f(Wavelengths::spectral(u));
        for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(v[c]);
    }
    return {static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n), static_cast<float>(sum[2] / n)};
}

/// Colours that are the same in each run.
class Colors {
  public:
    float next() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<float>(state_ >> 40) * 0x1p-24f;
    }
    Vec3 color() {
        float const r = next(), g = next();
        return {r, g, next()};
    }

  private:
    std::uint64_t state_ = 7;
};

}  // namespace nephroid
