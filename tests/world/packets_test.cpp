// Rays side by side: what a ray meets must not depend on the rays beside it, or a picture would depend on its crop window.
#include "scenes.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

using Hits = std::array<RawHit, kLanes>;

/// Meshes, analytic shapes, alpha that chance decides on, and an appearance of a group.
Scene things() {
    Scene s = alone_instanced(Sphere{0.7f}, translate(2, 0, 0), *rotate(30, 1, 2, 3));
    MaterialId const grey = diffuse(s);
    auto& world = s.world();
    world.objects.push_back(object(torus(60, 24, 1.2f, 0.4f), grey));
    world.objects.push_back(object(Box{Vec3{-3.1f}, Vec3{-1.2f}}, grey));
    world.objects.push_back(object(cube(5), grey));
    Object veil = object(square(1.5f, 1.7f), grey);
    veil.alpha = s.add(Texture{ConstantFloatTexture{0.5f}, {}});
    world.objects.push_back(veil);
    Object bubble = object(Sphere{0.9f}, grey, translate(0, 2, 0));
    bubble.alpha = veil.alpha;
    world.objects.push_back(bubble);
    return s;
}
/// The same, but for the appearance of the group: then shadow rays are traced side by side.
Scene things_alone() {
    Scene s = things();
    s.world().instances.clear();
    return s;
}
/// A plane that is there again and again, in other triangles, as a quad and in appearances of a group: whatever ray meets one meets
/// all, at one distance.
Scene layers() {
    Scene s = alone_instanced(square(2, 0), Mat4{}, Mat4{});
    MaterialId const grey = diffuse(s);
    s.world().instances.push_back(s.world().instances.front());
    TriangleMesh other = square(2, 0);
    other.triangles = {{1, 2, 3}, {1, 3, 0}};
    TriangleMesh fine;
    constexpr int n = 8;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            fine.p.push_back(
                {-2 + 4.0f * static_cast<float>(x) / n, -2 + 4.0f * static_cast<float>(y) / n, 0});
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            int const a = y * (n + 1) + x;
            fine.triangles.push_back({a, a + 1, a + n + 2});
            fine.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    for (Shape const& shape : {Shape{fine}, Shape{other}, Shape{square(2, 0)}, Shape{fine},
                               Shape{Quad{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}}})
        s.world().objects.push_back(object(shape, grey));
    return s;
}

/// From a place outside, towards a point in the middle: of one camera or of anywhere.
Ray some_ray(Rays& random, bool camera) {
    Vec3 const from = camera ? Vec3{0.3f, -4.2f, 3.5f} : 4.5f * random.direction();
    Vec3 const to{random.in(-2, 2), random.in(-2, 2), random.in(-1, 1) * (camera ? 0.0f : 1.0f)};
    return {from, to - from};
}

}  // namespace

TEST_CASE("a ray meets the same whatever is beside it") {
    for (bool const coincident : {false, true}) {
        World const world = compile(coincident ? layers() : things());
        RayStats stats;
        for (bool const camera : {true, false}) {
            CAPTURE(coincident);
            CAPTURE(camera);
            Rays random(7);
            std::uint64_t found = 0;
            std::uint64_t other = 0;
            std::uint64_t const n = tries(20'000);
            for (std::uint64_t i = 0; i < n; ++i) {
                RayPacket together;
                // Not all lanes, now and then.
                std::size_t const size = i % 5 == 0 ? 1 + i % kLanes : kLanes;
                for (std::size_t k = 0; k < size; ++k) together.set(k, some_ray(random, camera), kInfinity);
                Hits hits;
                world.intersect(together, stats, hits);
                for (std::size_t k = 0; k < size; ++k) {
                    RayPacket lonely;
                    std::size_t const lane = (k + i) % kLanes;
                    lonely.set(lane, together.ray(k), kInfinity);
                    Hits alone_hits;
                    world.intersect(lonely, stats, alone_hits);
                    found += hits[k].found ? 1 : 0;
                    other += bits(alone_hits[lane]) != bits(hits[k]) ? 1 : 0;
                }
            }
            CHECK(found > 4 * n);
            CHECK(other == 0);
        }
    }
}

TEST_CASE("a ray in a packet meets what it meets by itself") {
    // Where surfaces coincide a single ray may meet another of them, at the same distance.
    World const world = compile(things());
    RayStats stats;
    Rays random(8);
    std::uint64_t other = 0;
    for (std::uint64_t i = 0; i < tries(20'000); ++i) {
        RayPacket packet;
        for (std::size_t k = 0; k < kLanes; ++k) packet.set(k, some_ray(random, i % 2 == 0), kInfinity);
        Hits hits;
        world.intersect(packet, stats, hits);
        for (std::size_t k = 0; k < kLanes; ++k) {
            SurfaceHit in_packet;
            SurfaceHit single;
            bool const a = world.surface(hits[k], in_packet);
            bool const b = world.intersect(packet.ray(k), kInfinity, RayKind::Camera, stats, single);
            other += a != b || (a && (in_packet.t != single.t || in_packet.s.p != single.s.p ||
                                      in_packet.s.ng != single.s.ng || in_packet.part != single.part))
                         ? 1
                         : 0;
        }
    }
    CHECK(other == 0);
    CHECK(stats.rejected == 0);
}

TEST_CASE("of surfaces at one distance the least number is met") {
    Scene scene = alone(icosphere(2, 1));
    for (int i = 0; i < 5; ++i) scene.world().objects.push_back(scene.world().objects.front());
    World const world = compile(scene);
    RayStats stats;
    Rays random(9);
    for (int i = 0; i < 2'000; ++i) {
        RayPacket packet;
        for (std::size_t k = 0; k < kLanes; ++k) {
            Vec3 const from = 2.0f * random.direction();
            packet.set(k, {from, 0.3f * random.direction() - from}, kInfinity);
        }
        Hits hits;
        world.intersect(packet, stats, hits);
        for (RawHit const& found : hits) REQUIRE((found.found && found.geometry == 0));
    }
}

TEST_CASE("eight shadow rays at once are as dark as one by one") {
    for (int which = 0; which < 3; ++which) {
        bool const coincident = which == 2;
        World const world = compile(coincident ? layers() : which == 1 ? things_alone() : things());
        CAPTURE(coincident);
        RayStats stats;
        RayStats single;
        Rays random(10);
        std::uint64_t dark = 0;
        std::uint64_t other = 0;
        std::uint64_t const n = tries(10'000);
        for (std::uint64_t i = 0; i < n; ++i) {
            RayPacket packet;
            std::array<float, kLanes> by_itself{};
            std::size_t const size = i % 5 == 0 ? 1 + i % kLanes : kLanes;
            for (std::size_t k = 0; k < size; ++k) {
                SurfaceHit from;
                SurfaceHit lamp;
                Ray ray = some_ray(random, false);
                while (!world.intersect(ray, kInfinity, RayKind::Bounce, single, from))
                    ray = some_ray(random, false);
                LightSample to;
                to.wi = random.direction();
                to.at_infinity = random.bits() % 4 == 0;
                to.p = {random.in(-3, 3), random.in(-3, 3), random.in(-3, 3)};
                if (world.intersect(some_ray(random, false), kInfinity, RayKind::Bounce, single, lamp) &&
                    random.bits() % 2 == 0)
                    to.p = lamp.s.p, to.p_error = lamp.s.p_error, to.n = lamp.s.ng;
                ShadowRay const shadow = shadow_ray(from, to);
                if (shadow.lit)
                    packet.set(k, shadow.ray, shadow.t_max);
                else
                    ++stats.rays[static_cast<std::size_t>(RayKind::Shadow)];
                by_itself[k] = world.transmittance(from, to, single);
            }
            LaneMask const lit = world.unoccluded(packet, stats);
            for (std::size_t k = 0; k < size; ++k) {
                dark += by_itself[k] == 0.0f ? 1 : 0;
                other += (by_itself[k] > 0.0f) != ((lit >> k & 1u) != 0) ? 1 : 0;
            }
            CHECK((lit >> size) == 0);
        }
        CHECK(other == 0);
        if (!coincident) CHECK(dark > n);
        CHECK(dark < 7 * n);
        CHECK(stats.rays[static_cast<std::size_t>(RayKind::Shadow)] ==
              single.rays[static_cast<std::size_t>(RayKind::Shadow)]);
    }
}

TEST_CASE("rays in a packet that are not numbers are refused and counted, and the others go on") {
    World const world = compile(things());
    RayStats stats;
    RayPacket packet;
    for (std::size_t k = 0; k < kLanes; ++k) packet.set(k, {{0, 0, 4}, {0, 0, -1}}, kInfinity);
    packet.o.x[1] = std::numeric_limits<float>::quiet_NaN();
    packet.d.y[3] = kInfinity;
    packet.set(6, {{0, 0, 0}, {0, 0, 0}}, kInfinity);
    Hits hits;
    world.intersect(packet, stats, hits);
    CHECK(stats.rejected == 3);
    CHECK(stats.hits == 5);
    for (std::size_t k = 0; k < kLanes; ++k) CHECK(hits[k].found == (k != 1 && k != 3 && k != 6));
}
