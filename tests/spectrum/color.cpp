#include "spectrum/color.h"

#include "quadrature.h"
#include "spectrum/named.h"
#include "spectrum/runtime.h"

#include <doctest/doctest.h>

using namespace nephroid;

namespace {

bool near(Vec3 a, Vec3 b, float tolerance) { return max_component(abs(a - b)) <= tolerance; }

/// The three integrals, by way of rgb mode.
Vec3 xyz_of(Spd const& spd) {
    SpectrumStore store;
    return srgb_to_xyz(store.compile(spd, SpectrumRole::Illuminant).rgb());
}
Vec2 xy_of(Spd const& spd) {
    Vec3 const v = xyz_of(spd);
    return {v.x / (v.x + v.y + v.z), v.y / (v.x + v.y + v.z)};
}

}  // namespace

TEST_CASE("color: integrals of the matching functions") {
    // The sum of the tabulated y-bar, to the digits in which copies of the table agree.
    CHECK(photometric(ConstantSpd{1}) == doctest::Approx(106.856895).epsilon(5e-7));
    Vec3 const e = xyz_of(ConstantSpd{1});
    CHECK(e.x == doctest::Approx(106.8655).epsilon(1e-5));
    CHECK(e.z == doctest::Approx(106.8923).epsilon(1e-5));
    Vec2 const xy = xy_of(ConstantSpd{2});
    CHECK(xy.x == doctest::Approx(1.0 / 3).epsilon(2e-4));
    CHECK(xy.y == doctest::Approx(1.0 / 3).epsilon(2e-4));
}

TEST_CASE("color: chromaticities of illuminants") {
    struct {
        char const* name;
        double x, y;
    } const cases[] = {// CIE 015:2018; ACES: SMPTE ST 2065-1
                       {"stdillum-D65", 0.31272, 0.32903},
                       {"stdillum-D50", 0.3368, 0.3580},  // pbrt-v4's, see data_illuminants.cpp
                       {"stdillum-A", 0.44758, 0.40745},
                       {"stdillum-F2", 0.3721, 0.3751},
                       {"stdillum-F11", 0.3805, 0.3769},
                       {"illum-acesD60", 0.32168, 0.33767}};
    for (auto const& c : cases) {
        CAPTURE(std::string(c.name));
        Vec2 const xy = xy_of(NamedSpd{c.name});
        CHECK(std::abs(static_cast<double>(xy.x) - c.x) < 3e-4);
        CHECK(std::abs(static_cast<double>(xy.y) - c.y) < 3e-4);
    }
    // The whites that the colour spaces are built on are just these.
    CHECK(xy_of(NamedSpd{"stdillum-D65"}).x == doctest::Approx(kSrgb.w.x).epsilon(1e-6));
    CHECK(xy_of(NamedSpd{"stdillum-D65"}).y == doctest::Approx(kSrgb.w.y).epsilon(1e-6));
    CHECK(xy_of(NamedSpd{"illum-acesD60"}).x == doctest::Approx(kAces2065.w.x).epsilon(1e-6));
    CHECK(xy_of(NamedSpd{"illum-acesD60"}).y == doctest::Approx(kAces2065.w.y).epsilon(1e-6));
}

TEST_CASE("color: matrices") {
    // IEC 61966-2-1 prints four digits.
    Matrix3 const m = rgb_to_xyz(kSrgb);
    double const iec[3][3] = {{.4124, .3576, .1805}, {.2126, .7152, .0722}, {.0193, .1192, .9505}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) CHECK(std::abs(m[i][j] - iec[i][j]) < 2e-4);
    for (std::size_t j = 0; j < 3; ++j) {
        Vec3 unit(0.0f);
        unit[static_cast<int>(j)] = 1;
        CHECK(luminance(unit) == doctest::Approx(m[1][j]).epsilon(1e-6));
    }
    CHECK(luminance({1, 1, 1}) == doctest::Approx(1));
    Vec3 const c{0.2f, 0.5f, 0.9f};
    CHECK(near(xyz_to_srgb(srgb_to_xyz(c)), c, 1e-6f));
    for (auto const* space : {&kSrgb, &kDciP3, &kRec2020, &kAces2065}) {
        CHECK(near(convert_rgb(convert_rgb(c, kSrgb, *space), *space, kSrgb), c, 1e-6f));
        CHECK(near(convert_rgb({1, 1, 1}, *space, kSrgb), {1, 1, 1}, 1e-6f));
    }
    // BT.2087, from BT.709's primaries to BT.2020's.
    CHECK(near(convert_rgb({1, 0, 0}, kSrgb, kRec2020), {0.6274f, 0.0691f, 0.0164f}, 1e-4f));
}

TEST_CASE("color: white balance takes one white to the other") {
    Vec2 const a{0.44758f, 0.40745f};
    auto const xyz = [](Vec2 xy) { return Vec3{xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y}; };
    CHECK(near(white_balance(a, kSrgb.w) * xyz(a), xyz(kSrgb.w), 1e-6f));
    CHECK(near(white_balance(a, a) * Vec3{0.3f, 0.4f, 0.5f}, {0.3f, 0.4f, 0.5f}, 1e-6f));
}

TEST_CASE("color: daylight") {
    CHECK(daylight_xy(6500).x == doctest::Approx(0.3127).epsilon(2e-4));
    CHECK(daylight_xy(6500).y == doctest::Approx(0.3291).epsilon(3e-4));
    CHECK(daylight_xy(5000).x == doctest::Approx(0.3457).epsilon(5e-4));
    CHECK(daylight_xy(5000).y == doctest::Approx(0.3586).epsilon(5e-4));
    // Illuminant A is a black body of 2848 K by the c2 of its time.
    CHECK(daylight_xy(2848).x == doctest::Approx(0.4476).epsilon(1e-3));
    CHECK(daylight_xy(2848).y == doctest::Approx(0.4074).epsilon(1e-3));
}

TEST_CASE("color: what the film sums is the integral") {
    SpectrumStore store;
    for (char const* name : {"stdillum-D65", "stdillum-A", "stdillum-D50"}) {
        auto const light = store.compile(NamedSpd{name}, SpectrumRole::Illuminant);
        Vec3 const rgb =
            mean_over_wavelengths([&](auto const& w) { return to_linear_srgb(light.sample(w), w); });
        Vec3 const xyz = mean_over_wavelengths([&](auto const& w) { return to_xyz(light.sample(w), w); });
        float const y = static_cast<float>(photometric(NamedSpd{name}));
        CHECK(near(rgb, light.rgb(), 2e-4f * y));
        CHECK(near(xyz, srgb_to_xyz(light.rgb()), 2e-4f * y));
        CHECK(xyz.y == doctest::Approx(y).epsilon(2e-4));
    }
    auto const rgb = Wavelengths::rgb();
    CHECK(to_linear_srgb({0.1f, 0.2f, 0.3f, 0.0f}, rgb) == Vec3(0.1f, 0.2f, 0.3f));
    CHECK(near(to_xyz({0.1f, 0.2f, 0.3f, 0.0f}, rgb), srgb_to_xyz({0.1f, 0.2f, 0.3f}), 1e-7f));
}

TEST_CASE("color: photometric") {
    CHECK(photometric(NamedSpd{"stdillum-D65"}) == doctest::Approx(10567.08).epsilon(1e-6));
    CHECK(photometric(RgbIlluminantSpd{{0.1f, 0.9f, 0.3f}}) == photometric(NamedSpd{"stdillum-D65"}));
    CHECK(photometric(RgbAlbedoSpd{{0.5f, 0.5f, 0.5f}}) == doctest::Approx(0.5 * 106.8569).epsilon(1e-5));
    CHECK(photometric(RgbUnboundedSpd{{3, 3, 3}}) == doctest::Approx(3 * 106.8569).epsilon(1e-5));
}
