// Cameras: corner rays by hand, focus, parallel projection, and panoramas that see everything once; and the way back, from points
// of the world to the film.
#include "model/camera.h"

#include "support.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

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

namespace {
/// Cameras of all kinds, somewhere, and two that are stretched.
struct Named {
    std::string name;
    PreparedCamera camera;
    Vec2 resolution;
};
std::vector<Named> all_kinds() {
    Mat4 const place = translate(1, 2, 3) * *rotate(40, 1, 2, -1);
    Mat4 const stretched = place * scale(0.5, 2, 1.5);
    std::vector<Named> all;
    for (bool const odd : {false, true}) {
        Mat4 const& m = odd ? stretched : place;
        auto const add = [&](std::string const& name, CameraKind kind) {
            all.push_back({name + (odd ? ", stretched" : ""), make(kind, {40, 30}, m), {40, 30}});
        };
        add("perspective", PerspectiveCamera{0.9f, 0, 1e6f});
        add("lens", PerspectiveCamera{0.9f, 0.2f, 4});
        add("orthographic", OrthographicCamera{});
        add("orthographic lens", OrthographicCamera{0.3f, 5});
        add("lat-long", SphericalCamera{SphericalMappingKind::EquiRectangular});
        add("equal area", SphericalCamera{SphericalMappingKind::EqualArea});
    }
    return all;
}
}  // namespace

TEST_CASE("project finds where a ray began; sample_importance finds the ray") {
    Random r(3);
    for (Named const& named : all_kinds()) {
        std::string const& name = named.name;
        PreparedCamera const& camera = named.camera;
        Vec2 const size = named.resolution;
        CAPTURE(name);
        auto const off = [&](Vec2 a, Vec2 b) {
            // A pixel of a latitude-longitude picture is narrow near the poles.
            float const wide = name.starts_with("lat-long") ? std::sin(kPi * b.y / size.y) : 1.0f;
            return length(Vec2{(a.x - b.x) * wide, a.y - b.y});
        };
        for (int i = 0; i < 2000; ++i) {
            Vec2 const film{size.x * r.unit(), size.y * r.unit()};
            Vec2 const lens = random_square(r);
            Ray const ray = camera.ray(film, lens).ray;
            float const t = 0.5f + 10 * r.unit();
            auto const s = camera.sample_importance(ray.o + t * ray.d, lens);
            REQUIRE(s);
            REQUIRE(off(s->raster, film) < 1e-3f);
            REQUIRE(length(s->from - ray.o) < 2e-5f * t);
            REQUIRE(length(s->wi + ray.d) < 1e-5f);
            REQUIRE(s->distance == doctest::Approx(t).epsilon(1e-4));
            Ray const central = camera.ray(film, {0.5f, 0.5f}).ray;
            auto const p = camera.project(central.o + t * central.d);
            REQUIRE(p);
            REQUIRE(off(*p, film) < 1e-3f);
        }
    }
    // Behind the camera, and at its very place.
    auto const forward = make(PerspectiveCamera{0.9f, 0, 1e6f}, {40, 30});
    CHECK_FALSE(forward.project({0, 0, -1}));
    CHECK_FALSE(forward.project({0, 0, 0}));
    CHECK_FALSE(make(OrthographicCamera{}, {40, 30}).project({0, 0, -1}));
    CHECK_FALSE(make(SphericalCamera{}, {40, 30}).project({0, 0, 0}));
    CHECK((*forward.project({-9, 0, 1})).x < 0);  // beyond the edge is a place, too
}

TEST_CASE("importance is how densely the film covers what it sees") {
    Random r(4);
    for (Named const& named : all_kinds()) {
        std::string const& name = named.name;
        PreparedCamera const& camera = named.camera;
        Vec2 const size = named.resolution;
        CAPTURE(name);
        for (int i = 0; i < 1000; ++i) {
            // Away from the seams, where neighbours on the film are no neighbours in the world.
            Vec2 const film{size.x * (0.02f + 0.46f * r.unit()), size.y * (0.02f + 0.46f * r.unit())};
            Vec2 const lens = random_square(r);
            float const t = 1 + 10 * r.unit();
            Ray const ray = camera.ray(film, lens).ray;
            // Three rays from one point of the lens, cut by the plane across the first.
            float const h = 0.02f;
            auto const cut = [&](Vec2 at) {
                Ray const other = camera.ray(at, lens).ray;
                float const s = (t - dot(other.o - ray.o, ray.d)) / dot(other.d, ray.d);
                return other.o + s * other.d;
            };
            Vec3 const x = cut(film + Vec2{h, 0}) - cut(film - Vec2{h, 0});
            Vec3 const y = cut(film + Vec2{0, h}) - cut(film - Vec2{0, h});
            double const area = static_cast<double>(length(cross(x, y)) / (4 * h * h));
            if (name.starts_with("equal area") &&
                std::abs(film.x / size.x + film.y / size.y - 0.5f) * size.y < 1)
                continue;  // its creases
            auto const s = camera.sample_importance(ray.o + t * ray.d, lens);
            REQUIRE(s);
            REQUIRE(static_cast<double>(s->importance) * area == doctest::Approx(1).epsilon(0.01));
        }
    }
}

TEST_CASE("importance over all that a pixel sees is 1") {
    // A sphere around the camera, uniformly: each pixel of a small film, through all of the lens.
    Random r(5);
    std::vector<std::pair<CameraKind, Vec2i>> const kinds{
        {PerspectiveCamera{1.8f, 0, 1e6f}, {3, 2}},
        {PerspectiveCamera{1.8f, 0.3f, 2}, {3, 2}},
        {OrthographicCamera{}, {3, 2}},
        {OrthographicCamera{0.3f, 4}, {3, 2}},
        {SphericalCamera{SphericalMappingKind::EquiRectangular}, {4, 2}},
        {SphericalCamera{SphericalMappingKind::EqualArea}, {3, 3}}};
    for (auto const& [kind, size] : kinds) {
        CAPTURE(kind.index());
        auto const camera = make(kind, size, translate(0.2, 0.1, 0.3) * *rotate(30, 1, 1, 0));
        double const radius = 3;
        std::vector<Mean> pixels(static_cast<std::size_t>(size.x * size.y));
        for (int batch = 0; batch < 32; ++batch) {
            std::vector<double> sums(pixels.size());
            int const n = std::holds_alternative<OrthographicCamera>(kind) ? samples(400'000, 1'600'000)
                                                                           : samples(250'000, 1'000'000);
            for (int i = 0; i < n; ++i) {
                Vec3 const w = random_direction(r);
                auto const s = camera.sample_importance(static_cast<float>(radius) * w, random_square(r));
                if (!s || !(s->raster.x >= 0 && s->raster.y >= 0)) continue;
                int const x = static_cast<int>(s->raster.x), y = static_cast<int>(s->raster.y);
                if (x >= size.x || y >= size.y) continue;
                sums[static_cast<std::size_t>(y * size.x + x)] +=
                    static_cast<double>(s->importance * abs_dot(w, s->wi)) * 4 * kPiD * radius * radius / n;
            }
            for (std::size_t i = 0; i < sums.size(); ++i) pixels[i].add(sums[i]);
        }
        for (Mean const& m : pixels) {
            auto const a = agrees(m, 1, 0.01 * (kSanitizerShare > 1 ? 4 : 1),
                                  sidak(static_cast<int>(pixels.size()) * 6));
            CHECK_MESSAGE(a, a);
        }
    }
}

TEST_CASE("panoramas go on beyond their edges, and wrap says where") {
    Random r(6);
    for (auto const kind : {SphericalMappingKind::EquiRectangular, SphericalMappingKind::EqualArea}) {
        auto const c = make(SphericalCamera{kind}, {40, 30});
        for (int i = 0; i < 1000; ++i) {
            Vec2 const film{-4 + 48 * r.unit(), -4 + 38 * r.unit()};
            Vec2 const within = c.wrap(film);
            CHECK((within.x >= 0 && within.x <= 40 && within.y >= 0 && within.y <= 30));
            CHECK(length(c.ray(film, {0, 0}).ray.d - c.ray(within, {0, 0}).ray.d) < 2e-5f);
        }
    }
    CHECK(make(OrthographicCamera{}, {40, 30}).wrap({-1, 50}) == Vec2{-1, 50});
}
