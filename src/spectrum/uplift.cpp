#include "spectrum/uplift.h"

#include "uplift_format.h"

#include <algorithm>
#include <array>

// tools/uplift_table's output, put here by the build (cmake/built_table.cmake).
extern "C" {
extern float const nephroid_uplift_table[];
}

namespace nephroid {

namespace {

/// c0 t^2 + c1 t + c2 with t = (l - 360) / 470, rewritten for l in nm.
SigmoidPolynomial in_nanometres(double c0, double c1, double c2) {
    constexpr double start = 360;
    constexpr double span = 470;
    double const a = c0 / (span * span);
    double const b = c1 / span;
    return {static_cast<float>(a), static_cast<float>(b - 2 * a * start),
            static_cast<float>(c2 + a * start * start - b * start)};
}

std::array<float, kUpliftSize> const& nodes() {
    static std::array<float, kUpliftSize> const n = [] {
        std::array<float, kUpliftSize> v{};
        for (int i = 0; i < kUpliftSize; ++i)
            v[static_cast<std::size_t>(i)] = static_cast<float>(uplift_node(i));
        return v;
    }();
    return n;
}

}  // namespace

SigmoidPolynomial srgb_to_sigmoid(Vec3 rgb) {
    for (int i = 0; i < 3; ++i) rgb[i] = clamp(rgb[i], 0.0f, 1.0f);
    if (rgb.x == rgb.y && rgb.y == rgb.z) {
        // A constant: sigmoid(x) = r  =>  x = (r - 1/2) / sqrt(r (1 - r)); infinite at 0 and 1.
        float const r = rgb.x;
        return {0, 0, (r - 0.5f) / std::sqrt(r * (1.0f - r))};
    }
    int const largest = rgb.x > rgb.y ? (rgb.x > rgb.z ? 0 : 2) : (rgb.y > rgb.z ? 1 : 2);
    float const z = rgb[largest];
    float const x = rgb[(largest + 1) % 3] / z * static_cast<float>(kUpliftSize - 1);
    float const y = rgb[(largest + 2) % 3] / z * static_cast<float>(kUpliftSize - 1);
    auto const& n = nodes();
    int const xi = std::min(static_cast<int>(x), kUpliftSize - 2);
    int const yi = std::min(static_cast<int>(y), kUpliftSize - 2);
    int const zi = std::clamp(static_cast<int>(std::upper_bound(n.begin(), n.end(), z) - n.begin()) - 1, 0,
                              kUpliftSize - 2);
    float const dx = x - static_cast<float>(xi);
    float const dy = y - static_cast<float>(yi);
    auto const zu = static_cast<std::size_t>(zi);
    float const dz = (z - n[zu]) / (n[zu + 1] - n[zu]);
    double c[3];
    for (std::size_t k = 0; k < 3; ++k) {
        auto const at = [&](int a, int b, int d) {
            auto const i = static_cast<std::size_t>(
                ((largest * kUpliftSize + zi + d) * kUpliftSize + yi + b) * kUpliftSize + xi + a);
            return nephroid_uplift_table[i * 3 + k];
        };
        float const low = lerp(dy, lerp(dx, at(0, 0, 0), at(1, 0, 0)), lerp(dx, at(0, 1, 0), at(1, 1, 0)));
        float const high = lerp(dy, lerp(dx, at(0, 0, 1), at(1, 0, 1)), lerp(dx, at(0, 1, 1), at(1, 1, 1)));
        c[k] = static_cast<double>(lerp(dz, low, high));
    }
    return in_nanometres(c[0], c[1], c[2]);
}

}  // namespace nephroid
