#include "coat_table.h"

#include <bit>

// Linked in by the assembler (cmake/coat.cmake).
extern "C" nephroid::CoatTable const nephroid_coat_table;

namespace nephroid {

namespace {

struct Place {
    std::size_t i;
    float t;
};
Place place(float x, std::size_t n) {
    x = clamp(x, 0.0f, static_cast<float>(n - 1));
    std::size_t const i = min(static_cast<std::size_t>(x), n - 2);
    return {i, x - static_cast<float>(i)};
}
Place at_eta(float eta) { return place(CoatTable::eta_place(eta), CoatTable::kEtas); }
Place at_alpha(float alpha) { return place(CoatTable::alpha_place(alpha), CoatTable::kAlphas); }
Place at_mu(float mu) { return place(CoatTable::mu_place(mu), CoatTable::kMus); }
Place at_depth(float d) {
    return place(CoatTable::depth_place(max(d, CoatTable::kDepthLo)), CoatTable::kDepths);
}

/// Multilinear: nodes[i + 0 or 1]… in each dimension.
float between(float const& node) { return node; }
template <std::size_t N, class T, class... Rest>
float between(T const (&nodes)[N], Place p, Rest... rest) {
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
    Place const e = at_eta(eta);
    Place const a = at_alpha(coat);
    Place const b = at_alpha(base);
    Place const m = at_mu(mu);
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
