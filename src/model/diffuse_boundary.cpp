// What a dielectric boundary does to light as a whole.
#include "diffuse_boundary.h"

#include "node_place.h"

#include "coat_table.h"
#include "model/fresnel.h"
#include "model/microfacet_albedo.h"

#include <array>
#include <cmath>

namespace nephroid {

namespace {

float alpha_of(Microfacets const& m) { return std::sqrt(m.ax * m.ay); }

/// Cosine inside of the direction that mu outside refracts to; 0 where it does not (total reflection by a thinner layer).
float refracted_cosine(float mu, float eta) { return safe_sqrt(1.0f - (1.0f - mu * mu) / (eta * eta)); }

class Tables {
  public:
    static constexpr float kLeast = -0.45f, kMost = 0.5f;  // (eta - 1) / (eta + 1)

    Tables() {
        for (std::size_t e = 0; e < kEtas; ++e) {
            float const eta = node_eta(e);
            fill_smooth(eta, smooth_[e]);
            for (std::size_t kind = 0; kind < 3; ++kind)
                for (std::size_t a = 0; a < kAlphas; ++a)
                    rough_[kind][a][e] = a == 0 ? smooth_[e][0]
                                                : rough(static_cast<Distribution>(kind),
                                                        static_cast<float>(a) / (kAlphas - 1), eta);
        }
    }
    [[nodiscard]] DiffuseBoundary operator()(Microfacets const& m, float eta, float depth) const {
        NodePlace const e{((eta - 1.0f) / (eta + 1.0f) - kLeast) / kStep, kEtas};
        if (m.smooth()) {
            NodePlace const d{std::log2(1.0f + depth * kDepthScale) * kPerOctave, kDepths};
            auto const at_depth = [&](std::size_t i) {
                return mix(d.t, smooth_[e.i + i][d.i], smooth_[e.i + i][d.i + 1]);
            };
            return mix(e.t, at_depth(0), at_depth(1));
        }
        auto const& table = rough_[static_cast<std::size_t>(m.kind)];
        NodePlace const a{alpha_of(m) * (kAlphas - 1), kAlphas};
        DiffuseBoundary const r = mix(a.t, mix(e.t, table[a.i][e.i], table[a.i][e.i + 1]),
                                      mix(e.t, table[a.i + 1][e.i], table[a.i + 1][e.i + 1]));
        if (depth == 0.0f) return r;
        float const alpha = alpha_of(m);
        return {r.back * std::exp(-depth * coat_way_back(eta, alpha, depth)),
                r.out * std::exp(-depth * coat_way_out(eta, alpha, depth))};
    }

  private:
    // In (eta - 1) / (eta + 1), the amplitude reflected at normal incidence: eta from 0.38 to 3.
    static constexpr std::size_t kEtas = 65, kAlphas = 17, kDepths = 73;
    static constexpr float kStep = (kMost - kLeast) / (kEtas - 1);
    // Depths 0, 0.02 (2^(k/6) - 1): up to 80.
    static constexpr float kDepthScale = 50.0f, kPerOctave = 6.0f;

    static float node_eta(std::size_t i) {
        float const r = kLeast + kStep * static_cast<float>(i);
        return (1.0f + r) / (1.0f - r);
    }
    static float node_depth(std::size_t i) {
        return (std::exp2(static_cast<float>(i) / kPerOctave) - 1.0f) / kDepthScale;
    }
    static DiffuseBoundary mix(float t, DiffuseBoundary a, DiffuseBoundary b) {
        return {lerp(t, a.back, b.back), lerp(t, a.out, b.out)};
    }
    /// By the midpoint rule in two parts that meet at the critical angle, where R has a root's singularity.
    static void fill_smooth(float eta, std::array<DiffuseBoundary, kDepths>& row) {
        constexpr int n = 64;
        float const critical = safe_sqrt(1.0f - 1.0f / (eta * eta));
        row.fill({});
        auto const add = [&](float mu, float dmu) {
            float const r = fresnel_dielectric(mu, 1.0f / eta);
            for (std::size_t d = 0; d < kDepths; ++d) {
                float const way = std::exp(-node_depth(d) / mu);
                row[d].back += 2.0f * r * way * way * mu * dmu;
                row[d].out += 2.0f * (1.0f - r) * way * mu * dmu;
            }
        };
        for (int i = 0; i < n; ++i) {
            float const u = (static_cast<float>(i) + 0.5f) / n;
            if (critical > 0.0f) add(critical * u, critical / n);
            add(critical + (1.0f - critical) * u * u, (1.0f - critical) * 2.0f * u / n);
        }
    }
    static DiffuseBoundary rough(Distribution kind, float alpha, float eta) {
        constexpr int n = 32;
        DiffuseBoundary sum;
        for (int i = 0; i < n; ++i) {
            float const mu = std::sqrt((static_cast<float>(i) + 0.5f) / n);
            sum.back += dielectric_reflection_albedo(kind, mu, alpha, 1.0f / eta) / n;
            sum.out += dielectric_transmission_albedo(kind, mu, alpha, 1.0f / eta) / n;
        }
        return sum;
    }

    std::array<std::array<DiffuseBoundary, kDepths>, kEtas> smooth_;
    std::array<std::array<std::array<DiffuseBoundary, kEtas>, kAlphas>, 3> rough_;
};

}  // namespace

float boundary_transmittance(Microfacets const& m, float eta, float depth, float mu) {
    if (m.smooth()) {
        float const c = refracted_cosine(mu, eta);
        if (!(c > 0.0f)) return 0.0f;
        float const t = 1.0f - fresnel_dielectric(mu, eta);
        return depth == 0.0f ? t : t * std::exp(-depth / c);
    }
    float const alpha = alpha_of(m);
    float const t = dielectric_transmission_albedo(m.kind, mu, alpha, eta);
    return depth == 0.0f ? t : t * std::exp(-depth * coat_way_down(eta, alpha, mu, depth));
}

float boundary_reflectance(Microfacets const& m, float eta, float mu) {
    return m.smooth() ? fresnel_dielectric(mu, eta)
                      : dielectric_reflection_albedo(m.kind, mu, alpha_of(m), eta);
}

bool diffuse_boundary_covers(float eta) {
    float const r = (eta - 1.0f) / (eta + 1.0f);
    return r >= Tables::kLeast && r <= Tables::kMost;
}

DiffuseBoundary diffuse_boundary(Microfacets const& m, float eta, float depth) {
    static Tables const tables;
    return tables(m, eta, depth);
}

}  // namespace nephroid
