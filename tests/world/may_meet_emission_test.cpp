// Who asks for emission alone leaves out rays that cannot meet any: never one that does, and nearly all where lights are small.
#include "scenes.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

void shine(Object& o) { o.light = emission(1); }

/// A lamp of each kind, alone or as an instance; far from the origin, large and small.
std::vector<Scene> lamps() {
    std::vector<Scene> scenes;
    for (float const size : {1e-3f, 1.0f, 1e4f})
        for (float const away : {0.0f, 3.0f, 1e3f}) {
            Mat4 const turned = *rotate(37, 1, 2, 3);
            Mat4 const there = translate(away * size, -2 * away * size, size) * turned;
            for (Shape const& shape :
                 {Shape{square(size, 0)}, Shape{Sphere{.radius = size, .z_min = -size, .z_max = size}},
                  Shape{Disk{.radius = size}}, Shape{cube(size)}}) {
                scenes.push_back(alone(shape, there));
                shine(scenes.back().world().objects.front());
                scenes.push_back(alone_instanced(shape, turned, there));
                shine(scenes.back().groups[1].objects.front());
            }
        }
    return scenes;
}

}  // namespace

TEST_CASE("no ray that meets emission is left out") {
    Rays random(7);
    for (Scene const& scene : lamps()) {
        World const world = compile(scene);
        Vec3 const centre = world.bounds().centre();
        float const size = length(world.bounds().diagonal());
        RayStats stats;
        std::uint64_t met = 0;
        for (std::uint64_t i = 0; i < tries(2000); ++i) {
            // From near and far, at places about as far from the middle as the rim is: half of them graze it.
            Vec3 const o = centre + random.direction() * (size * std::exp(random.in(-2, 8)));
            Vec3 const at = centre + random.direction() * (size * random.in(0.0f, 0.6f));
            Ray const ray{o, (at - o) * random.in(0.1f, 10.0f)};
            SurfaceHit hit;
            if (!world.intersect(ray, kInfinity, RayKind::Bounce, stats, hit)) continue;
            REQUIRE(hit.emits);
            REQUIRE(world.may_meet_emission(ray));
            ++met;
        }
        CHECK(met > tries(2000) / 20);
    }
}

TEST_CASE("rays along the axes, in the very planes of a lamp") {
    Scene scene = alone(square(1, 2));
    shine(scene.world().objects.front());
    World const world = compile(scene);
    for (float const x : {-1.0f, 0.0f, 1.0f})
        for (float const zero : {0.0f, -0.0f}) {
            CHECK(world.may_meet_emission({{x, 0, 0}, {zero, zero, 1}}));
            CHECK(world.may_meet_emission({{x, -5, 2}, {zero, 1, zero}}));
            CHECK_FALSE(world.may_meet_emission({{x, 0, 0}, {zero, zero, -1}}));
            CHECK_FALSE(world.may_meet_emission({{x, -5, 2.1f}, {zero, 1, zero}}));
        }
}

TEST_CASE("small lamps are met by few, a sky by all, and darkness by none") {
    Rays random(8);
    auto const share = [&](Scene const& scene) {
        World const world = compile(scene);
        int may = 0;
        for (int i = 0; i < 10000; ++i)
            may += world.may_meet_emission({{random.in(-9, 9), random.in(-9, 9), 0}, random.direction()});
        return may / 10000.0;
    };
    Scene scene = alone(square(1, 9));
    CHECK(share(scene) == 0);
    shine(scene.world().objects.front());
    double const lamp = share(scene);
    CHECK(lamp > 0.001);
    CHECK(lamp < 0.02);
    scene.lights.push_back(Light{InfiniteLight{}, {}, {}});
    CHECK(share(scene) == 1);
}

TEST_CASE("rays that are not numbers are left to those who trace") {
    Scene scene = alone(square(1, 9));
    shine(scene.world().objects.front());
    World const world = compile(scene);
    for (float const bad : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()})
        for (int axis = 0; axis < 3; ++axis) {
            Ray o{{0, 0, 0}, {0, 0, -1}}, d = o;
            o.o[axis] = bad;
            d.d[axis] = bad;
            CHECK(world.may_meet_emission(o));
            CHECK(world.may_meet_emission(d));
        }
}
