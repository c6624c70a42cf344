// Lambert's law on both sides of a sheet: what every model must do, its values, and what too bright parameters become.
#include "bsdf_checks.h"
#include "model/material.h"
#include "model/texture.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

DiffuseTransmissionBsdf made(Vec3 reflectance, Vec3 transmittance, float scale) {
    Scene s;
    DiffuseTransmissionMaterial m;
    m.reflectance = add_color(s, reflectance);
    m.transmittance = add_color(s, transmittance);
    m.scale = scale;
    MaterialId const id = s.add(Material{m});
    Assets const assets(s);
    Bsdf b;
    REQUIRE(make_bsdf(assets, id, {}, Wavelengths::rgb(), b));
    return std::get<DiffuseTransmissionBsdf>(b);
}

}  // namespace

TEST_CASE("diffuse transmission: samples, reciprocity, energy, for sheets from opaque to clear") {
    for (auto const how : {HemisphereSampling::Cosine, HemisphereSampling::Uniform})
        for (float const t : {0.0f, 0.2f, 0.5f, 0.9f, 1.0f}) {
            Bsdf const b = DiffuseTransmissionBsdf{Spectrum(1 - t), Spectrum(t)};
            CAPTURE(t);
            BsdfChecks c{.n = samples(20'000, 1'000'000), .family = 220, .how = how};
            check_samples(b, c);
            check_reciprocity(b, c, 0);
            c.albedo = 1e-4;
            check_energy(b, c);
        }
}

TEST_CASE("diffuse transmission: R / pi on this side, T / pi on the other, nothing in the surface") {
    Spectrum const r(0.1f, 0.2f, 0.3f, 0.4f), t(0.6f, 0.5f, 0.1f, 0.0f);
    Bsdf const b = DiffuseTransmissionBsdf{r, t};
    CHECK(traits(b).spreads_through);
    CHECK_FALSE(traits(b).delta);
    Random n(1);
    for (int i = 0; i < 1000; ++i) {
        Vec3 const wo = random_direction(n), wi = random_direction(n);
        for (auto const mode : {Mode::Radiance, Mode::Importance})
            for (int k = 0; k < 4; ++k)
                CHECK(evaluate(b, wo, wi, mode)[k] ==
                      doctest::Approx((wo.z * wi.z > 0 ? r[k] : t[k]) / kPiD).epsilon(1e-6));
    }
    CHECK(evaluate(b, {0, 0, 1}, {1, 0, 0}, Mode::Radiance).is_black());
    CHECK(pdf(b, {0, 0, 1}, {1, 0, 0}, HemisphereSampling::Uniform) == 0);
    // Reflection is drawn by the largest lanes: .4 of .4 + .6.
    Mean reflected;
    for (int i = 0; i < 1000; ++i)
        reflected.add(!sample(b, {0, 0, 1}, (static_cast<float>(i) + 0.5f) / 1000, random_square(n),
                              Mode::Radiance, HemisphereSampling::Cosine)
                           ->transmitted);
    CHECK(reflected.mean() == doctest::Approx(0.4).epsilon(0.01));
    Bsdf const black = DiffuseTransmissionBsdf{};
    CHECK_FALSE(sample(black, {0, 0, 1}, 0.5f, {0.5f, 0.5f}, Mode::Radiance, HemisphereSampling::Cosine));
    CHECK(pdf(black, {0, 0, 1}, {0, 0, 1}, HemisphereSampling::Cosine) == 0);
}

TEST_CASE("diffuse transmission: a lane that would give more light than it gets is scaled down") {
    auto const b = made({0.25f, 0.5f, 0.75f}, {0.25f, 0.5f, 0.75f}, 1);
    CHECK(b.reflectance[0] == doctest::Approx(0.25f));
    CHECK(b.reflectance[1] == doctest::Approx(0.5f));
    CHECK(b.reflectance[2] == doctest::Approx(0.5f));
    CHECK(b.transmittance[2] == doctest::Approx(0.5f));
    auto const scaled = made({0.1f, 0.4f, 1.0f}, {0.2f, 0.8f, 0.0f}, 2);
    CHECK(scaled.reflectance[0] == doctest::Approx(0.2f));
    CHECK(scaled.transmittance[0] == doctest::Approx(0.4f));
    // .8 and 1 (clamped from 1.6) by their sum.
    CHECK(scaled.reflectance[1] == doctest::Approx(0.8 / 1.8));
    CHECK(scaled.transmittance[1] == doctest::Approx(1 / 1.8));
    CHECK(scaled.reflectance[2] == 1);
    CHECK(made({1, 1, 1}, {1, 1, 1}, 0).reflectance.max() == 0);
    check_energy(Bsdf{made({1, 1, 1}, {1, 1, 1}, 1)}, {.n = 20'000});
}
