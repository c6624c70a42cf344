// Look-ups in the tables of microfacet albedos, linear between nodes.
#include "model/microfacet_albedo.h"

#include "microfacet_albedo_format.h"
#include "node_place.h"

extern "C" float const nephroid_microfacet_table[];

namespace nephroid {

namespace {

namespace table = albedo_table;

float between(float const* at, int step, float share) { return lerp(share, at[0], at[step]); }

/// Where a dielectric stands: its first row, and the shares of the next alpha and of the next index.
struct Place {
    int row;
    float alpha, index;
    float square;  // the next index's share by (eta - 1)^2 / (eta + 1)^2
};
/// Beyond the table's indices the outermost, which no one has seen.
float inside_table(float eta) {
    return clamp(eta, (1.0f - table::kMost) / (1.0f + table::kMost),
                 (1.0f + table::kMost) / (1.0f - table::kMost));
}
Place place(Distribution d, float alpha, float eta) {
    using namespace table;
    bool const inside = eta < 1.0f;
    NodePlace const a{alpha_to_node(alpha, kGlassAlphas), kGlassAlphas};
    NodePlace const n{index_to_node(inside_table(eta)), kIndices / 2};
    int const node = static_cast<int>(n.i) + (inside ? 0 : kIndices / 2);
    auto const s2 = [](float index) { return sqr((index - 1.0f) / (index + 1.0f)); };
    float const low = s2(node_to_index(node)), high = s2(node_to_index(node + 1));
    return {(static_cast<int>(d) * kGlassAlphas + static_cast<int>(a.i)) * kIndices + node, a.t, n.t,
            clamp((s2(inside_table(eta)) - low) / (high - low), 0.0f, 1.0f)};
}

/// `part`: 0 reflected, 1 transmitted.
float glass(Distribution d, float mu, float alpha, float eta, int part) {
    using namespace table;
    Place const at = place(d, alpha, eta);
    int const row = at.row;
    float const a = at.alpha;
    float const* t =
        nephroid_microfacet_table + kSingle + static_cast<std::size_t>(part) * kGlass + row * kGlassMus;
    // mu by the nodes of this index, which lie alike about the critical angle in both neighbours.
    NodePlace const m{mu_to_node(clamp(mu, 0.0f, 1.0f), inside_table(eta)), kGlassMus};
    // Between two indices what is reflected straight on grows as s^2, s = (eta - 1) / (eta + 1), where even shares of the nodes
    // would give a twelfth too much; towards grazing light the nodes' own shares are nearer.
    float const n = lerp(sqr(sqr(clamp(mu, 0.0f, 1.0f))), at.index, at.square);
    auto const of_alpha = [&](float const* p) {
        return lerp(n, between(p + m.i, 1, m.t), between(p + kGlassMus + m.i, 1, m.t));
    };
    return lerp(a, of_alpha(t), of_alpha(t + kIndices * kGlassMus));
}

}  // namespace

float microfacet_albedo(Distribution d, float mu, float alpha) {
    using namespace table;
    NodePlace const a{alpha_to_node(alpha, kAlphas), kAlphas};
    NodePlace const m{std::sqrt(clamp(mu, 0.0f, 1.0f)) * (kMus - 1), kMus};
    float const* t =
        nephroid_microfacet_table + (static_cast<int>(d) * kAlphas + static_cast<int>(a.i)) * kMus + m.i;
    return lerp(a.t, between(t, 1, m.t), between(t + kMus, 1, m.t));
}

float microfacet_albedo_average(Distribution d, float alpha) {
    using namespace table;
    NodePlace const a{alpha_to_node(alpha, kAlphas), kAlphas};
    return between(
        nephroid_microfacet_table + kFirstAverage + static_cast<int>(d) * kAlphas + static_cast<int>(a.i), 1,
        a.t);
}

float dielectric_reflection_albedo(Distribution d, float mu, float alpha, float eta) {
    return glass(d, mu, alpha, eta, 0);
}
float dielectric_transmission_albedo(Distribution d, float mu, float alpha, float eta) {
    return glass(d, mu, alpha, eta, 1);
}
float dielectric_albedo_average(Distribution d, float alpha, float eta) {
    Place const at = place(d, alpha, eta);
    float const* t = nephroid_microfacet_table + table::kFirstAverage + table::kSingleAverages + at.row;
    return lerp(at.alpha, between(t, 1, at.index), between(t + table::kIndices, 1, at.index));
}

}  // namespace nephroid
