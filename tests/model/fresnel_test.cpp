// Reflection and refraction at smooth boundaries, against values computed apart (in double, from the formulas named).
#include "model/fresnel.h"

#include "support.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("Fresnel reflectance of dielectrics: unpolarised mean of r_s^2 and r_p^2, eta = n_t / n_i") {
    struct Row {
        float eta;
        double r[6];  // at 0, 30, 45, 60, 75, 85 degrees
    };
    double const degrees[6] = {0, 30, 45, 60, 75, 85};
    for (Row const& row :
         {Row{1.5f, {0.04, 0.04152262598, 0.05023991101, 0.0891867128, 0.253060563, 0.6127996453}},
          Row{1.33f, {0.0200593122, 0.02111245787, 0.02752138356, 0.05912559925, 0.2114266041, 0.5827282449}},
          Row{2.0f / 3.0f, {0.04, 0.0551901673, 1, 1, 1, 1}},
          Row{2.4f, {0.169550173, 0.1710603257, 0.1788169988, 0.2093512608, 0.3297739349, 0.6221969146}}})
        for (int i = 0; i < 6; ++i) {
            auto const c = static_cast<float>(std::cos(degrees[i] * kPiD / 180));
            CAPTURE(row.eta);
            CAPTURE(degrees[i]);
            CHECK(fresnel_dielectric(c, row.eta) == doctest::Approx(row.r[i]).epsilon(1e-5));
            // From inside, at the same angle, with the index the other way round.
            CHECK(fresnel_dielectric(-c, 1 / row.eta) == doctest::Approx(row.r[i]).epsilon(1e-5));
        }
}

TEST_CASE("hemispherical means of the Fresnel reflectance, 2 int F(c) c dc") {
    struct Row {
        float eta;
        double mean;
    };
    for (Row const& row :
         {Row{1.5f, 0.09177795954}, Row{1.33f, 0.0659308495}, Row{2.0f / 3.0f, 0.5963452757}}) {
        double sum = 0;
        int const n = 200'000;
        for (int i = 0; i < n; ++i) {
            float const c = (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
            sum += 2.0 * static_cast<double>(c) * static_cast<double>(fresnel_dielectric(c, row.eta)) / n;
        }
        CHECK(sum == doctest::Approx(row.mean).epsilon(2e-5));
    }
}

TEST_CASE("Fresnel reflectance of conductors with index n + ik") {
    struct Row {
        float n, k;
        double r[3];  // at 0, 60, 80 degrees
    };
    double const degrees[3] = {0, 60, 80};
    for (Row const& row : {Row{0.183f, 3.43f, {0.9443954444, 0.9388588987, 0.9481117105}},    // Au 633 nm
                           Row{0.06f, 3.59f, {0.9828714574, 0.9808372714, 0.983008892}},      // Ag 550 nm
                           Row{0.214f, 3.67f, {0.9427144874, 0.936258258, 0.9425032346}},     // Cu 650 nm
                           Row{0.96f, 6.69f, {0.9209839149, 0.9067464854, 0.8676193027}}}) {  // Al 550 nm
        for (int i = 0; i < 3; ++i) {
            auto const c = static_cast<float>(std::cos(degrees[i] * kPiD / 180));
            CAPTURE(row.n);
            CAPTURE(degrees[i]);
            CHECK(fresnel_conductor(c, row.n, row.k) == doctest::Approx(row.r[i]).epsilon(1e-5));
        }
    }
    // Without absorption a conductor is a dielectric.
    for (float c = 0.01f; c < 1; c += 0.03f)
        for (float const eta : {1.2f, 1.5f, 2.4f})
            CHECK(fresnel_conductor(c, eta, 0) == doctest::Approx(fresnel_dielectric(c, eta)).epsilon(1e-4));
    CHECK(fresnel_conductor(0.5f, 0, 0) == 1);
}

TEST_CASE("Fresnel reflectances lie in [0, 1] and are 1 at grazing incidence") {
    Random r(1);
    for (int i = 0; i < 100'000; ++i) {
        auto const eta = static_cast<float>(std::exp(r.uniform(-1.5, 1.5)));
        auto const k = static_cast<float>(std::exp(r.uniform(-5, 3)));
        float const c = i % 3 ? r.unit() : static_cast<float>(std::exp(r.uniform(-20, 0)));
        float const d = fresnel_dielectric(i % 2 ? c : -c, eta);
        float const m = fresnel_conductor(c, eta, k);
        REQUIRE((d >= 0 && d <= 1 && m >= 0 && m <= 1 + 1e-6f));
    }
    for (float const eta : {0.5f, 1.0f, 1.5f}) {
        CHECK(fresnel_dielectric(0, eta) == doctest::Approx(1));
        CHECK(fresnel_conductor(0, eta, 2) == doctest::Approx(1));
    }
    CHECK(fresnel_dielectric(0.5f, 1) == doctest::Approx(0));
    CHECK(std::isfinite(fresnel_dielectric(1.0000002f, 1.5f)));
    // All four lanes go by their own index.
    Spectrum const lanes = fresnel_dielectric(0.5f, Spectrum(1.1f, 1.5f, 2, 0.5f));
    for (int i = 0; i < 4; ++i) CHECK(lanes[i] == fresnel_dielectric(0.5f, Spectrum(1.1f, 1.5f, 2, 0.5f)[i]));
}

TEST_CASE("refraction: Snell's law, the plane of incidence, the way back, total reflection") {
    Random r(2);
    int total = 0;
    for (int i = 0; i < 100'000; ++i) {
        Vec3 const wi = random_direction(r);
        auto const n = static_cast<float>(std::exp(r.uniform(-1, 1)));
        float eta = n;
        Vec3 wt{0, 0, 0};
        // Below the surface, light is inside: the index is the other way round.
        double const relative = wi.z > 0 ? static_cast<double>(n) : 1 / static_cast<double>(n);
        double const sin_i = std::sqrt(static_cast<double>(wi.x) * wi.x + static_cast<double>(wi.y) * wi.y);
        if (!refract(wi, eta, wt)) {
            ++total;
            REQUIRE(sin_i / relative >= 1 - 1e-6);
            CHECK(fresnel_dielectric(wi.z, n) >= 0.99f);
            continue;
        }
        REQUIRE(sin_i / relative <= 1 + 1e-6);
        REQUIRE(static_cast<double>(eta) == doctest::Approx(relative).epsilon(1e-6));
        REQUIRE(wt.z * wi.z < 0);
        REQUIRE(std::abs(length(wt) - 1) < 1e-5f);
        double const sin_t = std::sqrt(static_cast<double>(wt.x) * wt.x + static_cast<double>(wt.y) * wt.y);
        REQUIRE(sin_i == doctest::Approx(relative * sin_t).epsilon(1e-5));
        // To the opposite azimuth, in one plane.
        REQUIRE(std::abs(wi.x * wt.y - wi.y * wt.x) < 1e-6f);
        REQUIRE(wi.x * wt.x + wi.y * wt.y <= 1e-9f);
        float back_eta = n;
        Vec3 back{0, 0, 0};
        // Where the way out grazes the surface the angle is steep in the index: look away from there.
        if (std::abs(wt.z) > 0.05f && std::abs(wi.z) > 0.05f) {
            REQUIRE(refract(wt, back_eta, back));
            REQUIRE(length(back - wi) < 1e-4f);
            REQUIRE(back_eta * eta == doctest::Approx(1));
            // Reflectances are the same from both sides of one ray.
            CHECK(fresnel_dielectric(wi.z, n) == doctest::Approx(fresnel_dielectric(wt.z, n)).epsilon(1e-3));
        }
    }
    CHECK(total > 5000);
    // The critical angle of n = 1.5 from inside: 41.81 degrees.
    Vec3 wt{0, 0, 0};
    float eta = 1.5f;
    CHECK(refract(direction(kPiD - 41.7 * kPiD / 180, 1), eta, wt));
    eta = 1.5f;
    CHECK_FALSE(refract(direction(kPiD - 41.9 * kPiD / 180, 1), eta, wt));
}

TEST_CASE("Brewster's angle: at tan = n the reflected light is s-polarised alone") {
    double const t = std::atan(1.5);
    double const s = std::pow((std::cos(t) - 1.5 * std::sin(t)) / (std::cos(t) + 1.5 * std::sin(t)), 2);
    // At that angle cos_t = sin_i.
    CHECK(fresnel_dielectric(static_cast<float>(std::cos(t)), 1.5f) == doctest::Approx(s / 2).epsilon(1e-5));
}
