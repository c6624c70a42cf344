// Cameras: corner rays by hand, focus, parallel projection, and panoramas that see everything once.
#include "model/camera.h"

#include "support.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {
PreparedCamera make(CameraKind kind, Vec2i resolution, Mat4 const& to_world = {}) {
    Camera c;
    c.kind = kind;
    c.to_world = to_world;
    auto const p = PreparedCamera::make(c, resolution);
    REQUIRE(p);
    return *p;
}
void check_direction(Vec3 d, Vec3 expected) {
    Vec3 const e = normalize(expected);
    CAPTURE(d.x);
    CAPTURE(d.y);
    CAPTURE(d.z);
    CHECK(length(d - e) < 1e-6f);
}
}  // namespace

TEST_CASE("perspective: the field of view spans the shorter side; y is up, raster y down, x right") {
    float const t = std::tan(0.3f);
    PerspectiveCamera const p{0.6f, 0, 1e6f};
    auto const wide = make(p, {400, 200});
    check_direction(wide.ray({0, 0}, {0, 0}).ray.d, {-2 * t, t, 1});
    check_direction(wide.ray({400, 0}, {0, 0}).ray.d, {2 * t, t, 1});
    check_direction(wide.ray({400, 200}, {0, 0}).ray.d, {2 * t, -t, 1});
    check_direction(wide.ray({200, 100}, {0, 0}).ray.d, {0, 0, 1});
    check_direction(wide.ray({300, 50}, {0, 0}).ray.d, {t, t / 2, 1});
    auto const tall = make(p, {100, 300});
    check_direction(tall.ray({0, 0}, {0, 0}).ray.d, {-t, 3 * t, 1});
    check_direction(tall.ray({100, 300}, {0, 0}).ray.d, {t, -3 * t, 1});
    CHECK(wide.ray({17, 3}, {0, 0}).ray.o == Vec3{0, 0, 0});
    CHECK(wide.ray({17, 3}, {0, 0}).weight == 1);
    CHECK(wide.pixel_spread() == doctest::Approx(2 * t / 200));
    // A screen window and an aspect ratio of the file's own.
    Camera c;
    c.kind = p;
    c.screen_window = {{0.0f, 1.0f, -0.5f, 0.25f}};
    auto const window = *PreparedCamera::make(c, {10, 10});
    check_direction(window.ray({0, 0}, {0, 0}).ray.d, {0, 0.25f * t, 1});
    check_direction(window.ray({10, 10}, {0, 0}).ray.d, {t, -0.5f * t, 1});
    c.screen_window.reset();
    c.frame_aspect_ratio = 0.5f;
    auto const narrow = *PreparedCamera::make(c, {10, 10});
    check_direction(narrow.ray({0, 0}, {0, 0}).ray.d, {-t, 2 * t, 1});
}

TEST_CASE("a camera's place: look_at from a scene") {
    auto const look = look_at({1, 2, 3}, {4, 2, 3}, {0, 0, 1});
    auto const c = make(PerspectiveCamera{1, 0, 1e6f}, {100, 100}, *inverse(*look));
    CHECK(length(c.position() - Vec3{1, 2, 3}) < 1e-6f);
    check_direction(c.ray({50, 50}, {0, 0}).ray.d, {1, 0, 0});
    // Looking along +x with z up, right is y: pbrt's left-handed camera.
    float const t = std::tan(0.5f);
    check_direction(c.ray({100, 50}, {0, 0}).ray.d, {1, t, 0});
    check_direction(c.ray({50, 0}, {0, 0}).ray.d, {1, 0, t});
    Camera flat;
    flat.to_world = scale(1, 1, 0);
    CHECK_FALSE(PreparedCamera::make(flat, {10, 10}));
}

TEST_CASE("thin lens: every ray of a film point meets in the plane of focus; the lens is filled evenly") {
    Random r(1);
    auto const c = make(PerspectiveCamera{0.8f, 0.25f, 5}, {200, 100});
    auto const pinhole = make(PerspectiveCamera{0.8f, 0, 5}, {200, 100});
    std::vector<double> o(20 * 20);
    int const n = 100'000;
    for (int i = 0; i < n; ++i) {
        Vec2 const film{200 * r.unit(), 100 * r.unit()};
        Vec3 const d = pinhole.ray(film, {0, 0}).ray.d;
        Vec3 const focus = d * (5 / d.z);
        Ray const ray = c.ray(film, random_square(r)).ray;
        REQUIRE(ray.o.z == 0);
        REQUIRE(std::abs(length(ray.d) - 1) < 1e-6f);
        REQUIRE(length(ray.o + ray.d * (5 / ray.d.z) - focus) < 1e-5f);
        double const r2 = static_cast<double>(ray.o.x * ray.o.x + ray.o.y * ray.o.y) / 0.0625;
        REQUIRE(r2 <= 1 + 1e-5);
        double const phi = std::atan2(ray.o.y, ray.o.x) / (2 * kPiD) + 0.5;
        ++o[static_cast<std::size_t>(std::min(19, static_cast<int>(r2 * 20)) * 20 +
                                     std::min(19, static_cast<int>(phi * 20)))];
    }
    CHECK(chi_square(o, std::vector<double>(400, n / 400.0)).p >= 0.01);
    for (float const u : {0.0f, 0x1p-32f, 1 - 0x1p-24f}) CHECK(is_finite(c.ray({0, 0}, {u, u}).ray.d));
    auto const parallel = make(OrthographicCamera{0.25f, 5}, {200, 100});
    for (int i = 0; i < 1000; ++i) {
        Ray const ray = parallel.ray({150, 25}, random_square(r)).ray;
        CHECK(length(ray.o + ray.d * (5 / ray.d.z) - Vec3{1, 0.5f, 5}) < 1e-5f);
    }
}

TEST_CASE("orthographic: parallel rays from the screen") {
    auto const c = make(OrthographicCamera{}, {300, 100});
    for (Vec2 const film : {Vec2{0, 0}, Vec2{150, 50}, Vec2{300, 100}, Vec2{75, 10}}) {
        Ray const ray = c.ray(film, {0.3f, 0.4f}).ray;
        CHECK(ray.d == Vec3{0, 0, 1});
        CHECK(ray.o.x == doctest::Approx((film.x - 150) / 50));
        CHECK(ray.o.y == doctest::Approx((50 - film.y) / 50));
    }
}

TEST_CASE("spherical cameras see every direction") {
    auto const lat_long = make(SphericalCamera{SphericalMappingKind::EquiRectangular}, {400, 200});
    // The pole is up (y); longitude starts at +x.
    check_direction(lat_long.ray({0, 0}, {0, 0}).ray.d, {0, 1, 0});
    check_direction(lat_long.ray({0, 200}, {0, 0}).ray.d, {0, -1, 0});
    check_direction(lat_long.ray({0, 100}, {0, 0}).ray.d, {1, 0, 0});
    check_direction(lat_long.ray({100, 100}, {0, 0}).ray.d, {0, 0, 1});
    check_direction(lat_long.ray({200, 100}, {0, 0}).ray.d, {-1, 0, 0});
    SphereCells const cells(20, 20);
    Random r(2);
    int const n = samples(1'000'000, 4'000'000);
    for (auto const kind : {SphericalMappingKind::EquiRectangular, SphericalMappingKind::EqualArea}) {
        auto const c = make(SphericalCamera{kind}, {100, 100});
        std::vector<double> o(cells.size());
        for (int i = 0; i < n; ++i) {
            Vec3 const d = c.ray({100 * r.unit(), 100 * r.unit()}, {0, 0}).ray.d;
            REQUIRE(std::abs(length(d) - 1) < 1e-6f);
            ++o[cells.cell({d.x, d.z, d.y})];
        }
        // Evenly by solid angle (equal area), or by latitude: density 1 / (2 pi^2 sin theta).
        auto e = cells.integrate(
            [&](Vec3 w) {
                if (kind == SphericalMappingKind::EqualArea) return 1 / (4 * kPiD);
                return 1 /
                       (2 * kPiD * kPiD * std::sqrt(1 - static_cast<double>(w.z) * static_cast<double>(w.z)));
            },
            1);
        if (kind == SphericalMappingKind::EquiRectangular)
            for (std::size_t i = 0; i < e.size(); ++i) {
                double const z0 = static_cast<double>(i / 20) / 10 - 1, z1 = z0 + 0.1;
                e[i] = (std::acos(std::max(-1.0, z0)) - std::acos(std::min(1.0, z1))) / kPiD / 20;
            }
        for (double& x : e) x *= n;
        auto const c2 = chi_square(o, e);
        INFO(c2);
        CHECK(c2.p >= 0.005);
    }
}
