// Irradiance at photons is what estimates say there, wherever it is looked up; it does not leak, and does not depend on threads.
#include "irradiance.h"
#include "estimates.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

using namespace nephroid;
using namespace nephroid::test;

namespace {
/// The inside of a box: places, and normals inwards.
struct Placed {
    Vec3 p, n;
};
Placed in_box(Random& random, float offset = 0) {
    std::uint32_t const face = random.below(6);
    auto const axis = static_cast<int>(face / 2);
    Placed at{{2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1}, {0, 0, 0}};
    float const side = face % 2 ? 1.0f : -1.0f;
    at.p[axis] = side * (1 + offset);
    at.n[axis] = -side;
    return at;
}
std::vector<Photon> box_photons(Random& random, int count) {
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i) {
        Placed const at = in_box(random);
        photons.emplace_back(landed(at.p, at.n, 24 * (1 + at.p.x * at.p.y) / static_cast<float>(count)));
    }
    return photons;
}
World box_world() {
    Scene s;
    add(s, box_mesh({-1, -1, -1}, {1, 1, 1}, true), diffuse(s, 0.5f));
    return compile(std::move(s));
}
bool same(Spectrum a, Spectrum b) {
    // As photons keep powers.
    for (int i = 0; i < 4; ++i)
        if (std::abs(a[i] - b[i]) > 2e-5f * b.max()) return false;
    return true;
}
}  // namespace

TEST_CASE(
    "irradiance looked up is the estimate at the nearest place on a surface that faces alike: against brute "
    "force") {
    World const world = box_world();
    Probe probe(world);
    Random random(1);
    PhotonMap const map(box_photons(random, 8000));
    for (EstimateRule how : {rule(Kernel::Epanechnikov, 50, 0.5f), rule(Kernel::Cone, 0, 0.2f)}) {
        how.edge_correction = how.k != 0;
        RayStats stats;
        IrradianceMap const places(world, map, how, stats);
        CHECK(places.size() == 2000);
        CHECK(places.typical_radius() > 0);
        CHECK(places.typical_radius() <= how.radius);
        if (how.edge_correction) CHECK(stats.rays[static_cast<std::size_t>(RayKind::Bounce)] > 0);
        NearestPhotons nearest;
        int wrong = 0;
        for (int i = 0; i < samples(2000, 20000); ++i) {
            Placed const at = in_box(random);
            // Along edges and in corners other walls' places are nearer.
            std::size_t best = map.size();
            float least = sqr(how.radius);
            for (std::size_t j = 0; j < map.size(); j += 4) {
                float const d2 = distance_squared(map[j].p(), at.p);
                if (d2 < least && dot(map[j].n(), at.n) > 0.7f) best = j, least = d2;
            }
            Spectrum const there = best == map.size()
                                       ? Spectrum{}
                                       : probe.irradiance(map, how, map[best].p(), map[best].n(), 4).radiance;
            if (!same(places.at(at.p, at.n, nearest), there)) ++wrong;
        }
        CHECK(wrong == 0);
        // Nothing faces outwards, and far away there is nothing.
        CHECK(places.at({0.5f, 0.5f, -1}, {0, 0, -1}, nearest).is_black());
        CHECK(places.at({0, 0, 0}, {0, 0, 1}, nearest).is_black());
    }
}

TEST_CASE(
    "irradiance of an even field: right on the whole wall, and with the correction along its edges too") {
    World const world = box_world();
    Random random(2);
    std::vector<Photon> photons;
    constexpr int kCount = 60000;
    for (int i = 0; i < kCount; ++i) {
        Placed const at = in_box(random);
        photons.emplace_back(landed(at.p, at.n, 24.0f / kCount));
    }
    PhotonMap const map(std::move(photons));
    NearestPhotons nearest;
    auto const mean = [&](bool corrected, float from, float to) {
        EstimateRule how = rule(Kernel::Epanechnikov, 100, 1);
        how.edge_correction = corrected;
        RayStats stats;
        IrradianceMap const places(world, map, how, stats);
        Mean m;
        Random where(3);
        for (int i = 0; i < 20000; ++i) {
            Placed const at = in_box(where);
            Vec3 const a = abs(at.p);
            float const second = a.x + a.y + a.z - max_component(a) - std::min({a.x, a.y, a.z});
            if (second >= from && second < to) m.add(static_cast<double>(places.at(at.p, at.n, nearest)[0]));
        }
        return m.mean();
    };
    // Points find the places that have most room around them, where photons happen to be sparse; the places know (OwnPhoton).
    CHECK(mean(true, 0, 0.85f) == doctest::Approx(1).epsilon(0.006));
    CHECK(mean(true, 0, 1) ==
          doctest::Approx(1).epsilon(0.015));  // some of the edge's width passes for whole
    CHECK(mean(true, 0.98f, 1) == doctest::Approx(1).epsilon(0.04));
    CHECK(mean(false, 0.98f, 1) < 0.75);
}

TEST_CASE("both sides of a thin wall keep their own irradiance") {
    Scene s;
    add(s, floor_quad(1), diffuse(s, 0.5f));
    World const world = compile(std::move(s));
    Random random(1);
    std::vector<Photon> photons;
    scatter_over(photons, random, floor_quad(1), {0, 0, 1}, 20000, 1);
    scatter_over(photons, random, floor_quad(1, -1e-4f), {0, 0, -1}, 20000, 3);
    PhotonMap const map(std::move(photons));
    RayStats stats;
    IrradianceMap const places(world, map, rule(Kernel::Box, 100, 1), stats);
    NearestPhotons nearest;
    for (int i = 0; i < 200; ++i) {
        Vec3 const p{random.unit() - 0.5f, random.unit() - 0.5f, 0};
        CHECK(places.at(p, {0, 0, 1}, nearest)[0] == doctest::Approx(1).epsilon(0.6));
        CHECK(places.at(p, {0, 0, -1}, nearest)[0] == doctest::Approx(3).epsilon(0.6));
    }
    // A wall lit from one side alone.
    std::vector<Photon> one_side;
    scatter_over(one_side, random, floor_quad(1), {0, 0, 1}, 5000, 1);
    PhotonMap const lit(std::move(one_side));
    IrradianceMap const lit_places(world, lit, rule(Kernel::Box, 100, 1), stats);
    CHECK(lit_places.at({0, 0, 0}, {0, 0, -1}, nearest).is_black());
    CHECK_FALSE(lit_places.at({0, 0, 0}, {0, 0, 1}, nearest).is_black());
}

TEST_CASE("a place is found however many of another side are nearer") {
    // Around one spot hundreds of photons on the far side, and those of this side a little farther off.
    Scene s;
    add(s, floor_quad(1), diffuse(s, 0.5f));
    World const world = compile(std::move(s));
    Random random(1);
    std::vector<Photon> photons;
    scatter_over(photons, random, floor_quad(0.01f), {0, 0, -1}, 4000, 1);
    for (int i = 0; i < 400; ++i)
        photons.emplace_back(landed({0.1f, 0.1f * random.unit(), 0}, {0, 0, 1}, 0.01f));
    PhotonMap const map(std::move(photons));
    RayStats stats;
    IrradianceMap const places(world, map, rule(Kernel::Box, 0, 0.3f), stats);
    NearestPhotons nearest;
    CHECK_FALSE(places.at({0, 0, 0}, {0, 0, 1}, nearest).is_black());
}

TEST_CASE("irradiance maps are the same on any number of threads, and empty ones are black") {
    World const world = box_world();
    Random random(1);
    std::vector<Photon> const photons = box_photons(random, 20000);
    auto const build = [&](int threads) {
        tbb::global_control const room(tbb::global_control::max_allowed_parallelism, 8);
        tbb::task_arena arena(threads);
        return arena.execute([&] {
            RayStats stats;
            PhotonMap const map(photons);
            EstimateRule how = rule(Kernel::Gaussian, 40, 1);
            how.edge_correction = true;
            return std::pair(IrradianceMap(world, map, how, stats), stats.rays);
        });
    };
    auto const [one, one_rays] = build(1);
    auto const [seven, seven_rays] = build(7);
    CHECK(one_rays == seven_rays);
    CHECK(one.typical_radius() == seven.typical_radius());
    NearestPhotons nearest;
    int different = 0;
    for (int i = 0; i < 5000; ++i) {
        Placed const at = in_box(random);
        Spectrum const a = one.at(at.p, at.n, nearest), b = seven.at(at.p, at.n, nearest);
        for (int lane = 0; lane < 4; ++lane) different += a[lane] != b[lane];
    }
    CHECK(different == 0);
    IrradianceMap const none;
    CHECK(none.size() == 0);
    CHECK(none.at({0, 0, 0}, {0, 0, 1}, nearest).is_black());
    RayStats stats;
    IrradianceMap const of_nothing(world, PhotonMap(), rule(Kernel::Box, 50, 1), stats);
    CHECK(of_nothing.at({0, 0, 0}, {0, 0, 1}, nearest).is_black());
}
