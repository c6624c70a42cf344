// rgb -> reflectance -> rgb under D65, through what a film would sum.
#include "spectrum/uplift.h"

#include "quadrature.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace nephroid;

namespace {

struct UnderD65 {
    SpectrumStore store;
    RuntimeSpectrum light = store.compile(NamedSpd{"stdillum-D65"}, SpectrumRole::Illuminant)
                                .scaled(static_cast<float>(1 / photometric(NamedSpd{"stdillum-D65"})));

    [[nodiscard]] Vec3 see(SigmoidPolynomial const& reflectance) const {
        return mean_over_wavelengths(
            [&](Wavelengths const& w) { return to_linear_srgb(reflectance(w) * light.sample(w), w); }, 500);
    }
    [[nodiscard]] float error(Vec3 rgb) const { return max_component(abs(see(srgb_to_sigmoid(rgb)) - rgb)); }
};

}  // namespace

TEST_CASE("uplift: random colours come back") {
    UnderD65 const d65;
    Colors colors;
    double sum = 0;
    float worst = 0;
    int const n = 2000;
    for (int i = 0; i < n; ++i) {
        Vec3 const rgb = colors.color();
        float const e = d65.error(rgb);
        sum += static_cast<double>(e);
        worst = std::fmax(worst, e);
    }
    MESSAGE("largest component error: mean " << sum / n << ", maximum " << worst);
    CHECK(sum / n < 3e-4);
    CHECK(worst < 0.002f);
}

TEST_CASE("uplift: dark, bright and saturated colours come back") {
    UnderD65 const d65;
    float worst = 0;
    for (float bright : {0.001f, 0.01f, 0.1f, 0.5f, 0.9f, 0.99f, 1.0f})
        for (float low : {0.0f, 0.001f, 0.01f, 0.1f, 0.5f, 1.0f})
            for (float middle : {0.0f, 0.02f, 0.3f, 0.97f, 1.0f}) {
                float const a = bright * low, b = bright * middle;
                for (Vec3 rgb : {Vec3{bright, a, b}, Vec3{a, bright, b}, Vec3{a, b, bright}}) {
                    float const e = d65.error(rgb);
                    worst = std::fmax(worst, e);
                    CAPTURE(rgb.x);
                    CAPTURE(rgb.y);
                    CAPTURE(rgb.z);
                    CHECK(e < 0.004f);
                }
            }
    MESSAGE("maximum error near the edges of the cube: " << worst);
}

TEST_CASE("uplift: grays are flat") {
    for (float g : {0.0f, 0.001f, 0.25f, 0.5f, 0.8f, 1.0f}) {
        auto const s = srgb_to_sigmoid(Vec3(g));
        for (float l : {360.0f, 555.0f, 830.0f}) CHECK(s.at(l) == doctest::Approx(g).epsilon(1e-5));
    }
}

TEST_CASE("uplift: what is outside the cube is clamped to it") {
    auto const a = srgb_to_sigmoid({-0.5f, 0.25f, 3.0f});
    auto const b = srgb_to_sigmoid({0.0f, 0.25f, 1.0f});
    CHECK(a.c0 == b.c0);
    CHECK(a.c1 == b.c1);
    CHECK(a.c2 == b.c2);
}

TEST_CASE("uplift: reflectances stay within [0,1] and are continuous in the colour") {
    Colors colors;
    for (int i = 0; i < 200; ++i) {
        Vec3 const rgb = colors.color();
        auto const s = srgb_to_sigmoid(rgb);
        auto const near = srgb_to_sigmoid(rgb + Vec3(1e-5f, -1e-5f, 1e-5f));
        for (float l = 360; l <= 830; l += 10) {
            CHECK((s.at(l) >= 0 && s.at(l) <= 1));
            CHECK(std::abs(s.at(l) - near.at(l)) < 0.01f);
        }
    }
}
