// Rough conductors and dielectrics of all distributions over roughness, anisotropy and index: the checks of every model, the
// limit of smooth surfaces, and the white furnace with and without energy compensation.
#include "bsdf_checks.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

struct Named {
    char const* name;
    Distribution kind;
};
Named const kDistributions[] = {{"trowbridge-reitz", Distribution::TrowbridgeReitz},
                                {"beckmann", Distribution::Beckmann},
                                {"blinn", Distribution::Blinn}};
Vec2 const kRoughness[] = {{0.001f, 0.001f}, {0.01f, 0.01f}, {0.05f, 0.05f}, {0.1f, 0.1f}, {0.3f, 0.3f},
                           {0.5f, 0.5f},     {1, 1},         {0.02f, 0.4f},  {0.4f, 0.05f}};
float const kIndices[] = {1.5f, 1 / 1.5f, 1.33f, 2.4f};

Spectrum const kCopperEta(0.2f, 0.4f, 1.1f, 1.2f), kCopperK(3.9f, 2.6f, 2.4f, 2.2f);

template <class F>
void for_all(F const& f) {
    for (auto const& [name, kind] : kDistributions)
        for (Vec2 const a : kRoughness) {
            INFO(name, ", alpha ", a.x, " ", a.y);
            f(Microfacets{a.x, a.y, kind});
        }
}

}  // namespace

TEST_CASE("rough conductor: samples by the density, value, extreme numbers") {
    for_all([](Microfacets const& m) {
        check_samples(RoughConductorBsdf{kCopperEta, kCopperK, m},
                      {.n = samples(10'000, 1'000'000), .cells = 100, .family = 27 * 22});
    });
}

TEST_CASE("rough dielectric: samples by the density, value, extreme numbers") {
    for (float const eta : kIndices)
        for_all([&](Microfacets const& m) {
            INFO("eta ", eta);
            check_samples(RoughDielectricBsdf{eta, false, m},
                          {.n = samples(5'000, 1'000'000), .cells = 60, .family = 4 * 27 * 22, .eta = eta});
        });
}

TEST_CASE("rough boundaries: the density is the Jacobian of the warp") {
    for_all([](Microfacets const& m) {
        if (max(m.ax, m.ay) < 0.03f) return;
        for (Vec3 const wo : {direction(0.3, 1), direction(1.2, 2), direction(2.2, -2)}) {
            Bsdf const metal = RoughConductorBsdf{kCopperEta, kCopperK, m};
            auto const part = [&](Bsdf const& b, float uc) {
                return [&b, wo, uc](Vec2 u) -> std::optional<Vec3> {
                    auto const s = sample(b, wo, uc, u, Mode::Radiance, HemisphereSampling::Cosine);
                    return s ? std::optional(s->wi) : std::nullopt;
                };
            };
            INFO("wo.z ", wo.z);
            check_jacobian(part(metal, 0.5f),
                           [&](Vec3 wi) { return pdf(metal, wo, wi, HemisphereSampling::Cosine); });
            // Each part of a dielectric is drawn with the probability that Fresnel's equation says at its normal.
            for (float const eta : {1.5f, 1 / 1.5f}) {
                INFO("eta ", eta);
                Bsdf const glass = RoughDielectricBsdf{eta, false, m};
                check_jacobian(part(glass, 0), [&](Vec3 wi) {
                    float const f = fresnel_dielectric(std::copysign(dot(wo, normalize(wo + wi)), wo.z), eta);
                    return pdf(glass, wo, wi, HemisphereSampling::Cosine) / f;
                });
                if ((wo.z > 0) == (eta > 1))
                    check_jacobian(part(glass, kOneMinusEpsilon), [&](Vec3 wi) {
                        Vec3 const wm = normalize(wo.z > 0 ? wo + eta * wi : wi + eta * wo);
                        float const f = fresnel_dielectric(std::copysign(dot(wo, wm), wo.z), eta);
                        return pdf(glass, wo, wi, HemisphereSampling::Cosine) / (1 - f);
                    });
            }
        }
    });
}

TEST_CASE("rough boundaries: reciprocity and adjoint") {
    for_all([](Microfacets const& m) {
        check_reciprocity(RoughConductorBsdf{kCopperEta, kCopperK, m});
        for (float const eta : kIndices) {
            INFO("eta ", eta);
            check_reciprocity(RoughDielectricBsdf{eta, false, m}, {.eta = eta});
        }
    });
}
