// Spheres lit from within: what a point light does, and what two surfaces do to each other.
#include "measure.h"
#include "scenes.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

Scene lit_sphere(Vec3 light, float intensity, float reflectance) {
    Scene s;
    add(s, Sphere{}, diffuse(s, reflectance));
    s.add(point_light(light, intensity));
    look_around(s, {0.2f, -0.3f, 0.1f});
    return s;
}

}  // namespace

TEST_CASE("point light in the centre of a sphere") {
    // L = rho I / (pi r^2 (1 - rho)): 1 for rho = 1/2, I = pi. Cut after n bounces: 1 - 2^-n.
    World const world = compile(lit_sphere({0, 0, 0}, kPi, 0.5f));
    for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
        std::uint64_t const passes = color == ColorMode::Rgb ? 1 : 64;
        auto const check = [&](PathIntegrator const& p, double expected) {
            Settings s = settings(p);
            s.color = color;
            check_mean(world, s, passes, expected);
        };
        check(path(25), 1);
        check(uniform_hemisphere(path(25)), 1);
        check(without_mis(path(25)), 1);
        check(path(10000, RouletteKind::Throughput), 1);
        check(path(10000, RouletteKind::Fixed, 0.5f), 1);
        for (int n = 0; n <= 9; ++n) check(path(n), 1 - std::pow(0.5, n));
    }
    check_mean(world, settings(DirectIntegrator{5}), 4, 0.5);
    check_mean(world, settings(WhittedIntegrator{5}), 4, 0.5);
    // Chance never meets a point.
    check_mean(world, settings(naive(path(25))), 4, 0.0);
}

TEST_CASE("integrating sphere: indirect light is the same everywhere") {
    // Whatever the walls reflect for the first time spreads evenly over all of a sphere: with n bounces and a source of
    // Phi = 4 pi anywhere in the unit sphere, E_ind = Phi / A (rho + rho^2 + … + rho^(n - 1)), 1 for n -> infinity and
    // rho = 1/2. What is seen is rho E_ind / pi and the first bounce, rho I cos / (pi d^2).
    Vec3 const light{0.3f, 0.2f, -0.1f};
    Scene scene = lit_sphere(light, 1, 0.5f);
    look_around(scene, {0, 0, 0});
    World const world = compile(scene);
    double const indirect = 1 - std::pow(0.5, 5);
    auto run = [&](int bounces, std::uint64_t passes) {
        return measure(world, point_settings(path(bounces), 8, 4), passes, true);
    };
    Means const first = run(1, 1);
    Means const all = run(6, full() ? 8192 : 512);
    RenderJob const job(world, point_settings(path(1), 8, 4));
    double const scale = static_cast<double>(kPi) / 0.5;
    for (std::size_t i = 0; i < all.size(); ++i) {
        CAPTURE(i);
        Vec2 const at{static_cast<float>(i % 8) + 0.5f, static_cast<float>(i / 8) + 0.5f};
        Vec3 const p = job.camera().ray(at, {0.5f, 0.5f}).ray.d;
        Vec3 const to_light = light - p;
        float const d = length(to_light);
        double const direct = 0.5f / kPi * dot(-p, to_light) / (d * d * d);
        CHECK(first[i][1].mean() == doctest::Approx(direct).epsilon(2e-4));
        Mean const& m = all[i][1];
        CHECK(m.half_width() * scale <= power() * indirect);
        double const off = (m.mean() - first[i][1].mean()) * scale - indirect;
        CHECK(student_p(off / (m.standard_error() * scale), kBatches - 1) >= sidak(32));
    }
}

TEST_CASE("concentric spheres: misdirected rays, which furnaces miss") {
    // The inner sphere (r1 = 1/2) emits E1 = pi, both reflect rho = 1/2. Of what leaves the outer one (r2 = 1) s = (r1/r2)^2
    // reaches the inner one: B1 = E1 + rho B2, B2 = rho (s B1 + (1 - s) B2), L = B / pi: 10/9 and 2/9.
    Scene scene;
    MaterialId const gray = diffuse(scene, 0.5f);
    add(scene, Sphere{0.5f, -0.5f, 0.5f}, gray).light = white(1);
    add(scene, Sphere{}, gray);
    look_parallel(scene, {0, 0, 0.8f}, {0, 0, -1}, 0.3f);
    Scene outwards = scene;
    look_parallel(outwards, {0, 0, 0.8f}, {0, 0, 1}, 0.3f);
    World const inner = compile(scene);
    World const outer = compile(outwards);
    for (auto const& p : {path(20), path(10000, RouletteKind::Throughput)}) {
        check_mean(inner, settings(p), 64, 1.0 + 1.0 / 9.0);
        check_mean(outer, settings(p), 64, 2.0 / 9.0);
    }
    for (auto const& p : {naive(path(20)), uniform_hemisphere(path(20))})
        check_mean(outer, settings(p), 64, 2.0 / 9.0);
    Settings s = settings(path(10000, RouletteKind::Throughput));
    s.color = ColorMode::Spectral;
    check_mean(outer, s, 64, 2.0 / 9.0);
}
