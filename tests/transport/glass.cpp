// Smooth glass and metal against Fresnel's and Snell's laws.
#include "emitters.h"
#include "measure.h"
#include "model/fresnel.h"
#include "model/material.h"
#include "scenes.h"
#include "spectrum/color.h"
#include "spectrum/named.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// A large pane in the xy plane, and a large emitter behind it (below) or on the camera's side (above).
Scene pane(Shape const& shape, MaterialId (*make)(Scene&), bool behind, float degrees) {
    Scene s;
    add(s, shape, make(s));
    Quad emitter = floor_quad(60, behind ? -8.0f : 8.0f);
    add(s, emitter).light = white(1, true);
    Vec3 const d{std::sin(radians(degrees)), 0, -std::cos(radians(degrees))};
    look_parallel(s, Vec3{0, 0, 0} - 2.0f * d, d, 0.1f);
    return s;
}
MaterialId plain_glass(Scene& s) { return glass(s); }
MaterialId thin_glass(Scene& s) { return material(s, ThinDielectricMaterial{}); }

std::vector<Integrator> deep() {
    return {path(40), naive(path(40)), DirectIntegrator{40}, WhittedIntegrator{14}};
}

/// Hero wavelength of these nm.
Wavelengths hero(double nm) {
    return Wavelengths::spectral(
        static_cast<float>((0.85691062 - std::tanh((538 - nm) / 138.888889)) / 1.82750197));
}

}  // namespace

TEST_CASE("glass slab: all orders of reflection, T = (1 - F)/(1 + F)") {
    struct Angle {
        float degrees;
        double t;
    };
    // 45 degrees: unpolarised light averaged at each surface anew, as a tracer without polarisation does.
    for (Angle const a : {Angle{0, .9230769231}, Angle{45, .9043267915}}) {
        Box const slab{{-40, -40, -0.5f}, {40, 40, 0}};
        for (bool behind : {true, false}) {
            World const thick = compile(pane(slab, plain_glass, behind, a.degrees));
            World const thin = compile(pane(floor_quad(40), thin_glass, behind, a.degrees));
            for (Integrator const& i : deep()) {
                check_mean(thick, settings(i), 64, behind ? a.t : 1 - a.t);
                check_mean(thin, settings(i), 64, behind ? a.t : 1 - a.t);
            }
            Settings s = settings(path(40));
            s.color = ColorMode::Spectral;
            check_mean(thick, s, 256, behind ? a.t : 1 - a.t);
        }
    }
}

TEST_CASE("inside glass, radiance is n^2 as great") {
    // Paths are built from the camera with Mode::Radiance: leaving the ball of n = 1.5 multiplies by (1 - F) n^2, and what is
    // reflected passes the centre again and has its next chance: sum of F^k (1 - F) n^2 = n^2 = 2.25. From outside, where each
    // path goes in and out again, the factors cancel and the sky shows its 1.
    Scene scene;
    add(scene, Sphere{}, glass(scene));
    scene.add(sky());
    Scene outside = scene;
    look_around(scene, {0, 0, 0});
    look_parallel(outside, {0, 0, 3}, {0, 0, -1}, 1.2f);
    World const in = compile(scene);
    World const out = compile(outside);
    for (Integrator const& i :
         {Integrator{path(30)}, Integrator{naive(path(30))}, Integrator{DirectIntegrator{30}},
          Integrator{path(10000, RouletteKind::Throughput)}, Integrator{WhittedIntegrator{12}}}) {
        check_mean(in, settings(i), 16, 2.25);
        bool const tree = std::holds_alternative<WhittedIntegrator>(i);
        if (!tree) check_mean(out, settings(i), 64, 1.0);
    }
    // Roulette by throughput knows that the squeezed radiance is no reason to live longer, or to die sooner.
    Scene dense = scene;
    dense.materials.front().kind = DielectricMaterial{ConstantSpd{2.4f}};
    check_mean(compile(dense), settings(path(10000, RouletteKind::Throughput)), 64, 5.76);
}

TEST_CASE("white furnace with glass balls, dispersive or not, stays white") {
    for (Spd const& eta : {Spd{ConstantSpd{1.5f}}, Spd{NamedSpd{"glass-SF11"}}, Spd{NamedSpd{"glass-BK7"}}})
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
            Scene scene;
            MaterialId const g = glass(scene, eta);
            add(scene, Sphere{0.5f, -0.5f, 0.5f}, g);
            add(scene, Box{{0.6f, -0.5f, -0.5f}, {1.2f, 0.4f, 0.3f}}, g);
            scene.add(sky());
            look_parallel(scene, {0.2f, 0, 3}, {0, 0, -1}, 1);
            World const world = compile(scene);
            for (auto const& p : {path(60), path(10000, RouletteKind::Throughput)}) {
                Settings s = settings(p, 4, 4);
                s.color = color;
                check_mean(world, s, 64, 1.0);
            }
        }
}

TEST_CASE("metal under a white sky shows its Fresnel reflectance") {
    struct Metal {
        float eta, k;
        std::array<double, 3> r;  // at 0, 60, 80 degrees
    };
    Metal const metals[] = {{0.183f, 3.43f, {.9443954444, .9388588987, .9481117105}},
                            {0.06f, 3.59f, {.9828714574, .9808372714, .983008892}},
                            {0.214f, 3.67f, {.9427144874, .936258258, .9425032346}},
                            {0.96f, 6.69f, {.9209839149, .9067464854, .8676193027}}};
    for (Metal const& m : metals)
        for (std::size_t a = 0; a < 3; ++a) {
            Scene scene;
            add(scene, floor_quad(40), metal(scene, ConstantSpd{m.eta}, ConstantSpd{m.k}));
            scene.add(sky());
            float const angle = radians(std::array<float, 3>{0, 60, 80}[a]);
            Vec3 const d{std::sin(angle), 0, -std::cos(angle)};
            look_parallel(scene, -2.0f * d, d, 0.1f);
            World const world = compile(scene);
            for (Integrator const& i :
                 {Integrator{path(3)}, Integrator{DirectIntegrator{3}}, Integrator{WhittedIntegrator{3}}})
                check_mean(world, settings(i), 1, m.r[a]);
            Settings s = settings(path(3));
            s.color = ColorMode::Spectral;
            check_mean(world, s, 64, m.r[a]);
        }
}

TEST_CASE("measured metals: the sky's spectrum times Fresnel, as the observer sees it") {
    for (std::string const name : {"Ag", "Al", "Au", "Cu", "CuZn"}) {
        CAPTURE(name);
        Scene scene;
        add(scene, floor_quad(40),
            metal(scene, NamedSpd{"metal-" + name + "-eta"}, NamedSpd{"metal-" + name + "-k"}));
        scene.add(sky());
        Vec3 const d{std::sin(radians(60)), 0, -std::cos(radians(60))};
        look_parallel(scene, -2.0f * d, d, 0.1f);
        World const world = compile(scene);
        auto const eta = named_spectrum("metal-" + name + "-eta");
        auto const k = named_spectrum("metal-" + name + "-k");
        std::array<double, 3> expected{};
        int const n = 4096;
        for (int i = 0; i < n; ++i) {
            auto const lambda = Wavelengths::spectral((static_cast<float>(i) + 0.5f) / n);
            Spectrum l = world.environment({}, {0, 0, 1}, lambda);
            for (int j = 0; j < 4; ++j) {
                auto const nm = static_cast<double>(lambda.lambda(j));
                l.set(j, l[j] * fresnel_conductor(0.5f, static_cast<float>(interpolate(*eta, nm)),
                                                  static_cast<float>(interpolate(*k, nm))));
            }
            Vec3 const rgb = to_linear_srgb(l, lambda);
            for (std::size_t c = 0; c < 3; ++c)
                expected[c] += static_cast<double>(rgb[static_cast<int>(c)]) / n;
        }
        Settings s = settings(path(3));
        s.color = ColorMode::Spectral;
        check_mean(world, s, 64, Vec3(expected[0], expected[1], expected[2]));
    }
}

TEST_CASE("prisms: minimum deviation of the F, d and C lines") {
    struct Glass {
        char const* name;
        double deviation_d, spread;
    };
    for (Glass const& g :
         {Glass{"glass-N-BK7", 38.64669851, .708972032}, Glass{"glass-F2", 48.19578444, 1.672938079},
          Glass{"glass-N-SF11", 66.34262882, 3.938525262}, Glass{"glass-N-SF10", 59.56896421, 2.933914028}}) {
        CAPTURE(g.name);
        // A prism of 60 degrees, its edge along z.
        Scene scene;
        float const h = std::sqrt(3.0f);
        TriangleMesh m;
        for (float z : {-5.0f, 5.0f})
            for (Vec3 const c : {Vec3{-1, 0, z}, Vec3{1, 0, z}, Vec3{0, h, z}}) m.p.push_back(c);
        m.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                       {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
        add(scene, m, glass(scene, NamedSpd{g.name}));
        World const world = compile(scene);

        // The direction behind the prism of a ray that meets the middle of its left face; the hero lane refracts.
        auto const deviation = [&](double incidence, double nm) -> double {
            Wavelengths const lambda = hero(nm);
            // The left face's normal points to 150 degrees; the ray comes from below it.
            double const from = (150 + incidence) * kPiD / 180;
            Vec3 const d{-std::cos(from), -std::sin(from), 0};
            Ray ray{Vec3{-0.5f, h / 2, 0} - 0.5f * d, d};
            RayStats stats;
            for (int surface = 0; surface < 2; ++surface) {
                SurfaceHit hit;
                if (!world.intersect(ray, kInfinity, RayKind::Bounce, stats, hit)) return 180;
                Frame const frame = frame_from_z(hit.s.ns);
                Bsdf bsdf;
                REQUIRE(make_bsdf(world.assets(), hit.material, {}, lambda, bsdf));
                auto const s = sample(bsdf, frame.to_local(-ray.d), kOneMinusEpsilon, {}, Mode::Radiance,
                                      HemisphereSampling::Cosine);
                if (!s || !s->transmitted) return 180;
                CHECK(s->keep_hero);
                ray = hit.spawn(normalize(frame.from_local(s->wi)));
            }
            double const cosine = static_cast<double>(nephroid::dot(ray.d, d));
            double const sine = static_cast<double>(nephroid::length(nephroid::cross(ray.d, d)));
            return std::atan2(sine, cosine) * 180 / kPiD;
        };
        auto const least = [&](double nm) {
            // Near its minimum the deviation is a parabola in the angle of incidence: golden section to where floats end.
            double lo = 35;
            double hi = 80;
            double const golden = (std::sqrt(5.0) - 1) / 2;
            for (int i = 0; i < 22; ++i) {
                double const a = hi - golden * (hi - lo);
                double const b = lo + golden * (hi - lo);
                (deviation(a, nm) < deviation(b, nm) ? hi : lo) = deviation(a, nm) < deviation(b, nm) ? b : a;
            }
            return deviation((lo + hi) / 2, nm);
        };
        CHECK(least(587.56) == doctest::Approx(g.deviation_d).epsilon(1e-5));
        CHECK(std::abs(least(486.13) - least(656.27) - g.spread) < 1e-3);
    }
}
