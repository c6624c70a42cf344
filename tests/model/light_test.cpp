// Lights: what arrives, with which density, and how power and illuminance set the scale.
#include "lights.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Vec3 sky_with_sun(int x, int y, int sx, int sy) {
    Vec3 v{0.2f + 0.01f * static_cast<float>(x % 5), 0.3f, 0.4f + 0.01f * static_cast<float>(y % 3)};
    if (x == sx && y == sy) v = {400, 380, 300};
    if (y % 11 == 5) v = {0, 0, 0};  // black bands
    return v;
}

}  // namespace

TEST_CASE("point light: inverse square, towards the light, from its place in the world") {
    Lit const l(PointLight{RgbIlluminantSpd{{1, 1, 1}}, 3, -1, {1, 0, 0}}, translate(0, 2, 0));
    CHECK(is_delta(l.light()));
    CHECK_FALSE(is_infinite(l.light()));
    auto const s = l.sample({1, 2, -2}, {0.3f, 0.4f});
    REQUIRE(s);
    CHECK(s->wi == Vec3{0, 0, 1});
    CHECK(s->p == Vec3{1, 2, 0});
    CHECK(s->pdf == 1);
    CHECK(s->delta);
    CHECK_FALSE(s->at_infinity);
    CHECK(luminance_of(s->radiance) == doctest::Approx(3.0 / 4).epsilon(1e-3));
    CHECK(spectral_luminance([&](Wavelengths const& w) {
              return l.sample({1, 2, -2}, {0, 0}, w)->radiance;
          }) == doctest::Approx(3.0 / 4).epsilon(1e-3));
    auto const far = l.sample({1, 2, -20}, {0.3f, 0.4f});
    CHECK(far->radiance[1] * 100 == doctest::Approx(s->radiance[1]));
    CHECK_FALSE(l.sample({1, 2, 0}, {0, 0}));
    CHECK(l.radiance({0, 0, 1}).is_black());
    CHECK(l.pdf({0, 0, 1}) == 0);
}

TEST_CASE("spot light: full within the inner cone, none beyond the outer, smoothstep in the cosine between") {
    float const outer = 0.7f, delta = 0.2f;
    Lit const l(SpotLight{RgbIlluminantSpd{{1, 1, 1}}, 5, -1, {0, 0, 0}, {0, 0, 2}, outer, delta});
    auto const at = [&](double theta) {
        auto const s = l.sample(direction(theta, 0.3) * 2.0f, {0, 0});
        return s ? luminance_of(s->radiance) * 4 : 0.0;
    };
    CHECK(at(0) == doctest::Approx(5).epsilon(1e-3));
    CHECK(at(0.49) == doctest::Approx(5).epsilon(1e-3));
    CHECK(at(0.71) == 0);
    CHECK(at(3) == 0);
    double const co = std::cos(0.7), ci = std::cos(0.5);
    for (double const c : {0.1, 0.3, 0.5, 0.8})
        CHECK(at(std::acos(co + c * (ci - co))) ==
              doctest::Approx(5 * (3 * c * c - 2 * c * c * c)).epsilon(2e-3));
    CHECK(is_delta(l.light()));
}

TEST_CASE(
    "power in lumens is what a point or spot light emits in all at scale 1; scale multiplies it, as in "
    "pbrt-v4") {
    Random r(1);
    for (auto const& kind :
         {LightKind{PointLight{BlackbodySpd{3000}, 2, 500, {0, 0, 0}}},
          LightKind{SpotLight{NamedSpd{"stdillum-F2"}, 1, 1000, {0, 0, 0}, {0, 1, 0.3f}, 0.9f, 0.4f}}}) {
        Lit const l(kind, turned());
        // Luminous flux: the mean over the sphere of illuminance at distance 1.
        Mean flux;
        double const y = spectral_luminance([&](Wavelengths const& w) {
            return l.sample(l.data.position + l.data.direction, {0, 0}, w)->radiance;
        });
        double const peak = static_cast<double>(
            l.sample(l.data.position + l.data.direction, {0, 0}, Wavelengths::spectral(0.1f))->radiance[0]);
        for (int batch = 0; batch < 64; ++batch) {
            double sum = 0;
            int const side = 40;
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i) {
                    double const z = 2 * (j + r.uniform()) / side - 1,
                                 phi = 2 * kPiD * (i + r.uniform()) / side;
                    // Stratified about the axis.
                    Vec3 const d = frame_from_z(l.data.direction).from_local(direction(std::acos(z), phi));
                    auto const s = l.sample(l.data.position + d, {0, 0}, Wavelengths::spectral(0.1f));
                    if (s) sum += static_cast<double>(s->radiance[0]) / peak * y;
                }
            flux.add(sum / (side * side) * 4 * kPiD);
        }
        auto const a = agrees(flux, 1000, 0.005);
        INFO(a);
        // Photometric normalisation itself is good to 1e-3: allow the interval that much.
        CHECK(a.half_width <= 5);
        CHECK(std::abs(a.mean - 1000) <= a.half_width + 1);
    }
}

TEST_CASE("distant light: parallel, the same everywhere; illuminance in lux") {
    Lit const l(DistantLight{RgbIlluminantSpd{{1, 1, 1}}, 2, -1, {0, 5, 0}, {0, 0, 0}}, turned());
    Vec3 const up = normalize(make_transform(turned())->vector({0, 1, 0}));
    for (Vec3 const p : {Vec3{0, 0, 0}, Vec3{100, -3, 8}}) {
        auto const s = l.sample(p, {0.5f, 0.5f});
        REQUIRE(s);
        CHECK(length(s->wi - up) < 1e-6f);
        CHECK(s->at_infinity);
        CHECK(s->delta);
        CHECK(s->pdf == 1);
        CHECK(luminance_of(s->radiance) == doctest::Approx(2).epsilon(1e-3));
    }
    Lit const lux(DistantLight{BlackbodySpd{5000}, 1, 1234, {0, 5, 0}, {0, 0, 0}});
    CHECK(spectral_luminance([&](Wavelengths const& w) {
              return lux.sample({0, 0, 0}, {0, 0}, w)->radiance;
          }) == doctest::Approx(1234).epsilon(1e-3));
}

TEST_CASE("a constant sky: uniform, radiance by scale or by the illuminance of a facing surface") {
    Lit const l(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, {}, EnvironmentMapping::EqualArea, 4, -1});
    CHECK(is_infinite(l.light()));
    CHECK_FALSE(is_delta(l.light()));
    SphereCells const cells(20, 20);
    std::vector<double> o(cells.size());
    Random r(2);
    int const n = samples(1'000'000, 4'000'000);
    for (int i = 0; i < n; ++i) {
        auto const s = l.sample({0, 0, 0}, random_square(r));
        REQUIRE(s);
        REQUIRE(static_cast<double>(s->pdf) == l.pdf(s->wi));
        REQUIRE(s->radiance[0] == l.radiance(s->wi)[0]);
        ++o[cells.cell(s->wi)];
    }
    CHECK(l.pdf({0, 0, 1}) * 4 * kPiD == doctest::Approx(1));
    CHECK(chi_square(o, std::vector<double>(400, n / 400.0)).p >= 0.01);
    CHECK(luminance_of(l.radiance({0, 1, 0})) == doctest::Approx(4).epsilon(1e-3));
    Lit const lux(
        InfiniteLight{RgbIlluminantSpd{{1, 0.5f, 0.2f}}, {}, EnvironmentMapping::EqualArea, 1, 100});
    CHECK(spectral_luminance([&](Wavelengths const& w) {
              return lux.radiance({0, 0, 1}, w);
          }) * kPiD ==
          doctest::Approx(58.47).epsilon(0.01));  // a colour's white stands for its luminance (pbrt-v4)
    Lit const white(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, {}, EnvironmentMapping::EqualArea, 1, 100});
    CHECK(spectral_luminance([&](Wavelengths const& w) {
              return white.radiance({0, 0, 1}, w);
          }) * kPiD ==
          doctest::Approx(100).epsilon(2e-3));
}

TEST_CASE("environment pictures with a bright spot: samples by the density, which integrates to 1") {
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(6);
    Picture const square("square", 32, 32, [](int x, int y) { return sky_with_sun(x, y, 20, 7); });
    Picture const lat_long("latlong", 48, 24, [](int x, int y) { return sky_with_sun(x, y, 47, 9); });
    for (bool const equal_area : {true, false})
        for (Mat4 const& place : {Mat4{}, turned(), turned() * scale(1, 1, 3)}) {
            CAPTURE(equal_area);
            CAPTURE(place.m[2][2]);
            Lit const l(
                InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0},
                              equal_area ? EnvironmentMapping::EqualArea : EnvironmentMapping::LatLong, 2,
                              -1},
                place, equal_area ? square.files() : lat_long.files());
            // Bins finer than texels near the spot are not needed: expectations are integrated finely.
            SphereCells const cells(24, 48);
            std::vector<double> o(cells.size());
            Random r(3);
            int other_texel = 0, other_radiance = 0;
            Mean mean, inverse;
            for (int i = 0; i < n; ++i) {
                auto const s = l.sample({0, 0, 0}, random_square(r));
                REQUIRE(s);
                REQUIRE(s->pdf > 0);
                REQUIRE(std::abs(length(s->wi) - 1) < 1e-5f);
                REQUIRE(s->at_infinity);
                // The density of the direction itself; rounding may find the texel next door, rarely.
                other_texel += std::abs(l.pdf(s->wi) / static_cast<double>(s->pdf) - 1) > 1e-3;
                double const there = luminance_of(l.radiance(s->wi)), here = luminance_of(s->radiance);
                other_radiance += std::abs(there - here) > 1e-2 * std::max(here, 0.1);
                mean.add(here / static_cast<double>(s->pdf));
                inverse.add(1 / static_cast<double>(s->pdf));
                ++o[cells.cell(s->wi)];
            }
            CHECK(other_texel <= n / 5000);
            CHECK(other_radiance <= n / 2000);
            // Texels' edges cut cells: integrate finely, and turn the answer for what is left.
            auto e = cells.integrate([&](Vec3 w) { return l.pdf(w); }, 32);
            double total = 0;
            for (double const x : e) total += x;
            CHECK(total == doctest::Approx(1).epsilon(2e-3));
            for (double& x : e) x *= n / total;
            // The quadrature is good to about a percent of a cell: leave that much of the counts' own noise.
            auto const c = chi_square(o, e);
            INFO(c);
            CHECK(c.p >= alpha / 10);
            // The whole sphere's light by the samples, against a quadrature over directions.
            auto const truth = cells.integrate([&](Vec3 w) { return luminance_of(l.radiance(w)); }, 16);
            double sum = 0;
            for (double const x : truth) sum += x;
            auto const a = agrees(mean, sum, 0.02, 1e-6);
            INFO(a);
            CHECK(a.half_width < 0.01 * sum);
            CHECK(std::abs(a.mean - sum) < a.half_width + 0.004 * sum);
            for (float const x : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
                for (float const y : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
                    if (auto const s = l.sample({0, 0, 0}, {x, y})) {
                        CHECK(is_finite(s->wi));
                        CHECK((s->pdf > 0 && std::isfinite(s->pdf)));
                        CHECK(s->radiance.is_finite());
                    }
        }
}

TEST_CASE("environment pictures: which texel is where") {
    // Equal-area: the centre of the square is +z, the corners -z. Scaled by `scale`.
    Picture const square("where", 16, 16, [](int x, int y) {
        return x >= 6 && x < 10 && y >= 6 && y < 10 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    });
    Lit const l(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, EnvironmentMapping::EqualArea, 2, -1},
                turned(), square.files());
    Vec3 const up = normalize(make_transform(turned())->vector({0, 0, 1}));
    CHECK(l.radiance(up)[0] == doctest::Approx(2).epsilon(5e-3));
    CHECK(std::abs(l.radiance(up)[2]) < 1e-4f);
    CHECK(l.radiance(-up)[2] == doctest::Approx(2).epsilon(5e-3));
    // Longitude by latitude: row 0 at +z, columns from +x towards +y.
    Picture const lat_long("where2", 16, 8, [](int x, int y) {
        return y < 2 ? Vec3{1, 0, 0} : x < 8 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    });
    Lit const m(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, EnvironmentMapping::LatLong, 1, -1},
                {}, lat_long.files());
    CHECK(m.radiance({0, 0, 1})[0] == doctest::Approx(1).epsilon(5e-3));
    CHECK(m.radiance(normalize(Vec3{0, 1, -0.2f}))[1] == doctest::Approx(1).epsilon(5e-3));
    CHECK(m.radiance(normalize(Vec3{0, -1, -0.2f}))[2] == doctest::Approx(1).epsilon(5e-3));
    // An equal-area picture that is not square has no meaning.
    CHECK_THROWS_AS(
        Lit(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, EnvironmentMapping::EqualArea, 1, -1}, {},
            lat_long.files()),
        Error);
}

TEST_CASE("an environment picture's illuminance: of a surface that faces the light space's +z") {
    Picture const square("lux", 64, 64, [](int x, int y) {
        return Vec3{1 + 0.5f * static_cast<float>(x) / 64, 1, 0.5f + static_cast<float>(y) / 64};
    });
    Lit const l(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, EnvironmentMapping::EqualArea, 1, 500},
                {}, square.files());
    double sum = 0;
    int const k = 300;
    for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j) {
            double const c = (i + 0.5) / k;
            sum += c * luminance_of(l.radiance(direction(std::acos(c), 2 * kPiD * (j + 0.5) / k))) * 2 *
                   kPiD / (k * k);
        }
    CHECK(sum == doctest::Approx(500).epsilon(3e-3));
}

TEST_CASE("power, for choosing among lights, counts all that reaches the scene") {
    BoundingSphere const scene{{0, 0, 0}, 3};
    double const disk = kPiD * 9;
    auto const watts = [&](Lit const& l) {
        return static_cast<double>(power(l.light(), l.data, l.assets, scene));
    };
    Lit const point(PointLight{ConstantSpd{1}, 2, -1, {0, 0, 0}});
    Lit const distant(DistantLight{ConstantSpd{1}, 2, -1, {0, 0, 0}, {0, 0, 1}});
    Lit const sky(InfiniteLight{ConstantSpd{1}, {}, EnvironmentMapping::EqualArea, 2, -1});
    Lit const spot(SpotLight{ConstantSpd{1}, 2, -1, {0, 0, 0}, {0, 0, 1}, 0.5f, 0.0f});
    // Relative to each other: 4 pi I, E pi r^2, 4 pi pi r^2 L, 2 pi (1 - cos) I.
    CHECK(watts(distant) / watts(point) == doctest::Approx(disk / (4 * kPiD)).epsilon(1e-4));
    CHECK(watts(sky) / watts(point) == doctest::Approx(disk).epsilon(1e-4));
    CHECK(watts(spot) / watts(point) == doctest::Approx((1 - std::cos(0.5)) / 2).epsilon(1e-4));
    // A picture of one colour is a constant sky, in either mapping.
    Picture const square("even", 16, 16, [](int, int) { return Vec3{1, 1, 1}; });
    Picture const lat_long("even2", 32, 16, [](int, int) { return Vec3{1, 1, 1}; });
    Lit const plain(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, {}, EnvironmentMapping::EqualArea, 2, -1});
    Lit const a(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, EnvironmentMapping::EqualArea, 2, -1},
                {}, square.files());
    Lit const b(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, EnvironmentMapping::LatLong, 2, -1},
                {}, lat_long.files());
    CHECK(watts(a) / watts(plain) == doctest::Approx(1).epsilon(0.01));
    CHECK(watts(b) / watts(plain) == doctest::Approx(1).epsilon(0.01));
    // … also where the picture's shape says which mapping it is.
    Lit const c(InfiniteLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, EnvironmentMapping::BySize, 2, -1}, {},
                lat_long.files());
    CHECK(watts(c) / watts(plain) == doctest::Approx(1).epsilon(0.01));
}
