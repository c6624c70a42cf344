// Rough conductors and dielectrics of all distributions over roughness, anisotropy and index: the checks of every model, the
// limit of smooth surfaces, and the white furnace with and without energy compensation.
#include "microfacet_support.h"

#include "model/energy_compensation.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

float const kIndices[] = {1.5f, 1 / 1.5f, 1.33f, 2.4f};

Spectrum const kCopperEta(0.2f, 0.4f, 1.1f, 1.2f), kCopperK(3.9f, 2.6f, 2.4f, 2.2f);

/// All outgoing directions for one of the surfaces and for a full run; else every seventh, of each surface others. At alpha 0.001
/// floats hold no halfway vector of directions 0.0003 from the horizon: the rounding of wi is a tenth of the lobe's width.
std::vector<Vec3> some(Microfacets const& m, int k) {
    auto all = outgoing();
    if (m.ax < 0.005f) std::erase_if(all, [](Vec3 w) { return std::abs(w.z) < 1e-3f; });
    if (full() || m.ax == 0.3f) return all;
    std::vector<Vec3> few;
    for (std::size_t i = static_cast<std::size_t>(k) % 7; i < all.size(); i += 7) few.push_back(all[i]);
    return few;
}

template <class F>
void for_all(F const& f) {
    for (NamedDistribution const& facet : kDistributions)
        for (Vec2 const a : kRoughness) {
            INFO(facet.name, ", alpha ", a.x, " ", a.y);
            f(Microfacets{a.x, a.y, facet.kind});
        }
}

}  // namespace

TEST_CASE("rough conductor: samples by the density, value, extreme numbers") {
    int k = 0;
    for_all([&](Microfacets const& m) {
        check_samples(
            RoughConductorBsdf{kCopperEta, kCopperK, m},
            {.n = samples(6'000, 1'000'000), .cells = 60, .directions = some(m, k++), .family = 27 * 22});
    });
}

TEST_CASE("rough dielectric: samples by the density, value, extreme numbers") {
    int k = 0;
    for (float const eta : kIndices)
        for_all([&](Microfacets const& m) {
            INFO("eta ", eta);
            check_samples(RoughDielectricBsdf{eta, false, m}, {.n = samples(6'000, 1'000'000),
                                                               .cells = 60,
                                                               .directions = some(m, k++),
                                                               .family = 4 * 27 * 22,
                                                               .eta = eta});
        });
}

TEST_CASE("rough boundaries: the density is the Jacobian of the warp") {
    for_all([](Microfacets const& m) {
        // Blinn's normals are two to one, see microfacet_test.cpp.
        if (max(m.ax, m.ay) < 0.03f || m.kind == Distribution::Blinn) return;
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

TEST_CASE("rough boundaries: energy, by samples and by quadrature") {
    int k = 0;
    for_all([&](Microfacets const& m) {
        BsdfChecks c{
            .n = samples(3'000, 200'000), .cells = 40, .directions = some(m, k++), .family = 5 * 27 * 22};
        c.within = 0.1;
        check_energy(RoughConductorBsdf{kCopperEta, kCopperK, m}, c);
        for (float const eta : kIndices) {
            INFO("eta ", eta);
            c.eta = eta;
            check_energy(RoughDielectricBsdf{eta, false, m}, c);
        }
    });
}

TEST_CASE("rough boundaries: with energy compensation the same checks pass") {
    int k = 0;
    for_all([&](Microfacets m) {
        m.multiscatter = true;
        BsdfChecks c{
            .n = samples(5'000, 1'000'000), .cells = 60, .directions = some(m, k++), .family = 3 * 27 * 22};
        Bsdf const metal = RoughConductorBsdf{kCopperEta, kCopperK, m};
        CHECK(traits(metal).chooses);
        check_samples(metal, c);
        check_reciprocity(metal, c);
        for (float const eta : {1.5f, 1 / 2.4f}) {
            INFO("eta ", eta);
            c.eta = eta;
            check_samples(RoughDielectricBsdf{eta, false, m}, c);
            check_reciprocity(RoughDielectricBsdf{eta, false, m}, c);
        }
    });
}

TEST_CASE("white furnace: what rough boundaries lose, without compensation and with it") {
    struct Kind {
        std::string name;
        float eta;  // 0: mirrors
    };
    Kind const kinds[] = {{"mirror", 0},
                          {"glass 1.5 from outside", 1.5f},
                          {"glass 1.5 from inside", 1 / 1.5f},
                          {"glass 2.4 from outside", 2.4f},
                          {"glass 2.4 from inside", 1 / 2.4f}};
    for (NamedDistribution const& facet : kDistributions)
        for (Kind const& boundary : kinds)
            for (bool const anisotropic : {false, true}) {
                double without = 0, with = 0, average = 0, count = 0;
                std::string where;
                for (Vec2 const a : kRoughness)
                    for (float const mu : {1.0f, 0.9f, 0.7f, 0.5f, 0.3f, 0.15f, 0.05f, 0.01f}) {
                        if ((a.x != a.y) != anisotropic) continue;
                        Microfacets const m{a.x, a.y, facet.kind, false};
                        Vec3 const wo = direction(std::acos(static_cast<double>(mu)), 0.5);
                        Parts const p = albedo_by_lattice(m, wo, boundary.eta);
                        double const single = p.reflected + p.transmitted;
                        // 2 pi integral f mu dmu, in sqrt(mu), and over a quarter of the azimuths, which the lobe of
                        // anisotropic facets depends on.
                        double lobe = 0;
                        int const n = 300, azimuths = anisotropic ? 8 : 1;
                        for (int i = 0; i < n * azimuths; ++i) {
                            float const t = (static_cast<float>(i % n) + 0.5f) / static_cast<float>(n),
                                        c = t * t;
                            float const s = std::sqrt(1 - c * c);
                            float const phi =
                                (static_cast<float>(i / n) + 0.5f) / static_cast<float>(azimuths) * kPiOver2;
                            Vec3 const wi{s * std::cos(phi), s * std::sin(phi), c};
                            float const f = boundary.eta == 0
                                                ? evaluate(reflection_compensation(m, wo), m, wi)
                                                : evaluate(dielectric_compensation(m, boundary.eta, wo), m,
                                                           wo, wi, Mode::Importance) +
                                                      evaluate(dielectric_compensation(m, boundary.eta, wo),
                                                               m, wo, -wi, Mode::Importance);
                            lobe += static_cast<double>(f * c * 2 * t) * 2 * kPiD / (n * azimuths);
                        }
                        without = std::max(without, std::abs(single - 1));
                        double const off = std::abs(single + lobe - 1);
                        if (off > with) {
                            where = "mu " + std::to_string(mu) + ", alpha " + std::to_string(a.x);
                            with = off;
                        }
                        average += off, ++count;
                    }
                average /= count;
                MESSAGE(facet.name, ", ", boundary.name, ", ",
                        std::string(anisotropic ? "anisotropic" : "isotropic"), ": greatest error ", without,
                        " without; with compensation ", with, " (", where, "), mean ", average);
                if (!anisotropic) CHECK(with < without);
                // Where ax and ay differ, only the mirrors of Trowbridge and Reitz have a table.
                bool const exact =
                    !anisotropic || (facet.kind == Distribution::TrowbridgeReitz && boundary.eta == 0);
                CHECK(with <= (exact ? 0.03 : 0.15));
                CHECK(average <= (exact ? 0.005 : 0.09));
            }
}

TEST_CASE("rough boundaries: towards alpha 0 they become the smooth ones") {
    for (NamedDistribution const& facet : kDistributions)
        for (double const theta : {0.2, 0.8, 1.2}) {
            Microfacets const m{1.1e-3f, 1.1e-3f, facet.kind};
            INFO(facet.name, ", theta ", theta);
            Vec3 const wo = direction(theta, 1);
            float const f = fresnel_conductor(wo.z, kCopperEta[1], kCopperK[1]);
            Mean mean;
            Random r(4);
            for (int i = 0; i < 2000; ++i) {
                auto const s = sample(RoughConductorBsdf{kCopperEta, kCopperK, m}, wo, 0, random_square(r),
                                      Mode::Radiance, HemisphereSampling::Cosine);
                mean.add(s ? throughput(*s, 1) : 0);
            }
            CHECK(mean.mean() == doctest::Approx(f).epsilon(2e-3));
            for (float const eta : {1.5f, 1 / 1.5f}) {
                Parts const p = albedo_by_lattice(m, wo, eta);
                double const reflectance = fresnel_dielectric(wo.z, eta);
                CHECK(p.reflected == doctest::Approx(reflectance).epsilon(0.01));
                CHECK(p.reflected + p.transmitted == doctest::Approx(1).epsilon(1e-3));
                // Radiance is squeezed by n^2 as at the smooth boundary.
                auto const s = sample(RoughDielectricBsdf{eta, false, m}, wo, kOneMinusEpsilon, {0.5f, 0.5f},
                                      Mode::Radiance, HemisphereSampling::Cosine);
                if (!s || !s->transmitted) continue;
                auto const smooth = delta_branches(DielectricBsdf{Spectrum(eta), false}, wo, Mode::Radiance);
                REQUIRE(smooth.transmitted);
                CHECK(length(s->wi - smooth.transmitted->wi) < 0.01f);
                CHECK(throughput(*s) * (1 - reflectance) ==
                      doctest::Approx(throughput(*smooth.transmitted)).epsilon(0.01));
                CHECK(s->eta == doctest::Approx(eta));
            }
        }
}

TEST_CASE("rough boundaries: albedo() is what is scattered, within 0.03, anisotropic ones within 0.15") {
    int k = 0;
    for_all([&](Microfacets const& m) {
        bool const isotropic = m.ax == m.ay;
        for (Vec3 const wo : some(m, k++)) {
            INFO("wo.z ", wo.z);
            double const metal = albedo_by_lattice(m, wo, 0).reflected;
            CHECK(std::abs(albedo(mirrors(m), wo)[0] - metal) <= (isotropic ? 0.03 : 0.15));
            Parts const p = albedo_by_lattice(m, wo, 1.5f);
            Bsdf const glass = RoughDielectricBsdf{1.5f, false, m};
            CHECK(std::abs(albedo(glass, wo)[0] - p.reflected - p.transmitted) <= (isotropic ? 0.03 : 0.15));
        }
    });
}
