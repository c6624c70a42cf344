// Both photon integrators against closed forms, and a prism's colours against light tracing.
#include "photon_classes.h"
#include "scene/match.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {}  // namespace

TEST_CASE("closed forms: a furnace, a point light in a sphere, an integrating sphere") {
    // L_e / (1 - R) = 2; rho I / (pi r^2 (1 - rho)) = 1; and rho Phi / (A (1 - rho)) of indirect irradiance, wherever the light is.
    int const n = samples(2500, 100000);
    for (Integrator const& integrator :
         {Integrator{photon_map(n, true, 0, 0)}, Integrator{photon_map(n, false, 0.1f, 0)},
          Integrator{progressive(20, n, 0.1f)}}) {
        CAPTURE(integrator.index());
        auto const means = [&](Scene s, Vec3 eye) {
            look_around(s, eye);
            World const world = compile(std::move(s));
            Settings how = settings(integrator, 12, 12);
            how.spp = 2;
            return film_means(world, how, 2, 7);
        };
        double const room = 0.006 * (kSanitizerShare > 1 ? 4 : 1);
        Scene furnace;
        add(furnace, box_mesh({-1, -1, -1}, {1, 1, 1}, true), diffuse(furnace, 0.5f)).light = white(1);
        auto const in_furnace = means(furnace, {0.1f, 0.2f, 0.3f});
        CHECK(in_furnace.beauty[1].mean() == doctest::Approx(2).epsilon(room));
        CHECK(in_furnace.light[0][1].mean() == doctest::Approx(1.5).epsilon(room));
        CHECK(in_furnace.light[2][1].mean() == doctest::Approx(0.5).epsilon(3 * room));
        Scene centre;
        add(centre, Sphere{}, diffuse(centre, 0.5f));
        centre.add(point_light({0, 0, 0}, kPi));
        auto const lit = means(centre, {0.2f, -0.3f, 0.1f});
        CHECK(lit.beauty[1].mean() == doctest::Approx(1).epsilon(room));
        CHECK(lit.light[0][1].mean() == doctest::Approx(0.5).epsilon(1e-3));
        Scene aside;
        add(aside, Sphere{}, diffuse(aside, 0.5f));
        aside.add(point_light({0.3f, 0.2f, -0.1f}, 1));
        auto const even = means(aside, {0, 0, 0});
        CHECK(even.light[2][1].mean() * kPiD / 0.5 == doctest::Approx(1).epsilon(2.5 * room));
        for (auto const& m : {in_furnace, lit, even}) CHECK(m.light[1][1].mean() + m.light[3][1].mean() == 0);
    }
}

TEST_CASE("closed forms: a mirror's caustic, and n^2 L inside a ball of glass") {
    Scene s;
    add(s, floor_quad(3), diffuse(s, 0.5f));
    add(s, Quad{{1, -0.5f, 0}, {0, 1, 0}, {0, 0, 1}}, mirror(s, 1.0f));
    s.add(point_light({0, 0, 1}, 1));
    look_parallel(s, {0.5f, 0, 0.02f}, {0, 0, -1}, 0.005f);
    World const floor = compile(std::move(s));
    Scene ball;
    add(ball, Sphere{}, glass(ball));
    ball.add(sky(1));
    look_around(ball, {0, 0, 0});
    World const inside = compile(std::move(ball));
    double const to_radiance = 0.5 / kPiD;
    int const n = samples(20000, 200000);
    for (Integrator const& integrator :
         {Integrator{photon_map(n, true, 0, 0.1f)}, Integrator{photon_map(n, false, 0.1f, 0.1f)},
          Integrator{progressive(5, n, 0.1f)}}) {
        auto const means = film_means(floor, settings(integrator, 2, 2), 1, 3);
        CHECK(means.light[0][1].mean() == doctest::Approx(0.715542 * to_radiance).epsilon(0.005));
        // Blurred over 0.1, which takes less than 0.3%.
        Mean const& caustic = means.light[1][1];
        CHECK(caustic.half_width(1e-4) < 0.03 * (kSanitizerShare > 1 ? 3 : 1) * 0.170677 * to_radiance);
        CHECK(std::abs(caustic.mean() - 0.170677 * to_radiance) <
              caustic.half_width(1e-4) + 0.003 * 0.170677 * to_radiance);
        // From the middle of the ball every ray leaves straight; what is reflected inside is reflected again.
        Settings how = settings(integrator, 8, 8);
        match(how.integrator, [](auto& i) {
            if constexpr (requires { i.shooting; }) i.shooting.global_paths = 50;
        });
        auto const seen = film_means(inside, how, 4, 4);
        CHECK(seen.light[3][1].mean() == doctest::Approx(2.25).epsilon(0.02));
        CHECK(seen.light[0][1].mean() + seen.light[1][1].mean() + seen.light[2][1].mean() == 0);
    }
}

TEST_CASE("a prism's colours on a wall are those of light tracing") {
    // A wedge bends a beam by its colour: red and blue land apart.
    Scene s;
    TriangleMesh wedge = box_mesh({-1, -1, 0}, {1, 1, 2}, false);
    for (Vec3& p : wedge.p)
        if (p.z > 1) p.z = 1.0f + 0.466f * p.x;
    add(s, wedge, flint(s));
    add(s, Quad{{-20, -20, 12}, {0, 40, 0}, {40, 0, 0}}, diffuse(s, 0.5f));
    SpotLight spot;
    spot.from = {0, 0, -8};
    spot.to = {0, 0, 0};
    spot.scale = 4000;
    spot.cone_angle = 0.03f;
    spot.cone_delta = 0;
    s.add(Light{spot, {}, {}});
    look_parallel(s, {4.5f, 0, 11}, {0, 0, 1}, 4);
    World const world = compile(std::move(s));
    Settings how = settings(progressive(5, samples(200, 2000), 0.15f), 20, 2);
    how.color = ColorMode::Spectral;
    constexpr std::uint64_t passes = 64;
    auto const by_maps = measure_layers(world, how, passes, 1);
    LightPathIntegrator lights;
    lights.paths = samples(1000, 20000);
    how.integrator = lights;
    auto const by_light = measure_layers(world, how, passes, 2);
    // The beam lies over some of the columns; where its red and where its blue are is where light tracing has them.
    std::array<std::array<double, 2>, 3> centre{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t which : {0u, 1u}) {
            auto const& m = which == 0 ? by_maps : by_light;
            double sum = 0, moment = 0;
            for (std::size_t i = 0; i < m.size(); ++i) {
                sum += m[i].light[1][c].mean();
                moment += m[i].light[1][c].mean() * static_cast<double>(i % 20);
            }
            CHECK(sum > 0);
            centre[c][which] = moment / sum;
        }
        double a = 0, b = 0;
        for (std::size_t i = 0; i < by_maps.size(); ++i)
            a += by_maps[i].light[1][c].mean(), b += by_light[i].light[1][c].mean();
        CHECK(a == doctest::Approx(b).epsilon(0.03 * (kSanitizerShare > 1 ? 3 : 1)));
        CHECK(std::abs(centre[c][0] - centre[c][1]) < 0.1 * kSanitizerShare);
        MESSAGE("channel ", c, ": column ", centre[c][0], " by maps, ", centre[c][1],
                " by light tracing; power ", a / b);
    }
    CHECK(std::abs(centre[0][0] - centre[2][0]) > 1);  // the colours do part
}
