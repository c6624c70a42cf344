// Computes the directional albedos of microfacets, with F = 1 and of dielectrics, by drawing normals at the points of a
// Fibonacci lattice, whose error falls nearly as 1/n.
//
//   microfacet_table OUT.bin
#include "../src/model/microfacet_albedo_format.h"
#include "model/fresnel.h"
#include "model/microfacet.h"

#include <cstdio>
#include <vector>

namespace {

using namespace nephroid;
namespace table = albedo_table;

struct Lattice {
    int n, step;
};
constexpr Lattice kFine{1597, 987}, kCoarse{377, 233};

struct Parts {
    double reflected = 0, transmitted = 0;
};

/// Reflected and transmitted part of light from w; eta = 0: everything is reflected.
Parts albedo(Microfacets const& m, Vec3 w, float eta, Lattice l) {
    Parts sum;
    for (int i = 0; i < l.n; ++i) {
        Vec2 const u{(static_cast<float>(i) + 0.5f) / static_cast<float>(l.n),
                     (static_cast<float>(i * l.step % l.n) + 0.5f) / static_cast<float>(l.n)};
        Vec3 const wm = sample_microfacet(m, w, u);
        float const seen = dot(w, wm), density = microfacet_pdf(m, w, wm);
        if (!(density > 0.0f)) continue;
        // f |cos| / pdf without F: D G w.wm / (|cos_o| density of wm), see bsdf_microfacet.cpp.
        auto const weight = [&](Vec3 wi) {
            return static_cast<double>(microfacet_d(m, wm) * microfacet_g_over_cosines(m, w, wi) *
                                       abs_cos_theta(wi) * seen / density);
        };
        float const f = eta == 0.0f ? 1.0f : fresnel_dielectric(seen, eta);
        Vec3 const mirrored = 2.0f * seen * wm - w;
        if (mirrored.z > 0.0f) sum.reflected += static_cast<double>(f) * weight(mirrored);
        if (f >= 1.0f) continue;
        float const cos_t = safe_sqrt(1.0f - (1.0f - sqr(seen)) / sqr(eta));
        Vec3 const refracted = w * (-1.0f / eta) + wm * (seen / eta - cos_t);
        if (refracted.z < 0.0f) sum.transmitted += static_cast<double>(1.0f - f) * weight(refracted);
    }
    return {sum.reflected / l.n, sum.transmitted / l.n};
}

Vec3 direction(float mu) {
    mu = std::fmax(mu, 1e-4f);  // the limit
    return {std::sqrt(1.0f - mu * mu), 0.0f, mu};
}

float between(float const* row, float node, int n) {
    int const low = static_cast<int>(std::fmin(node, static_cast<float>(n - 2)));
    float const share = node - static_cast<float>(low);
    return (1.0f - share) * row[low] + share * row[low + 1];
}

/// 2 integral f(mu) mu dmu by the midpoint rule in sqrt(mu).
template <class F>
float average(F const& f) {
    int const n = 2000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        float const t = (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
        sum += static_cast<double>(f(t * t) * 4.0f * t * t * t) / n;
    }
    return static_cast<float>(sum);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: microfacet_table OUT.bin\n");
        return 2;
    }
    std::vector<float> single, reflected, transmitted;
    for (int d = 0; d < table::kDistributions; ++d) {
        auto const facets = [d](float alpha) {
            alpha = std::fmax(alpha, 1e-4f);
            return Microfacets{alpha, alpha, static_cast<Distribution>(d)};
        };
        for (int a = 0; a < table::kAlphas; ++a)
            for (int k = 0; k < table::kMus; ++k) {
                float const t = static_cast<float>(k) / (table::kMus - 1);
                Microfacets const m = facets(table::node_to_alpha(a, table::kAlphas));
                single.push_back(static_cast<float>(albedo(m, direction(t * t), 0.0f, kFine).reflected));
            }
        for (int a = 0; a < table::kGlassAlphas; ++a)
            for (int n = 0; n < table::kIndices; ++n)
                for (int k = 0; k < table::kGlassMus; ++k) {
                    float const eta = table::node_to_index(n);
                    float const mu = table::node_to_mu(static_cast<float>(k), eta);
                    Parts const p = albedo(facets(table::node_to_alpha(a, table::kGlassAlphas)),
                                           direction(mu), eta, kCoarse);
                    reflected.push_back(static_cast<float>(p.reflected));
                    transmitted.push_back(static_cast<float>(p.transmitted));
                }
    }
    single.insert(single.end(), reflected.begin(), reflected.end());
    single.insert(single.end(), transmitted.begin(), transmitted.end());
    std::vector<float> const entries = single;  // averages are of what look-ups say
    for (std::size_t row = 0; row < table::kSingleAverages; ++row)
        single.push_back(average([&](float mu) {
            return between(&entries[row * table::kMus], std::sqrt(mu) * (table::kMus - 1), table::kMus);
        }));
    for (std::size_t row = 0; row < table::kGlassAverages; ++row) {
        int const n = static_cast<int>(row % table::kIndices);
        single.push_back(average([&](float mu) {
            float const node = table::mu_to_node(mu, table::node_to_index(n));
            float const* r = &entries[table::kSingle + row * table::kGlassMus];
            return between(r, node, table::kGlassMus) + between(r + table::kGlass, node, table::kGlassMus);
        }));
    }
    std::FILE* f = std::fopen(argv[1], "wb");
    bool good = f && std::fwrite(single.data(), sizeof(float), single.size(), f) == single.size();
    if (f) good = std::fclose(f) == 0 && good;
    if (!good) std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
    return good ? 0 : 4;
}
