// Spheres that are asked beside Embree's tree are met as those in it: to the bit, by eight rays or by one.
#include "scenes.h"

#include <doctest/doctest.h>

#include <string>

using namespace nephroid;
using namespace nephroid::test;

namespace {

using Hits = std::array<RawHit, kLanes>;

/// A shape of another kind, where no ray gets: then all are Embree's.
Scene given_to_embree(Scene s) {
    s.world().objects.push_back(object(Box{Vec3{-1}, Vec3{1}}, diffuse(s), translate(0, 0, 1e9)));
    return s;
}
Scene empty() {
    Scene s;
    s.files = {"spheres.pbrt"};
    return s;
}
void add(Scene& s, Shape shape, Mat4 const& to = {}) {
    s.world().objects.push_back(object(std::move(shape), diffuse(s), to));
}

Scene bare() {
    Scene s = empty();
    add(s, Sphere{0.9f});
    return s;
}
/// Scaled, turned, mirrored, moved, among triangles and through them.
Scene placed() {
    Scene s = empty();
    add(s, torus(60, 24, 1.2f, 0.4f));
    add(s, Sphere{0.5f}, translate(0.3, -0.4, 0.2));
    add(s, Sphere{0.7f}, translate(-1, 1, 0.4) * *rotate(40, 1, 2, 3) * scale(0.3, 1.5, 0.8));
    add(s, cube(5));
    add(s, Sphere{0.8f}, scale(-1, 1, 1) * translate(-1.1, -1.2, 0) * *rotate(70, -1, 2, 0));
    add(s, Sphere{0.25f}, translate(0.6, -0.4, 0.2) * scale(2, 2, 2));
    return s;
}
/// A ground that is hardly bent, and spheres that stand on it.
Scene planet() {
    Scene s = empty();
    add(s, Sphere{1e5f, -1e5f, 1e5f}, translate(0, 0, -1e5));
    add(s, Sphere{1.0f}, translate(0, 0, 1));
    add(s, Sphere{0.4f}, translate(1.3, 0.2, 0.4));
    return s;
}
/// What lets light pass, in part or all of it.
Scene passages() {
    Scene s = empty();
    MaterialId const nothing = s.add(Material{InterfaceMaterial{}, "", {}});
    MaterialId const veil = s.add(
        Material{MixMaterial{diffuse(s), nothing, s.add(Texture{ConstantFloatTexture{0.5f}, {}})}, "", {}});
    add(s, Sphere{0.6f}, translate(1.5, 0, 0));
    s.world().objects.push_back(object(Sphere{0.8f}, veil, translate(-0.5, 1, 0)));
    s.world().objects.push_back(object(Sphere{0.7f}, nothing, translate(0, -1, 0.2)));
    s.world().objects.back().light = emission(1);
    add(s, cube(4));
    return s;
}
/// Shadow rays go singly here.
Scene beside_instances() {
    Scene s = alone_instanced(Sphere{0.5f}, translate(0.2, 0, 0), translate(0, -1.5, 0));
    add(s, Sphere{0.8f});
    add(s, square(2, -0.3f));
    return s;
}
/// Of any size.
template <int kExponent>
Scene sized() {
    double const k = std::pow(2.0, kExponent);
    Scene s = placed();
    for (Object& o : s.world().objects) o.to_group = scale(k, k, k) * o.to_group;
    return s;
}

struct Case {
    char const* name;
    Scene (*scene)();
    float size = 1;
    bool extreme = false;  // so that normals are not numbers any more
};
std::array const kCases{Case{"bare", bare},
                        Case{"placed", placed},
                        Case{"planet", planet},
                        Case{"passages", passages},
                        Case{"beside instances", beside_instances},
                        Case{"small", sized<-20>, 0x1p-20f},
                        Case{"tiny", sized<-30>, 0x1p-30f, true},
                        Case{"large", sized<20>, 0x1p20f},
                        Case{"huge", sized<50>, 0x1p50f, true}};
Case const& kPassages = kCases[3];

/// The world, and the same with all that is analytic in Embree's tree.
struct Both {
    Scene scene;
    World few, embree;
    explicit Both(Case const& c)
        : scene(c.scene()), few(compile(scene)), embree(compile(given_to_embree(scene))) {}

    [[nodiscard]] bool is_sphere(RawHit const& h) const {
        return h.found && (h.instance != kNoInstance ||
                           std::holds_alternative<Sphere>(scene.world().objects[h.geometry].shape));
    }
    /// A triangle may be met along its edge in one tree, and missed in another.
    [[nodiscard]] bool differ(RawHit const& a, RawHit const& b) const {
        return (is_sphere(a) || is_sphere(b)) && bits(a) != bits(b);
    }
};

/// From anywhere, inside of things, or from a surface; towards anything, or past a sphere as close as floats get. The direction is as long
/// as it comes.
Ray some_ray(Case const& c, World const& world, Rays& random) {
    RayStats stats;
    SurfaceHit from;
    float const length = random.bits() % 2 == 0 ? c.size : 1.0f;
    Ray ray{c.size * random.in(0, 3) * random.direction(), length * random.in(0.1f, 2) * random.direction()};
    std::uint64_t const kind = random.bits() % 3;
    if (c.extreme || kind == 0 || !world.intersect(ray, kInfinity, RayKind::Bounce, stats, from)) return ray;
    if (kind == 1) return from.spawn(random.outward(from.s.ng));
    // A tangent where that ray has met something, a little off.
    Vec3 const along = normalize(cross(from.s.ng, random.direction()));
    float const off = std::exp(random.in(-16, -2)) * (random.bits() % 2 == 0 ? 1.0f : -1.0f);
    return {from.s.p + c.size * (off * from.s.ng - random.in(0.2f, 1) * along), length * along};
}
/// Ends before, at and behind what is met.
float some_end(World const& world, Rays& random, Ray const& ray) {
    RayStats stats;
    RawHit hit;
    if (random.bits() % 2 == 0 || !world.intersect(ray, kInfinity, RayKind::Bounce, stats, hit))
        return kInfinity;
    constexpr std::array<float, 5> kEnds{0.5f, 1 - 0x1p-23f, 1, 1 + 0x1p-23f, 2};
    return hit.t * kEnds[random.bits() % 5];
}

}  // namespace

TEST_CASE("a ray meets a sphere beside Embree's tree as one in it") {
    for (Case const& c : kCases) {
        CAPTURE(std::string(c.name));
        Both const worlds(c);
        RayStats stats;
        Rays random(11);
        std::uint64_t met = 0;
        std::uint64_t other = 0;
        std::uint64_t const n = tries(30'000);
        for (std::uint64_t i = 0; i < n; ++i) {
            Ray const ray = some_ray(c, worlds.few, random);
            float const end = some_end(worlds.few, random, ray);
            RawHit a;
            RawHit b;
            worlds.few.intersect(ray, end, RayKind::Bounce, stats, a);
            worlds.embree.intersect(ray, end, RayKind::Bounce, stats, b);
            met += worlds.is_sphere(a) ? 1 : 0;
            other += worlds.differ(a, b) ? 1 : 0;
        }
        CHECK(met > n / 20);
        CHECK(other == 0);
        if (!c.extreme) CHECK(stats.rejected == 0);
    }
}

TEST_CASE("eight rays meet spheres beside Embree's tree as those in it") {
    for (Case const& c : kCases) {
        CAPTURE(std::string(c.name));
        Both const worlds(c);
        RayStats stats;
        Rays random(12);
        std::uint64_t found = 0;
        std::uint64_t hidden = 0;
        std::uint64_t other = 0;
        std::uint64_t const n = tries(5'000);
        for (std::uint64_t i = 0; i < n; ++i) {
            RayPacket packet;
            std::size_t const size = i % 5 == 0 ? 1 + i % kLanes : kLanes;
            for (std::size_t k = 0; k < size; ++k) {
                Ray const ray = some_ray(c, worlds.few, random);
                packet.set(k, ray, some_end(worlds.few, random, ray));
            }
            Hits a;
            Hits b;
            worlds.few.intersect(packet, stats, a);
            worlds.embree.intersect(packet, stats, b);
            for (std::size_t k = 0; k < kLanes; ++k) {
                found += worlds.is_sphere(a[k]) ? 1 : 0;
                other += worlds.differ(a[k], b[k]) ? 1 : 0;
            }
            LaneMask const lit = worlds.few.unoccluded(packet, stats);
            other += lit != worlds.embree.unoccluded(packet, stats) ? 1 : 0;
            for (std::size_t k = 0; k < size; ++k) hidden += 1 - (lit >> k & 1u);
        }
        CHECK(found > n / 2);
        CHECK(hidden > n / 2);
        CHECK(other == 0);
    }
}

TEST_CASE("light that passes spheres in part is the same beside Embree's tree") {
    Both const worlds(kPassages);
    RayStats stats;
    Rays random(13);
    std::uint64_t partly = 0;
    std::uint64_t const n = tries(5'000);
    for (std::uint64_t i = 0; i < n; ++i) {
        SurfaceHit from;
        if (!worlds.few.intersect(some_ray(kPassages, worlds.few, random), kInfinity, RayKind::Bounce, stats,
                                  from))
            continue;
        LightSample to;
        to.wi = random.direction();
        to.at_infinity = true;
        if (i % 2 == 0) to.p = 3.0f * random.direction(), to.at_infinity = false;
        float const share = worlds.few.transmittance(from, to, stats);
        REQUIRE(share == worlds.embree.transmittance(from, to, stats));
        partly += share > 0.0f && share < 1.0f ? 1 : 0;
    }
    CHECK(partly > n / 50);
}

TEST_CASE("of a sphere and a triangle at one distance a packet's rays meet the one of the least number") {
    Scene plane = empty();
    add(plane, square(1, 1));
    Scene ball = empty();
    add(ball, Sphere{});
    World const plane_alone = compile(plane);
    World const ball_alone = compile(ball);
    add(plane, Sphere{});
    add(ball, square(1, 1));
    for (Scene const& s : {plane, ball}) {
        World const world = compile(s);
        World const embree = compile(given_to_embree(s));
        Rays random(14);
        RayStats stats;
        std::uint64_t ties = 0;
        for (int i = 0; i < 2'000; ++i) {
            // Where they touch: nearer than floats tell.
            RayPacket packet;
            for (std::size_t k = 0; k < kLanes; ++k) {
                Vec3 const at{0x1p-13f * random.in(-1, 1), 0x1p-13f * random.in(-1, 1), 1};
                Vec3 const from{random.in(-2, 2), random.in(-2, 2), 4};
                packet.set(k, {from, at - from}, kInfinity);
            }
            Hits hits;
            Hits others;
            world.intersect(packet, stats, hits);
            embree.intersect(packet, stats, others);
            for (std::size_t k = 0; k < kLanes; ++k) {
                REQUIRE(bits(hits[k]) == bits(others[k]));
                RawHit a;
                RawHit b;
                Ray const ray = packet.ray(k);
                if (!plane_alone.intersect(ray, kInfinity, RayKind::Bounce, stats, a) ||
                    !ball_alone.intersect(ray, kInfinity, RayKind::Bounce, stats, b) || a.t != b.t)
                    continue;
                ++ties;
                REQUIRE(hits[k].geometry == 0);
            }
        }
        CHECK(ties > 1'000);
    }
}

TEST_CASE("of spheres at one distance the first is met") {
    Scene s = empty();
    for (int i = 0; i < 3; ++i) add(s, Sphere{});
    World const world = compile(s);
    Rays random(16);
    RayStats stats;
    for (int i = 0; i < 2'000; ++i) {
        RayPacket packet;
        for (std::size_t k = 0; k < kLanes; ++k) {
            Vec3 const from = random.in(0, 3) * random.direction();
            packet.set(k, {from, 0.3f * random.direction() - from}, kInfinity);
        }
        Hits hits;
        world.intersect(packet, stats, hits);
        for (std::size_t k = 0; k < kLanes; ++k) {
            RawHit single;
            REQUIRE(world.intersect(packet.ray(k), kInfinity, RayKind::Bounce, stats, single));
            REQUIRE(bits(single) == bits(hits[k]));
            REQUIRE(single.geometry == 0);
        }
    }
}

TEST_CASE("the world's box holds the spheres that Embree does not know") {
    for (Case const& c : kCases) {
        CAPTURE(std::string(c.name));
        World const world = compile(c.scene());
        Bounds3 const box = world.bounds();
        REQUIRE_FALSE(box.empty());
        Rays random(15);
        RayStats stats;
        for (int i = 0; i < 2'000; ++i) {
            SurfaceHit hit;
            if (c.extreme) continue;
            Vec3 const from = 0.3f * c.size * random.direction();
            if (!world.intersect({from, random.direction()}, kInfinity, RayKind::Camera, stats, hit))
                continue;
            for (int k = 0; k < 3; ++k) {
                float const off = hit.s.p_error[k];
                REQUIRE((hit.s.p[k] >= box.lo[k] - off && hit.s.p[k] <= box.hi[k] + off));
            }
        }
    }
    // Not wider than it has to be.
    Bounds3 const box = compile(bare()).bounds();
    CHECK(box.hi.x < 0.90001f);
    CHECK(box.lo.z > -0.90001f);
}

TEST_CASE("memory of spheres beside Embree's tree is counted") {
    Scene none = empty();
    add(none, square(1, 0));
    Scene one = none;
    add(one, Sphere{});
    CHECK(compile(one).memory().bvh > compile(none).memory().bvh);
}
