#include "coat_table.h"

#include "node_place.h"

#include <bit>

// Linked in by the assembler (cmake/built_table.cmake).
extern "C" nephroid::CoatTable const nephroid_coat_table;

namespace nephroid {

namespace {

NodePlace at_eta(float eta) { return {CoatTable::eta_place(eta), CoatTable::kEtas}; }
NodePlace at_alpha(float alpha) { return {CoatTable::alpha_place(alpha), CoatTable::kAlphas}; }
NodePlace at_mu(float mu) { return {CoatTable::mu_place(mu), CoatTable::kMus}; }
NodePlace at_depth(float d) {
    return {CoatTable::depth_place(max(d, CoatTable::kDepthLo)), CoatTable::kDepths};
}

/// Multilinear: nodes[i + 0 or 1]… in each dimension.
float between(float const& node) { return node; }
template <std::size_t N, class T, class... Rest>
float between(T const (&nodes)[N], NodePlace p, Rest... rest) {
    float const low = between(nodes[p.i], rest...);
    return p.t > 0.0f ? lerp(p.t, low, between(nodes[p.i + 1], rest...)) : low;
}

}  // namespace

float coat_way_down(float eta, float alpha, float mu, float depth) {
    return between(nephroid_coat_table.down, at_eta(eta), at_alpha(alpha), at_mu(mu), at_depth(depth));
}
float coat_way_back(float eta, float alpha, float depth) {
    return between(nephroid_coat_table.back, at_eta(eta), at_alpha(alpha), at_depth(depth));
}
float coat_way_out(float eta, float alpha, float depth) {
    return between(nephroid_coat_table.out, at_eta(eta), at_alpha(alpha), at_depth(depth));
}

CoatTable::Lobes coat_lobes(float eta, float coat, float base, float mu) {
    constexpr std::size_t kNumbers = sizeof(CoatTable::Lobes) / sizeof(float);
    using Numbers = std::array<float, kNumbers>;
    NodePlace const e = at_eta(eta);
    NodePlace const a = at_alpha(coat);
    NodePlace const b = at_alpha(base);
    NodePlace const m = at_mu(mu);
    Numbers sum{};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            for (std::size_t k = 0; k < 2; ++k) {
                float const w = (i ? e.t : 1.0f - e.t) * (j ? a.t : 1.0f - a.t) * (k ? b.t : 1.0f - b.t);
                if (w == 0.0f) continue;
                CoatTable::Lobes const* const row = nephroid_coat_table.lobes[e.i + i][a.i + j][b.i + k];
                for (std::size_t l = 0; l < 2; ++l) {
                    float const v = w * (l ? m.t : 1.0f - m.t);
                    auto const n = std::bit_cast<Numbers>(row[m.i + l]);
                    for (std::size_t x = 0; x < kNumbers; ++x) sum[x] += v * n[x];
                }
            }
    return std::bit_cast<CoatTable::Lobes>(sum);
}

}  // namespace nephroid
