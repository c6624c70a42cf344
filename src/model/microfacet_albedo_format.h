// The tables of microfacet albedos: what tools/microfacet_table.cpp writes and src/model/microfacet_albedo.cpp reads. Floats,
// distribution slowest, then alpha, (the index,) mu fastest.
#pragma once

#include <cmath>
#include <cstddef>

namespace nephroid::albedo_table {

inline constexpr int kDistributions = 3;

// With F = 1: nodes sqrt(alpha) and sqrt(mu) from 0 to 1, close together where lobes are narrow and light grazes.
inline constexpr int kAlphas = 32, kMus = 48;
inline constexpr std::size_t kSingle = static_cast<std::size_t>(kDistributions) * kAlphas * kMus;

// Of dielectrics: reflected and transmitted part. Indices by s = (eta - 1) / (eta + 1): the first half of the nodes from -kMost to
// 0, the second from 0 to kMost (eta from 1/3 to 3). In the first half total reflection starts at mu_c = sqrt(1 - eta^2), which is
// a node: those below it are dense at both of their ends, those above it are by the square root, as the transmittance begins. In the second half all
// nodes are by the square root.
inline constexpr int kIndices = 16, kGlassAlphas = 20, kGlassMus = 40, kBelow = 16;
inline constexpr float kMost = 0.5f;
inline constexpr std::size_t kGlass =
    static_cast<std::size_t>(kDistributions) * kGlassAlphas * kIndices * kGlassMus;  // of each part

// Then the averages over all directions of both, 2 integral E mu dmu of what look-ups say.
inline constexpr std::size_t kSingleAverages = static_cast<std::size_t>(kDistributions) * kAlphas;
inline constexpr std::size_t kGlassAverages =
    static_cast<std::size_t>(kDistributions) * kGlassAlphas * kIndices;

inline constexpr std::size_t kFirstAverage = kSingle + 2 * kGlass;

/// Position among the nodes of mu, 0 to kGlassMus - 1. `inside`: by the first half's nodes.
inline float mu_to_node(float mu, float eta, bool inside) {
    if (!inside) return std::sqrt(mu) * (kGlassMus - 1);
    float const critical = std::sqrt(1.0f - eta * eta);
    if (mu < critical) return std::asin(std::sqrt(mu / critical)) * (2 / 3.14159265f) * kBelow;
    return kBelow + std::sqrt((mu - critical) / (1.0f - critical)) * (kGlassMus - 1 - kBelow);
}
inline float node_to_mu(float node, float eta, bool inside) {
    float const first = inside ? kBelow : 0.0f, critical = inside ? std::sqrt(1.0f - eta * eta) : 0.0f;
    if (node < first) {
        float const sine = std::sin(node / first * (3.14159265f / 2));
        return critical * sine * sine;
    }
    float const t = (node - first) / (kGlassMus - 1 - first);
    return critical + (1.0f - critical) * t * t;
}
/// Position among the nodes of its half.
inline float index_to_node(float eta, bool inside) {
    float const s = (eta - 1.0f) / (eta + 1.0f) / kMost;
    return (inside ? 1.0f + s : s) * (kIndices / 2 - 1);
}
inline bool node_is_inside(int i) { return i < kIndices / 2; }
inline float node_to_index(int i) {
    float const t = static_cast<float>(i % (kIndices / 2)) / (kIndices / 2 - 1);
    float const s = (node_is_inside(i) ? t - 1.0f : t) * kMost;
    return (1.0f + s) / (1.0f - s) -
           (i == kIndices / 2 - 1 ? 1e-3f : 0.0f);  // total reflection up to the end of that half
}
inline float alpha_to_node(float alpha, int n) { return std::sqrt(alpha) * static_cast<float>(n - 1); }
inline float node_to_alpha(int i, int n) {
    float const t = static_cast<float>(i) / static_cast<float>(n - 1);
    return t * t;
}

}  // namespace nephroid::albedo_table
