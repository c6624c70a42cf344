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

// Of dielectrics: reflected and transmitted part. Indices by s = (eta - 1) / (eta + 1), from -kMost to 0 and from 0 to kMost (eta
// from 1/3 to 3), dense about 0. What happens to cosines scales with mu_c = sqrt(1 - min(eta, 1 / eta)^2): from inside total
// reflection starts there, from outside refracted cosines do. It is a node; the nodes below it are dense at both of their ends,
// those above it are by the square root, as the transmittance begins.
inline constexpr int kIndices = 16, kGlassAlphas = 18, kGlassMus = 32, kBelow = 14;
inline constexpr float kMost = 0.5f;
inline constexpr std::size_t kGlass =
    static_cast<std::size_t>(kDistributions) * kGlassAlphas * kIndices * kGlassMus;  // of each part

// Then the averages over all directions of both, 2 integral E mu dmu of what look-ups say.
inline constexpr std::size_t kSingleAverages = static_cast<std::size_t>(kDistributions) * kAlphas;
inline constexpr std::size_t kGlassAverages =
    static_cast<std::size_t>(kDistributions) * kGlassAlphas * kIndices;

inline constexpr std::size_t kFirstAverage = kSingle + 2 * kGlass;

inline float critical_cosine(float eta) {
    float const least = eta < 1.0f ? eta : 1.0f / eta;
    return std::sqrt(1.0f - least * least);
}
/// Position among the nodes of mu, 0 to kGlassMus - 1.
inline float mu_to_node(float mu, float eta) {
    float const critical = critical_cosine(eta);
    if (mu < critical) return std::asin(std::sqrt(mu / critical)) * (2 / 3.14159265f) * kBelow;
    return kBelow + std::sqrt((mu - critical) / (1.0f - critical)) * (kGlassMus - 1 - kBelow);
}
inline float node_to_mu(float node, float eta) {
    float const critical = critical_cosine(eta);
    if (node < kBelow) {
        float const sine = std::sin(node / kBelow * (3.14159265f / 2));
        return critical * sine * sine;
    }
    float const t = (node - kBelow) / (kGlassMus - 1 - kBelow);
    return critical + (1.0f - critical) * t * t;
}
/// Position among the nodes of its half, 0 to kIndices / 2 - 1.
inline float index_to_node(float eta) {
    float const t = std::sqrt(std::abs((eta - 1.0f) / (eta + 1.0f)) / kMost) * (kIndices / 2 - 1);
    return eta < 1.0f ? kIndices / 2 - 1 - t : t;
}
inline float node_to_index(int i) {
    bool const inside = i < kIndices / 2;
    // The nodes at 0 are next to it, so that their side is known.
    float const t = std::fmax(
        static_cast<float>(inside ? kIndices / 2 - 1 - i : i - kIndices / 2) / (kIndices / 2 - 1), 0.02f);
    float const s = kMost * t * t;
    return inside ? (1.0f - s) / (1.0f + s) : (1.0f + s) / (1.0f - s);
}
inline float alpha_to_node(float alpha, int n) { return std::sqrt(alpha) * static_cast<float>(n - 1); }
inline float node_to_alpha(int i, int n) {
    float const t = static_cast<float>(i) / static_cast<float>(n - 1);
    return t * t;
}

}  // namespace nephroid::albedo_table
