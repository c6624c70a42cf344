// Light sent out from its sources: where it lands is what the sources send there, its densities are what a ray finds again, and all
// of it together is their power.
#include "emitters.h"
#include "measure.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

struct Sent {
    Mean power, landed;  // W, by batches; on the square |x|, |y| < half of the floor z = 0
    int lost = 0;
};

/// Photons, without bounces.
Sent send(World const& world, double half, int count) {
    Sent sent;
    Random random(11);
    RayStats stats;
    for (int batch = 0; batch < 32; ++batch) {
        double power = 0;
        double landed = 0;
        for (int i = 0; i < count / 32; ++i) {
            auto const r = world.sample_emission(random.uniform(), {random.unit(), random.unit()},
                                                 {random.unit(), random.unit()}, Wavelengths::rgb());
            if (!r) {
                ++sent.lost;
                continue;
            }
            auto const watts = static_cast<double>(r->power()[1]);
            CHECK(std::isfinite(watts));
            power += watts;
            SurfaceHit hit;
            if (!world.intersect(r->start(), kInfinity, RayKind::Bounce, stats, hit)) continue;
            // Not what comes from below.
            if (hit.s.p.z < 1e-3f && r->emission.ray.d.z < 0.0f &&
                std::abs(static_cast<double>(hit.s.p.x)) < half &&
                std::abs(static_cast<double>(hit.s.p.y)) < half)
                landed += watts;
        }
        sent.power.add(power / (count / 32));
        sent.landed.add(landed / (count / 32));
    }
    return sent;
}

/// The densities that a ray back to the surface finds are those that the sample had.
void check_density(World const& world, int count) {
    Random random(13);
    RayStats stats;
    int compared = 0;
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
        auto const r = world.sample_emission(random.uniform(), {random.unit(), random.unit()},
                                             {random.unit(), random.unit()}, Wavelengths::rgb());
        if (!r || r->emission.n == Vec3(0)) continue;
        // From a little way out, straight down to it.
        Vec3 const n = r->emission.n;
        SurfaceHit hit;
        if (!world.intersect({r->emission.ray.o + 1e-2f * n, -n}, 2e-2f, RayKind::Bounce, stats, hit))
            continue;
        if (!hit.emits || length(hit.s.p - r->emission.ray.o) > 1e-4f) continue;
        EmissionDensity const d = world.emission_density(hit, r->emission.ray.d);
        ++compared;
        double const position =
            static_cast<double>(r->emission.pdf_position) * static_cast<double>(r->choice);
        if (std::abs(static_cast<double>(d.position) / position - 1) > 1e-3 ||
            std::abs(static_cast<double>(d.direction) / static_cast<double>(r->emission.pdf_direction) - 1) >
                1e-3)
            ++wrong;
    }
    CHECK(compared > count / 4);
    CHECK(wrong <= compared / 1000);  // curved surfaces by rounding, edges
}

double quadrature(std::function<double(D3)> const& f, double half) {
    constexpr int n = 24;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            sum += f({((i + 0.5) / n * 2 - 1) * half, ((j + 0.5) / n * 2 - 1) * half, 0});
    return sum * 4 * half * half / (n * n);
}

}  // namespace

TEST_CASE("emission: every shape under transforms lights a floor as Lambert says, and sends its power") {
    for (auto const& e : emitting_shapes()) {
        CAPTURE(e.name);
        for (std::size_t const k : {std::size_t{2}, std::size_t{6}}) {
            Placement const where = placements()[k];
            CAPTURE(where.name);
            Scene scene;
            add(scene, floor_quad(50), diffuse(scene, 1));
            place(scene, e, where, 1, white(1));
            World const world = compile(scene);
            int const n = samples(320000, 3200000);
            Sent const sent = send(world, 0.8, n);
            double const expected =
                quadrature([&](D3 p) { return e.irradiance(turned(e, where.all()), p); }, 0.8);
            auto const on_floor = agrees(sent.landed, expected, 0.04, 0.001);
            CHECK_MESSAGE(on_floor, on_floor);
            auto const in_all = agrees(sent.power, static_cast<double>(world.total_power()), 0.01, 0.001);
            CHECK_MESSAGE(in_all, in_all);
            CHECK(sent.lost == 0);
            check_density(world, 2000);
        }
    }
}

TEST_CASE("emission: a sphere, a box, a two-sided disk have the power that one can write down") {
    struct Case {
        Shape shape;
        bool two_sided;
        double power;
    };
    for (Case const& c : {Case{Sphere{}, false, kPiD * 4 * kPiD}, Case{Disk{}, true, 2 * kPiD * kPiD},
                          Case{Box{}, false, kPiD * 24}, Case{Cylinder{}, true, 2 * kPiD * 4 * kPiD},
                          Case{Quad{}, false, kPiD * 4}}) {
        Scene scene;
        add(scene, c.shape).light = white(1, c.two_sided);
        World const world = compile(scene);
        Sent const sent = send(world, 1, samples(64000, 640000));
        auto const a = agrees(sent.power, c.power, 0.01, 0.002);
        CHECK_MESSAGE(a, a);
        CHECK(static_cast<double>(world.total_power()) == doctest::Approx(c.power).epsilon(1e-4));
    }
}

TEST_CASE("emission: lights of all kinds together, each as often as its power says") {
    Scene scene;
    add(scene, floor_quad(2), diffuse(scene, 1));
    add(scene, Sphere{0.2f, -0.2f, 0.2f}).light = white(3);
    scene.world().objects.back().to_group = translate(0, 0, 1);
    scene.add(point_light({1, 1, 1}, 2));
    SpotLight spot;
    spot.from = {0, 1, 2};
    spot.to = {0, 0, 0};
    scene.add(Light{spot, {}, {}});
    DistantLight sun;
    sun.from = {0, 0, 1};
    sun.to = {0, 0, 0};
    scene.add(Light{sun, {}, {}});
    scene.add(sky(0.2f));
    World const world = compile(scene);
    Sent const sent = send(world, 0.5, samples(640000, 6400000));
    auto const all = agrees(sent.power, static_cast<double>(world.total_power()), 0.01, 0.001);
    CHECK_MESSAGE(all, all);
    // What reaches the floor is what a path tracer sees there: a white floor of radiance E / pi.
    look_parallel(scene, {0, 0, 0.01f}, {0, 0, -1}, 0.5f);
    World const seen = compile(scene);
    Means const m = measure(seen, settings(DirectIntegrator{1}), 256);
    auto const same = agrees(sent.landed, m[0][1].mean() * kPiD, 0.04, 0.001);
    CHECK_MESSAGE(same, same);
}
