// The furnace: where every surface emits Le and reflects R, every direction carries Le / (1 - R); paths cut after N segments
// carry Le (1 - R^N) / (1 - R). No geometry enters, so that nothing can hide a wrong factor.
#include "measure.h"
#include "scenes.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// The unit sphere from inside: it emits and reflects there.
Scene sphere_furnace(float emitted, MaterialId (*wall)(Scene&, float), float reflectance) {
    Scene s;
    Object& o = add(s, Sphere{}, wall(s, reflectance));
    o.light = white(emitted);
    o.reverse_orientation = true;
    look_around(s, {0.3f, 0.2f, -0.4f});
    return s;
}
MaterialId gray_wall(Scene& s, float r) { return diffuse(s, r); }
MaterialId mirror_wall(Scene& s, float r) { return mirror(s, r); }

Scene box_furnace(float emitted, float reflectance) {
    Scene s;
    add(s, box_mesh({-1, -2, -1.5f}, {1.5f, 1, 1}, true), diffuse(s, reflectance)).light = white(emitted);
    look_around(s, {0.3f, 0.2f, -0.4f});
    return s;
}

double sum(double emitted, double r, int n) { return emitted * (1 - std::pow(r, n)) / (1 - r); }

struct Case {
    float emitted, reflectance, expected;
};
constexpr Case kCases[] = {{1, 0.5f, 2}, {1, 0.8f, 5}, {0.5f, 0.5f, 1}, {0.1f, 0.9f, 1}};

std::vector<std::pair<char const*, Sampler>> samplers() {
    return {{"sobol", SobolSampler{}},
            {"stratified", StratifiedSampler{}},
            {"independent", IndependentSampler{}}};
}

}  // namespace

TEST_CASE("furnace: path tracing in a sphere, all samplers and ways of sampling") {
    World const world = compile(sphere_furnace(1, gray_wall, 0.5f));
    std::pair<char const*, PathIntegrator> const ways[] = {
        {"deep", path(20)},
        {"roulette by throughput", path(10000, RouletteKind::Throughput)},
        {"roulette by alpha", path(10000, RouletteKind::Fixed, 0.5f)},
        {"uniform hemisphere", uniform_hemisphere(path(20))}};
    for (auto const& [sampler_name, sampler] : samplers())
        for (auto const& [way_name, way] : ways) {
            CAPTURE(sampler_name);
            CAPTURE(way_name);
            auto const run = [&](char const* lights, PathIntegrator const& p) {
                CAPTURE(lights);
                Settings s = settings(p);
                s.sampler = sampler;
                check_mean(world, s, 8, 2.0);
            };
            run("mis", way);
            run("lights sampled, no mis", without_mis(way));
            run("lights not sampled", naive(way));
        }
}

TEST_CASE("furnace: every Le and R") {
    for (Case const& k : kCases) {
        World const world = compile(sphere_furnace(k.emitted, gray_wall, k.reflectance));
        CAPTURE(k.expected);
        for (auto const& p : {path(110), naive(path(110))}) check_mean(world, settings(p), 1, k.expected);
    }
    // A path survives as often as the walls reflect: much rarer, and the estimate would have no variance.
    World const world = compile(sphere_furnace(1, gray_wall, 0.8f));
    for (auto const& p : {path(10000, RouletteKind::Throughput), path(10000, RouletteKind::Fixed, 0.8f)})
        check_mean(world, settings(p), 64, 5.0);
}

TEST_CASE("furnace: a fixed survival of one half, where it has a variance") {
    World const world = compile(sphere_furnace(1, gray_wall, 0.6f));
    for (bool lights : {true, false}) {
        auto p = path(10000, RouletteKind::Fixed, 0.5f);
        p.sample_lights = lights;
        check_mean(world, settings(p), 64, 2.5);
    }
}

TEST_CASE("furnace: path tracing in a box of triangles") {
    for (Case const& k : kCases) {
        World const world = compile(box_furnace(k.emitted, k.reflectance));
        CAPTURE(k.expected);
        check_mean(world, settings(path(110)), 16, k.expected);
    }
    World const world = compile(box_furnace(1, 0.5f));
    for (auto const& [name, sampler] : samplers()) {
        CAPTURE(name);
        for (auto const& p : {path(20), naive(path(20)), uniform_hemisphere(path(20))}) {
            Settings s = settings(p);
            s.sampler = sampler;
            check_mean(world, s, 16, 2.0);
        }
    }
}

TEST_CASE("furnace: spectral") {
    World const sphere = compile(sphere_furnace(1, gray_wall, 0.5f));
    World const box = compile(box_furnace(1, 0.5f));
    for (World const* world : {&sphere, &box})
        for (auto const& p : {path(20), naive(path(20)), path(10000, RouletteKind::Throughput)}) {
            Settings s = settings(p);
            s.color = ColorMode::Spectral;
            check_mean(*world, s, 64, 2.0);
        }
    World const bright = compile(sphere_furnace(0.1f, gray_wall, 0.9f));
    Settings s = settings(path(110));
    s.color = ColorMode::Spectral;
    check_mean(bright, s, 64, 1.0);
}

TEST_CASE("furnace: the table of segments, a reflectance per channel") {
    // max_depth bounces are max_depth + 1 segments.
    Vec3 const r{0.3f, 0.5f, 0.9f};
    Scene scene;
    Object& o = add(scene, Sphere{}, diffuse(scene, r));
    o.light = white(1);
    o.reverse_orientation = true;
    look_around(scene, {0.3f, 0.2f, -0.4f});
    World const world = compile(scene);
    for (int n = 1; n <= 12; ++n) {
        CAPTURE(n);
        Vec3 const expected{sum(1, r.x, n), sum(1, r.y, n), sum(1, r.z, n)};
        for (auto const& p : {path(n - 1), naive(path(n - 1)), without_mis(path(n - 1)),
                              path(n - 1, RouletteKind::Throughput)})
            check_mean(world, settings(p), 4, expected);
        // Uniform directions let the throughput wander: its second moment grows as (4/3)^bounces.
        check_mean(world, settings(uniform_hemisphere(path(n - 1))), 32, expected);
    }
}

TEST_CASE("furnace: direct light and Whitted's tree end at the first diffuse surface") {
    for (Case const& k : kCases) {
        World const sphere = compile(sphere_furnace(k.emitted, gray_wall, k.reflectance));
        World const box = compile(box_furnace(k.emitted, k.reflectance));
        for (int n : {1, 2, 3, 12}) {
            CAPTURE(n);
            double const expected = k.emitted * (n == 1 ? 1 : 1 + k.reflectance);
            for (auto const& [name, sampler] : samplers()) {
                CAPTURE(name);
                Settings s = settings(DirectIntegrator{n - 1});
                s.sampler = sampler;
                check_mean(sphere, s, 2, expected);
                if (n <= 2) check_mean(box, s, 16, expected);
                s.integrator = WhittedIntegrator{n - 1};
                check_mean(sphere, s, 2, expected);
            }
        }
    }
}

TEST_CASE("furnace: mirror walls, seen from the centre") {
    // Rays meet the sphere head on, where the metal made for a reflectance has just that one.
    for (Case const& k : kCases) {
        Scene scene = sphere_furnace(k.emitted, mirror_wall, k.reflectance);
        look_around(scene, {0, 0, 0});
        World const world = compile(scene);
        for (int n = 1; n <= 12; ++n) {
            CAPTURE(n);
            for (Integrator const& i :
                 {Integrator{WhittedIntegrator{n - 1}}, Integrator{DirectIntegrator{n - 1}},
                  Integrator{path(n - 1)}, Integrator{naive(path(n - 1))}}) {
                Settings s = settings(i);
                for (auto const& [name, sampler] : samplers()) {
                    s.sampler = sampler;
                    check_mean(world, s, 1, sum(k.emitted, k.reflectance, n));
                }
            }
        }
    }
}
