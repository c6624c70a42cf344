#include "spectrum/runtime.h"

#include "math/error.h"
#include "quadrature.h"

#include <doctest/doctest.h>

#include <limits>

using namespace nephroid;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

RuntimeSpectrum emission(SpectrumStore& store, Spd const& spd) {
    return store.compile(spd, SpectrumRole::Illuminant).scaled(static_cast<float>(1 / photometric(spd)));
}
Vec3 seen(RuntimeSpectrum const& s) {
    return mean_over_wavelengths([&](auto const& w) { return to_linear_srgb(s.sample(w), w); }, 500);
}

}  // namespace

TEST_CASE("runtime: an rgb emission is seen as this rgb, in both modes") {
    SpectrumStore store;
    Colors colors;
    for (int i = 0; i < 40; ++i) {
        // Away from the most saturated ones, and of any brightness.
        Vec3 const rgb = (Vec3(0.1f) + 0.9f * colors.color()) * std::exp2(12.0f * colors.next() - 6.0f);
        auto const light = emission(store, RgbIlluminantSpd{rgb});
        Vec3 const spectral = seen(light);
        Vec3 const direct = to_linear_srgb(light.sample(Wavelengths::rgb()), Wavelengths::rgb());
        float const m = max_component(rgb);
        CHECK(max_component(abs(spectral - rgb)) < 0.002f * m);
        CHECK(max_component(abs(direct - rgb)) < 1e-6f * m);
    }
    CHECK(max_component(abs(seen(emission(store, RgbIlluminantSpd{{1, 1, 1}})) - Vec3(1.0f))) < 1e-4f);
}

TEST_CASE("runtime: an rgb emission of ACES is a share of D60") {
    SpectrumStore store;
    auto const d60 = emission(store, NamedSpd{"illum-acesD60"});
    auto const white = emission(store, RgbIlluminantSpd{{1, 1, 1}, RgbWhite::AcesD60});
    for (float const lambda : {400.0f, 500.0f, 600.0f, 700.0f})
        CHECK(white.at(lambda) == doctest::Approx(d60.at(lambda)).epsilon(1e-3));
    CHECK(max_component(abs(white.rgb() - d60.rgb())) < 1e-6f);
    CHECK(max_component(abs(seen(white) - seen(d60))) < 1e-3f);
    // Redder than D65, of the same luminance.
    CHECK(white.rgb().x > 1.02f);
    CHECK(luminance(white.rgb()) == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("runtime: an rgb reflectance under neutral light is seen as this rgb") {
    SpectrumStore store;
    auto const white = emission(store, RgbIlluminantSpd{{1, 1, 1}});
    Colors colors;
    for (int i = 0; i < 40; ++i) {
        Vec3 const rgb = colors.color();
        auto const albedo = store.compile(RgbAlbedoSpd{rgb}, SpectrumRole::Albedo);
        auto const mean = mean_over_wavelengths(
            [&](auto const& w) { return to_linear_srgb(albedo.sample(w) * white.sample(w), w); }, 500);
        CHECK(max_component(abs(mean - rgb)) < 0.002f);
        CHECK(albedo.rgb() == rgb);
    }
}

TEST_CASE("runtime: unbounded triples keep their scale") {
    SpectrumStore store;
    auto const s = store.compile(RgbUnboundedSpd{{20, 20, 20}}, SpectrumRole::Unbounded);
    CHECK(s.at(500) == doctest::Approx(20));
    CHECK(s.max_value() == doctest::Approx(20));
    auto const black = store.compile(RgbUnboundedSpd{{0, 0, 0}}, SpectrumRole::Unbounded);
    CHECK(black.is_black());
    CHECK(black.sample(Wavelengths::spectral(0.1f)).is_black());
}

TEST_CASE("runtime: constants") {
    SpectrumStore store;
    auto const eta = store.compile(ConstantSpd{1.5f}, SpectrumRole::Unbounded);
    CHECK(eta.is_constant());
    CHECK(eta.rgb() == Vec3(1.5f));
    CHECK(eta.at(444) == 1.5f);
    CHECK(eta.sample(Wavelengths::spectral(0.2f)).max() == 1.5f);
    CHECK(eta.max_value() == 1.5f);
    CHECK(eta.scaled(2).rgb() == Vec3(3.0f));
    CHECK(eta.scaled(2).at(500) == 3.0f);
    CHECK(store.compile(ConstantSpd{1.5f}, SpectrumRole::Albedo).rgb() == Vec3(1.0f));
    CHECK(store.compile(ConstantSpd{0}, SpectrumRole::Illuminant).is_black());
    CHECK(RuntimeSpectrum{}.is_black());
    // As a light, a constant is equal-energy white, which is reddish in sRGB.
    Vec3 const e = emission(store, ConstantSpd{3}).rgb();
    CHECK(luminance(e) == doctest::Approx(1).epsilon(1e-5));
    CHECK(e.x > e.y);
    CHECK(store.bytes() == 0);
}

TEST_CASE("runtime: tables") {
    SpectrumStore store;
    TabulatedSpd const t{{400, 500, 600}, {1, 3, 2}};
    auto const s = store.compile(t, SpectrumRole::Unbounded);
    CHECK(!s.is_constant());
    CHECK(s.at(400) == doctest::Approx(1));
    CHECK(s.at(450) == doctest::Approx(2));
    CHECK(s.at(575.5f) == doctest::Approx(2.245));
    CHECK(s.at(399) == 0);
    CHECK(s.at(601) == 0);
    CHECK(s.max_value() == doctest::Approx(3));
    auto const w = Wavelengths::spectral(0.37f);
    for (int i = 0; i < 4; ++i) CHECK(s.sample(w)[i] == doctest::Approx(s.at(w.lambda(i))));
    // One table for equal data, by whatever name and role.
    auto const before = store.bytes();
    store.compile(t, SpectrumRole::Albedo);
    store.compile(NamedSpd{"glass-SF11"}, SpectrumRole::Unbounded);
    store.compile(NamedSpd{"glass-F11"}, SpectrumRole::Unbounded);
    CHECK(store.bytes() == 2 * before);
}

TEST_CASE("runtime: a line narrower than the table's steps keeps its energy") {
    SpectrumStore store;
    for (float at : {555.0f, 555.3f, 589.5f}) {
        CAPTURE(at);
        TabulatedSpd const line{{at - 0.1f, at, at + 0.1f}, {0, 100, 0}};  // 10 in all
        double const y = photometric(line);
        double const near = photometric(TabulatedSpd{{at - 2, at, at + 2}, {0, 5, 0}});
        CHECK(y == doctest::Approx(near).epsilon(0.01));
        auto const s = emission(store, line);
        CHECK(luminance(srgb_to_xyz(s.rgb())) > 0);
        CHECK(mean_over_wavelengths([&](auto const& w) { return to_xyz(s.sample(w), w); }, 20000).y ==
              doctest::Approx(1).epsilon(0.01));
    }
}

TEST_CASE("runtime: reflectances in rgb mode are their colour under D65") {
    SpectrumStore store;
    TabulatedSpd const half{{300, 900}, {0.5f, 0.5f}};
    Vec3 const gray = store.compile(half, SpectrumRole::Albedo).rgb();
    CHECK(max_component(abs(gray - Vec3(0.5f))) < 1e-5f);
    TabulatedSpd const red{{580, 590, 830}, {0, 4, 4}};
    Vec3 const clamped = store.compile(red, SpectrumRole::Albedo).rgb();
    Vec3 const free = store.compile(red, SpectrumRole::Unbounded).rgb();
    CHECK(clamped.x == 1);
    CHECK(clamped.z >= 0);
    CHECK(free.x > 1);
    CHECK(free.z == 0);
}

TEST_CASE("runtime: black bodies have their maximum, 1, where Wien says") {
    SpectrumStore store;
    for (float kelvin : {3600.0f, 5000.0f, 6500.0f, 8000.0f}) {
        auto const s = store.compile(BlackbodySpd{kelvin}, SpectrumRole::Illuminant);
        float const peak = 2.897771955e6f / kelvin;
        if (peak < 830) CHECK(s.at(peak) == doctest::Approx(1).epsilon(1e-4));
        CHECK(s.at(clamp(peak - 30, 360, 830)) < 1);
        CHECK(s.at(clamp(peak + 30, 360, 830)) < 1);
    }
    // Planck's law at 1000 K is deep in the red; nothing overflows in the violet.
    auto const ember = store.compile(BlackbodySpd{100}, SpectrumRole::Illuminant);
    CHECK(std::isfinite(ember.at(360)));
    Vec3 const warm = emission(store, BlackbodySpd{2700}).rgb();
    CHECK(warm.x > warm.y);
    CHECK(warm.y > warm.z);
}

TEST_CASE("runtime: the largest value bounds all samples") {
    SpectrumStore store;
    Colors colors;
    for (int i = 0; i < 50; ++i) {
        Vec3 const rgb = 5.0f * colors.color();
        for (Spd const& spd : {Spd{RgbUnboundedSpd{rgb}}, Spd{RgbIlluminantSpd{rgb}}}) {
            auto const s = store.compile(spd, SpectrumRole::Unbounded);
            float const bound = s.max_value() * 1.00001f;
            for (int k = 0; k < 50; ++k)
                CHECK(s.sample(Wavelengths::spectral(static_cast<float>(k) / 50)).max() <= bound);
            CHECK(max_component(s.rgb()) <= bound);
        }
    }
}

TEST_CASE("runtime: what is refused") {
    SpectrumStore store;
    Spd const bad[] = {
        ConstantSpd{kNan},
        ConstantSpd{kInfinity},
        NamedSpd{"metal-Xx-eta"},
        BlackbodySpd{-5},
        BlackbodySpd{kNan},
        TabulatedSpd{},
        TabulatedSpd{{400, 500}, {1}},
        TabulatedSpd{{500, 400}, {1, 1}},
        TabulatedSpd{{400, 400}, {1, 1}},
        TabulatedSpd{{400, kNan}, {1, 1}},
        TabulatedSpd{{400, 500}, {1, kInfinity}},
        RgbAlbedoSpd{{0, kNan, 0}},
        RgbUnboundedSpd{{kInfinity, 0, 0}},
        RgbIlluminantSpd{{0, 0, -1}},
    };
    for (auto const& spd : bad) CHECK_THROWS_AS(store.compile(spd, SpectrumRole::Illuminant), Error);
    CHECK_THROWS_AS((void)photometric(TabulatedSpd{{500, 400}, {1, 1}}), Error);
    CHECK_THROWS_AS((void)photometric(NamedSpd{"?"}), Error);
}
