// A function of a direction's cosine and a roughness, tabulated: directional albedos have no closed form. Linear between nodes;
// those of the cosine stand densest at grazing angles, where albedos bend most.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {

/// T: a float, or something that is added and scaled as one.
template <class T>
class AngleTable {
  public:
    /// `value(mu, roughness)` for mu in [0, 1] and roughness in [rough_min, 1]; it is never asked at mu = 0, but beside it.
    template <class F>
    AngleTable(float rough_min, F const& value) : rough_min_(rough_min) {
        for (int r = 0; r <= kRough; ++r) {
            float const roughness =
                rough_min + (1.0f - rough_min) * static_cast<float>(r) / static_cast<float>(kRough);
            for (int a = 0; a <= kAngles; ++a)
                nodes_[index(r, a)] =
                    value(max(1e-4f, sqr(static_cast<float>(a) / static_cast<float>(kAngles))), roughness);
            averages_[static_cast<std::size_t>(r)] = average_of_row(r);
        }
    }

    [[nodiscard]] T operator()(float mu, float roughness) const {
        Place const r = place(rough_place(roughness), kRough);
        Place const a = place(std::sqrt(clamp(mu, 0.0f, 1.0f)) * static_cast<float>(kAngles), kAngles);
        T const low = mix(a.t, nodes_[index(r.cell, a.cell)], nodes_[index(r.cell, a.cell + 1)]);
        T const high = mix(a.t, nodes_[index(r.cell + 1, a.cell)], nodes_[index(r.cell + 1, a.cell + 1)]);
        return mix(r.t, low, high);
    }
    /// The cosine-weighted mean over the hemisphere, 2 int T(mu) mu dmu, of just what operator() answers.
    [[nodiscard]] T average(float roughness) const {
        Place const r = place(rough_place(roughness), kRough);
        auto const i = static_cast<std::size_t>(r.cell);
        return mix(r.t, averages_[i], averages_[i + 1]);
    }

  private:
    static constexpr int kAngles = 32, kRough = 24;
    struct Place {
        int cell;
        float t;
    };
    static std::size_t index(int r, int a) { return static_cast<std::size_t>(r * (kAngles + 1) + a); }
    static T mix(float t, T const& a, T const& b) { return a * (1.0f - t) + b * t; }
    static Place place(float x, int cells) {
        int const i = std::min(static_cast<int>(x), cells - 1);
        return {i, x - static_cast<float>(i)};
    }
    [[nodiscard]] float rough_place(float roughness) const {
        return clamp((roughness - rough_min_) / (1.0f - rough_min_), 0.0f, 1.0f) * static_cast<float>(kRough);
    }
    /// With mu = x^2: 4 int T x^3 dx, and T is linear in x within a cell.
    [[nodiscard]] T average_of_row(int r) const {
        T sum{};
        for (int a = 0; a < kAngles; ++a) {
            float const x = static_cast<float>(a) / static_cast<float>(kAngles);
            float const y = static_cast<float>(a + 1) / static_cast<float>(kAngles);
            float const whole = y * y * y * y - x * x * x * x;                   // int 4 x^3
            float const first = 0.8f * (y * y * y * y * y - x * x * x * x * x);  // int 4 x^4
            float const upper = (first - x * whole) * static_cast<float>(kAngles);
            sum = sum + nodes_[index(r, a)] * (whole - upper) + nodes_[index(r, a + 1)] * upper;
        }
        return sum;
    }

    float rough_min_;
    std::array<T, static_cast<std::size_t>((kAngles + 1) * (kRough + 1))> nodes_{};
    std::array<T, static_cast<std::size_t>(kRough + 1)> averages_{};
};

}  // namespace nephroid
