// Scattering models: samples by their densities, reciprocity, energy, and what a boundary does with wavelengths and Modes.
#include "model/bsdf.h"
#include "model/fresnel.h"

#include "bsdf_checks.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("diffuse: samples by the density, from both sides and at grazing angles") {
    Bsdf const b = DiffuseBsdf{Spectrum(0.2f, 0.5f, 0.7f, 1.0f)};
    int const n = samples(1'000'000, 4'000'000);
    SphereCells const cells(40, 24);
    auto const directions = outgoing();
    double const alpha = sidak(2 * static_cast<int>(directions.size()));
    for (auto const how : {HemisphereSampling::Cosine, HemisphereSampling::Uniform}) {
        Random r(1);
        for (Vec3 const wo : directions) {
            std::vector<double> o(cells.size());
            int drawn = 0;
            for (int i = 0; i < n; ++i) {
                auto const s = sample(b, wo, r.unit(), random_square(r), Mode::Radiance, how);
                if (!s) continue;  // in the tangent plane
                ++drawn;
                REQUIRE(s->pdf > 0);
                REQUIRE(s->pdf == pdf(b, wo, s->wi, how));
                REQUIRE(s->wi.z * wo.z > 0);
                REQUIRE(std::abs(length(s->wi) - 1) < 1e-6f);
                REQUIRE(s->f[1] == evaluate(b, wo, s->wi, Mode::Radiance)[1]);
                REQUIRE_FALSE(s->delta);
                ++o[cells.cell(s->wi)];
            }
            CHECK(drawn >= n - 3);
            auto e = cells.integrate([&](Vec3 w) { return pdf(b, wo, w, how); }, 4);
            for (double& x : e) x *= n;
            auto const c = chi_square(o, e);
            INFO("z = ", wo.z, ": ", c);
            CHECK(c.p >= alpha);
            // Control on one of them: another density is noticed.
            if (wo.z == directions[1].z) {
                auto const other = how == HemisphereSampling::Cosine ? HemisphereSampling::Uniform
                                                                     : HemisphereSampling::Cosine;
                auto wrong = cells.integrate([&](Vec3 w) { return pdf(b, wo, w, other); }, 4);
                for (double& x : wrong) x *= n;
                CHECK(chi_square(o, wrong).p < 1e-9);
            }
        }
    }
}

TEST_CASE("diffuse: the density is the Jacobian of the warp") {
    Bsdf const b = DiffuseBsdf{Spectrum(0.5f)};
    Random r(2);
    for (auto const how : {HemisphereSampling::Cosine, HemisphereSampling::Uniform})
        for (int i = 0; i < 500; ++i) {
            Vec3 const wo{0, 0.6f, i % 2 ? 0.8f : -0.8f};
            Vec2 const u{0.1f + 0.8f * r.unit(), 0.1f + 0.8f * r.unit()};
            // The concentric map has creases on its diagonals.
            if (std::abs(std::abs(u.x - 0.5f) - std::abs(u.y - 0.5f)) < 0.02f || std::abs(u.x - 0.5f) < 0.02f)
                continue;
            float const h = 4e-3f;
            auto const at = [&](float x, float y) {
                return sample(b, wo, 0, {u.x + x, u.y + y}, Mode::Radiance, how)->wi;
            };
            Vec3 const du = at(h, 0) - at(-h, 0), dv = at(0, h) - at(0, -h);
            double const element = static_cast<double>(length(cross(du, dv))) / (4.0 * h * h);
            auto const s = sample(b, wo, 0, u, Mode::Radiance, how);
            CHECK(static_cast<double>(s->pdf) * element == doctest::Approx(1).epsilon(1e-3));
        }
}

TEST_CASE("diffuse: reciprocity, value, no light through, energy") {
    Spectrum const rho(0.2f, 0.5f, 0.7f, 1.0f);
    Bsdf const b = DiffuseBsdf{rho};
    CHECK_FALSE(is_delta(b));
    Random r(3);
    for (int i = 0; i < 1000; ++i) {
        Vec3 const wi = random_direction(r), wo = random_direction(r);
        for (auto const mode : {Mode::Radiance, Mode::Importance})
            for (int k = 0; k < 4; ++k) {
                CHECK(evaluate(b, wi, wo, mode)[k] == evaluate(b, wo, wi, mode)[k]);
                float const expected = wi.z * wo.z > 0 ? rho[k] / 3.14159265f : 0.0f;
                CHECK(evaluate(b, wi, wo, mode)[k] == doctest::Approx(expected).epsilon(1e-6));
            }
        if (wi.z * wo.z <= 0) CHECK(pdf(b, wo, wi, HemisphereSampling::Cosine) == 0);
        if (wi.z * wo.z <= 0) CHECK(pdf(b, wo, wi, HemisphereSampling::Uniform) == 0);
    }
    for (auto const how : {HemisphereSampling::Cosine, HemisphereSampling::Uniform})
        for (Vec3 const wo : outgoing()) {
            Mean mean;
            for (int i = 0; i < 40'000; ++i) {
                auto const s = sample(b, wo, 0, random_square(r), Mode::Radiance, how);
                mean.add(s ? throughput(*s, 2) : 0);
            }
            auto const a = agrees(mean, 0.7, 0.01, sidak(44));
            INFO(a);
            CHECK(a);
            CHECK(albedo(b, wo)[2] == 0.7f);
        }
}

TEST_CASE("extreme random numbers give no NaN and no density of 0") {
    Spectrum const eta(1.5f, 1.4f, 1.6f, 1.3f);
    for (Bsdf const& b : {Bsdf{DiffuseBsdf{Spectrum(1)}}, Bsdf{DielectricBsdf{eta, true}},
                          Bsdf{DielectricBsdf{Spectrum(0.5f), false}}, Bsdf{ThinDielectricBsdf{eta}},
                          Bsdf{ConductorBsdf{Spectrum(0.2f), Spectrum(3)}}})
        for (Vec3 const wo : outgoing())
            for (float const uc : kExtremes)
                for (float const x : kExtremes)
                    for (float const y : kExtremes)
                        for (auto const how : {HemisphereSampling::Cosine, HemisphereSampling::Uniform})
                            for (auto const mode : {Mode::Radiance, Mode::Importance}) {
                                auto const s = sample(b, wo, uc, {x, y}, mode, how);
                                if (!s) continue;
                                CHECK(s->pdf > 0);
                                CHECK(s->f.is_finite());
                                CHECK(std::abs(length(s->wi) - 1) < 1e-5f);
                                CHECK(s->wi.z != 0);
                            }
    // Directions within the surface scatter nothing.
    for (Bsdf const& b : {Bsdf{DiffuseBsdf{Spectrum(1)}}, Bsdf{DielectricBsdf{eta, true}},
                          Bsdf{ThinDielectricBsdf{eta}}, Bsdf{ConductorBsdf{Spectrum(0.2f), Spectrum(3)}}})
        CHECK_FALSE(sample(b, {1, 0, 0}, 0.5f, {0.5f, 0.5f}, Mode::Radiance, HemisphereSampling::Cosine));
}

TEST_CASE("smooth glass: reflected and transmitted parts make 1, each drawn as often as it weighs") {
    Random r(4);
    for (float const eta : {1.5f, 1.33f, 2.4f, 1 / 1.5f})
        for (Vec3 const wo : outgoing()) {
            Bsdf const b = DielectricBsdf{Spectrum(eta), false};
            CHECK(is_delta(b));
            CHECK(pdf(b, wo, {-wo.x, -wo.y, wo.z}, HemisphereSampling::Cosine) == 0);
            double const expected = static_cast<double>(fresnel_dielectric(wo.z, eta));
            auto const branches = delta_branches(b, wo, Mode::Importance);
            REQUIRE(branches.reflected);
            double const reflected = throughput(*branches.reflected);
            CHECK(reflected == doctest::Approx(expected).epsilon(1e-5));
            double const transmitted = branches.transmitted ? throughput(*branches.transmitted) : 0;
            CHECK(std::abs(reflected + transmitted - 1) <= 1e-6);
            CHECK(albedo(b, wo)[0] == 1);
            Mean reflection;
            for (int i = 0; i < 2000; ++i) {
                auto const s = sample(b, wo, (static_cast<float>(i) + r.unit()) / 2000, {0, 0},
                                      Mode::Importance, HemisphereSampling::Cosine);
                REQUIRE(s);
                REQUIRE(s->delta);
                CHECK(throughput(*s) == doctest::Approx(1).epsilon(1e-5));
                bool const same_side = s->wi.z * wo.z > 0;
                REQUIRE(s->transmitted != same_side);
                reflection.add(same_side);
                if (same_side) {
                    CHECK(s->wi == Vec3{-wo.x, -wo.y, wo.z});
                    CHECK(s->eta == 1);
                } else {
                    // n_transmitted / n_incident.
                    CHECK(s->eta == doctest::Approx(wo.z > 0 ? eta : 1 / eta));
                    // Snell's law.
                    double const si = std::hypot(wo.x, wo.y), st = std::hypot(s->wi.x, s->wi.y);
                    CHECK(si == doctest::Approx(static_cast<double>(s->eta) * st).epsilon(1e-5));
                }
            }
            CHECK(std::abs(reflection.mean() - expected) < 1.5e-3);
        }
}

TEST_CASE("refraction squeezes radiance by n^2 and leaves importance alone; f(i->o) / n_o^2 is reciprocal") {
    Random r(5);
    for (float const n : {1.5f, 1.33f, 2.4f})
        for (int i = 0; i < 200; ++i) {
            Bsdf const b = DielectricBsdf{Spectrum(n), false};
            Vec3 const wo = random_direction(r);
            auto const rad = delta_branches(b, wo, Mode::Radiance).transmitted;
            auto const imp = delta_branches(b, wo, Mode::Importance).transmitted;
            REQUIRE(rad.has_value() == imp.has_value());
            if (!rad || std::abs(rad->wi.z) < 0.05f || std::abs(wo.z) < 0.05f) continue;
            double const t = 1 - static_cast<double>(fresnel_dielectric(wo.z, n));
            double const relative =
                wo.z > 0 ? static_cast<double>(n) : 1 / static_cast<double>(n);  // n_i / n_o
            CHECK(throughput(*imp) == doctest::Approx(t).epsilon(1e-5));
            CHECK(throughput(*rad) == doctest::Approx(t / (relative * relative)).epsilon(1e-5));
            // f(i->o) / n_o^2 = f(o->i) / n_i^2 (Veach 1997, eq. 5.14). Deltas count by n^2 times projected solid angle,
            // which is the same on both sides, so that the transmittances are equal and the factors n^2 undo each other.
            auto const back = delta_branches(b, rad->wi, Mode::Radiance).transmitted;
            REQUIRE(back);
            CHECK(length(back->wi - wo) < 1e-4f);
            CHECK(throughput(*rad) * relative * relative ==
                  doctest::Approx(throughput(*back) / (relative * relative)).epsilon(1e-4));
        }
}

TEST_CASE("a slab of glass, all orders of reflection: T = (1-F)/(1+F) = 0.923077 at F = 0.04") {
    Bsdf const thin = ThinDielectricBsdf{Spectrum(1.5f)};
    auto const branches = delta_branches(thin, {0, 0, 1}, Mode::Radiance);
    REQUIRE(branches.transmitted);
    CHECK(throughput(*branches.transmitted) == doctest::Approx(0.9230769231).epsilon(1e-6));
    CHECK(throughput(*branches.reflected) == doctest::Approx(1 - 0.9230769231).epsilon(1e-5));
    // At 45 degrees, unpolarised at each bounce.
    auto const slant = delta_branches(thin, direction(kPiD / 4, 1), Mode::Radiance);
    CHECK(throughput(*slant.transmitted) == doctest::Approx(0.9043267915).epsilon(1e-5));
    // The same by following the boundaries of a real slab: weights of both Modes multiply to the same T.
    for (auto const mode : {Mode::Radiance, Mode::Importance}) {
        Bsdf const glass = DielectricBsdf{Spectrum(1.5f), false};
        auto const in = delta_branches(glass, {0, 0, 1}, mode);
        double inside = throughput(*in.transmitted);
        double out = 0;
        for (int k = 0; k < 60; ++k) {
            auto const at = delta_branches(glass, {0, 0, -1}, mode);
            if (k % 2 == 0) out += inside * throughput(*at.transmitted);
            inside *= throughput(*at.reflected);
        }
        CHECK(out == doctest::Approx(0.9230769231).epsilon(1e-5));
    }
}

TEST_CASE("thin dielectric: R' + T' = 1, straight through, n^2 does not count") {
    Random r(6);
    for (float const eta : {1.5f, 2.4f, 1.1f})
        for (Vec3 const wo : outgoing()) {
            Bsdf const b = ThinDielectricBsdf{Spectrum(eta)};
            for (auto const mode : {Mode::Radiance, Mode::Importance}) {
                auto const d = delta_branches(b, wo, mode);
                double const f = static_cast<double>(fresnel_dielectric(std::abs(wo.z), eta));
                double const reflected = 2 * f / (1 + f);  // R + T^2 R / (1 - R^2)
                CHECK(throughput(*d.reflected) == doctest::Approx(reflected).epsilon(1e-4));
                CHECK(std::abs(throughput(*d.reflected) + throughput(*d.transmitted) - 1) <= 2e-6);
                CHECK(d.transmitted->wi == -wo);
                CHECK(d.transmitted->eta == 1);
                CHECK_FALSE(d.transmitted->keep_hero);
            }
            Mean share;
            for (int i = 0; i < 2000; ++i) {
                auto const s = sample(b, wo, (static_cast<float>(i) + r.unit()) / 2000, {0, 0},
                                      Mode::Radiance, HemisphereSampling::Cosine);
                REQUIRE(s);
                CHECK(throughput(*s) == doctest::Approx(1).epsilon(1e-4));
                share.add(!s->transmitted);
            }
            double const f = static_cast<double>(fresnel_dielectric(std::abs(wo.z), eta));
            CHECK(std::abs(share.mean() - 2 * f / (1 + f)) < 1.5e-3);
        }
}

TEST_CASE("conductor: the mirrored direction with the reflectance of each lane") {
    Spectrum const eta(0.183f, 0.06f, 0.214f, 0.96f), k(3.43f, 3.59f, 3.67f, 6.69f);
    Bsdf const b = ConductorBsdf{eta, k};
    CHECK(is_delta(b));
    for (Vec3 const wo : outgoing()) {
        auto const s = sample(b, wo, 0.3f, {0.1f, 0.2f}, Mode::Radiance, HemisphereSampling::Cosine);
        REQUIRE(s);
        CHECK(s->wi == Vec3{-wo.x, -wo.y, wo.z});
        CHECK(s->pdf == 1);
        CHECK(s->delta);
        CHECK_FALSE(s->transmitted);
        CHECK_FALSE(s->keep_hero);
        for (int i = 0; i < 4; ++i) {
            double const f = static_cast<double>(fresnel_conductor(std::abs(wo.z), eta[i], k[i]));
            CHECK(throughput(*s, i) == doctest::Approx(f).epsilon(1e-5));
            CHECK(throughput(*s, i) <= 1 + 1e-4);
            CHECK(albedo(b, wo)[i] == doctest::Approx(f));
        }
        auto const d = delta_branches(b, wo, Mode::Radiance);
        CHECK(d.reflected);
        CHECK_FALSE(d.transmitted);
    }
}

TEST_CASE("dispersion: reflection keeps all lanes, refraction only the hero's") {
    Spectrum const eta(1.50f, 1.52f, 1.54f, 1.48f);
    Vec3 const wo = direction(0.9, 0.2);
    auto const dispersive = delta_branches(DielectricBsdf{eta, true}, wo, Mode::Radiance);
    REQUIRE(dispersive.reflected);
    REQUIRE(dispersive.transmitted);
    CHECK_FALSE(dispersive.reflected->keep_hero);
    CHECK(dispersive.transmitted->keep_hero);
    for (int i = 0; i < 4; ++i)
        CHECK(throughput(*dispersive.reflected, i) ==
              doctest::Approx(fresnel_dielectric(wo.z, eta[i])).epsilon(1e-5));
    // The hero's index bends the ray.
    double const si = std::hypot(wo.x, wo.y),
                 st = std::hypot(dispersive.transmitted->wi.x, dispersive.transmitted->wi.y);
    CHECK(si / st == doctest::Approx(1.50).epsilon(1e-5));
    CHECK_FALSE(
        delta_branches(DielectricBsdf{Spectrum(1.5f), false}, wo, Mode::Radiance).transmitted->keep_hero);
    // Over lanes that are heroes in turn, and with the hero standing for all, energy is kept lane by lane:
    // R_i comes with every hero, T_i only with hero i (weight 4 of 4 lanes).
    for (int hero = 0; hero < 4; ++hero) {
        Spectrum turned;
        for (int i = 0; i < 4; ++i) turned.set(i, eta[(i + hero) % 4]);
        auto const d = delta_branches(DielectricBsdf{turned, true}, wo, Mode::Importance);
        CHECK(throughput(*d.reflected) + throughput(*d.transmitted) == doctest::Approx(1).epsilon(1e-6));
    }
}
