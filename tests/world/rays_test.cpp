// Rays that no scene should ask about, and the rays between two surfaces.
#include "scenes.h"

#include <doctest/doctest.h>

#include <bit>

using namespace nephroid;
using namespace nephroid::test;

namespace {
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Scene two_things() {
    Scene s = alone_instanced(Sphere{}, translate(0, 0, 3), *rotate(10, 1, 0, 0));
    s.world().objects.push_back(object(cube(1), diffuse(s)));
    return s;
}
}  // namespace

TEST_CASE("rays that are not numbers are refused and counted, and abort nothing") {
    World const world = compile(two_things());
    std::vector<float> const bad{kNaN, kInfinity, -kInfinity, 3e38f, -1e30f};
    RayStats stats;
    SurfaceHit hit;
    std::uint64_t asked = 0;
    for (float const x : bad)
        for (int axis = 0; axis < 3; ++axis) {
            Ray o;
            o.o[axis] = x;
            Ray d;
            d.d[axis] = x;
            CHECK_FALSE(world.intersect(o, kInfinity, RayKind::Camera, stats, hit));
            CHECK_FALSE(world.intersect(d, kInfinity, RayKind::Camera, stats, hit));
            asked += 2;
        }
    CHECK_FALSE(world.intersect({{0, 0, 0}, {0, 0, 0}}, kInfinity, RayKind::Bounce, stats, hit));
    CHECK_FALSE(world.intersect({{0, 0, 0}, {0, 0, 1}}, kNaN, RayKind::Bounce, stats, hit));
    CHECK_FALSE(world.intersect({{0, 0, 0}, {0, 0, 1}}, -1, RayKind::Bounce, stats, hit));
    CHECK_FALSE(world.intersect({{0, 0, 0}, {0, 0, 1}}, -kInfinity, RayKind::Bounce, stats, hit));
    asked += 4;
    CHECK(stats.rejected == asked);
    CHECK(stats.hits == 0);

    // Towards lights: refused rays count as blocked, so that no light comes of them.
    REQUIRE(world.intersect({{0, 0, -5}, {0, 0, 1}}, kInfinity, RayKind::Camera, stats, hit));
    for (float const x : bad) {
        LightSample to;
        to.p = {x, 0, 0};
        to.wi = {0, 0, -1};
        CHECK(world.transmittance(hit, to, stats) == 0.0f);
        to.at_infinity = true;
        to.wi = {x, 0, 0};
        CHECK(world.transmittance(hit, to, stats) == 0.0f);
        asked += 2;
    }
    CHECK(stats.rejected == asked);
}

TEST_CASE("any bits at all may be asked") {
    World const world = compile(two_things());
    Rays random(5);
    RayStats stats;
    SurfaceHit hit;
    std::uint64_t const n = tries(100'000);
    auto const anything = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits())); };
    for (std::uint64_t i = 0; i < n; ++i) {
        Ray const ray{{anything(), anything(), anything()}, {anything(), anything(), anything()}};
        bool const found = world.intersect(ray, i % 2 ? kInfinity : anything(), RayKind::Bounce, stats, hit);
        if (found) CHECK(is_finite(hit.s.p));
        LightSample to;
        to.p = {anything(), anything(), anything()};
        to.p_error = {anything(), anything(), anything()};
        to.n = {anything(), anything(), anything()};
        to.wi = {anything(), anything(), anything()};
        to.at_infinity = i % 3 == 0;
        SurfaceHit from;
        from.s.p = ray.o;
        from.s.p_error = abs(ray.d);
        (void)world.transmittance(from, to, stats);
    }
    CHECK(stats.rays[1] == n);
    CHECK(stats.rejected > 0);
    CHECK(stats.rejected < 2 * n);
}

TEST_CASE("from inside a room every point of every wall is in sight") {
    // Walls that touch: of one mesh, of a box, and of six quads.
    std::vector<Scene> rooms;
    for (float const size : {1.0f, 1000.0f}) {
        rooms.push_back(alone(cube(size)));
        rooms.push_back(alone(Box{Vec3{-size}, Vec3{size}}));
        // Where floats are 1/64 apart, a room has to be larger.
        rooms.push_back(
            alone_instanced(cube(100 * size), Mat4{}, translate(1.5e5, 0, 0) * *rotate(10, 1, 2, 3)));
        Scene six;
        six.files = {"six.pbrt"};
        MaterialId const grey = diffuse(six);
        float const d = 2 * size;
        for (Vec3 const corner : {Vec3{-size}, Vec3{size}}) {
            float const e = corner.x < 0 ? d : -d;
            six.world().objects.push_back(object(Quad{corner, {e, 0, 0}, {0, e, 0}}, grey));
            six.world().objects.push_back(object(Quad{corner, {0, e, 0}, {0, 0, e}}, grey));
            six.world().objects.push_back(object(Quad{corner, {0, 0, e}, {e, 0, 0}}, grey));
        }
        rooms.push_back(six);
    }
    Rays random(9);
    for (std::size_t r = 0; r < rooms.size(); ++r) {
        CAPTURE(r);
        World const world = compile(rooms[r]);
        Vec3 const middle = world.bounds().centre();
        RayStats stats;
        std::uint64_t blocked = 0;
        std::uint64_t const n = tries(20'000);
        for (std::uint64_t i = 0; i < n; ++i) {
            SurfaceHit a;
            SurfaceHit b;
            REQUIRE(world.intersect({middle, random.direction()}, kInfinity, RayKind::Camera, stats, a));
            REQUIRE(world.intersect({middle, random.direction()}, kInfinity, RayKind::Camera, stats, b));
            Vec3 const na = face_forward(a.s.ng, middle - a.s.p);
            LightSample to;
            to.p = b.s.p;
            to.p_error = b.s.p_error;
            to.n = b.s.ng;
            Vec3 const d = b.s.p - a.s.p;
            Vec3 const nb = face_forward(b.s.ng, middle - b.s.p);
            if (std::min(dot(d, na), -dot(d, nb)) < 1e-3f * length(d)) continue;  // the same wall, or all but
            to.wi = normalize(d);
            if (world.transmittance(a, to, stats) == 0.0f) ++blocked;
        }
        // Far away, a point in a corner may be one rounding behind the next wall.
        CHECK(blocked <= (middle.x > 1e5f ? n / 2'000 : 0));
    }
}

TEST_CASE("no light shades itself, wherever it is seen from") {
    struct Lamp {
        std::string name;
        Shape shape;
        Mat4 place;
    };
    Mat4 const tilted = translate(0.3, 0, 1.5) * *rotate(200, 1, 0.4, 0);
    Mat4 const stretched = tilted * scale(0.5, 0.8, 0.3);
    // Standing on the floor, edge to face.
    Mat4 const standing = *rotate(90, 1, 0, 0) * translate(0, 1, 0);
    std::vector<Lamp> const lamps{
        {"square", square(0.5f, 0), tilted},
        {"cube", cube(0.4f), tilted},
        {"icosphere", icosphere(2, 0.4f), tilted},
        {"sphere", Sphere{0.5f, -0.5f, 0.5f}, tilted},
        {"ellipsoid", Sphere{}, stretched},
        {"disk", Disk{}, tilted},
        {"box", Box{}, stretched},
        {"quad", Quad{}, tilted},
        {"patch",
         BilinearMesh{.p = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}, .patches = {{0, 1, 2, 3}}},
         tilted},
        {"standing square", square(1, 0), standing},
        {"standing quad", Quad{}, standing},
        {"sphere on the floor", Sphere{}, translate(0, 0, 1)},
        {"box on the floor", Box{}, translate(0, 0, 1)}};
    for (Lamp const& l : lamps)
        for (bool const instanced : {false, true})
            for (double const far : {0.0, 1.5e5}) {
                std::string const name = l.name + (instanced ? ", instanced" : "") + (far > 0 ? ", far" : "");
                CAPTURE(name);
                Scene s;
                s.files = {"lamp.pbrt"};
                MaterialId const grey = diffuse(s);
                Object lamp = object(l.shape, grey, l.place);
                lamp.light = emission(1);
                // Far away the floats are 1/64 apart: things as large as a house.
                double const size = far > 0 ? 100 : 1;
                Mat4 const shift = translate(far, far, 0) * scale(size, size, size);
                if (instanced) {
                    GroupId const g = s.add(Group{.name = "g"});
                    s.groups[g.value].objects.push_back(lamp);
                    s.world().instances.push_back({.group = g, .to_parent = rows_of(shift)});
                } else {
                    lamp.to_group = shift * lamp.to_group;
                    s.world().objects.push_back(lamp);
                }
                s.world().objects.push_back(object(square(20, 0), grey, shift));
                World const world = compile(std::move(s));
                auto const unit = static_cast<float>(size);
                Vec3 const middle{static_cast<float>(far), static_cast<float>(far), 0};
                Rays random(13);
                RayStats stats;
                std::uint64_t lit = 0;
                std::uint64_t blocked = 0;
                std::uint64_t const n = tries(4'000);
                for (std::uint64_t i = 0; i < n; ++i) {
                    SurfaceHit floor;
                    Vec3 const at = middle + unit * Vec3{random.in(-15, 15), random.in(-15, 15), 0};
                    if (!world.intersect({at - Vec3{0, 0, unit}, {0, 0, 1}}, kInfinity, RayKind::Camera,
                                         stats, floor))
                        continue;
                    auto const light = world.sample_light(Receiver{floor.s.p}, {}, random.unit(),
                                                          {random.unit(), random.unit()}, Wavelengths::rgb());
                    if (!light || light->radiance.is_black()) continue;
                    // Far away, corners are off by up to 1/128, so that the two triangles of a face make an angle.
                    float const grazing = far > 0 ? 2e-3f : 1e-4f;
                    if (dot(light->wi, floor.s.ng) < grazing || dot(light->wi, -light->n) < grazing) continue;
                    ++lit;
                    if (world.transmittance(floor, *light, stats) == 0.0f) ++blocked;
                }
                CHECK(stats.rejected == 0);
                CHECK(lit > n / 20);
                CHECK(blocked == 0);
            }
}
