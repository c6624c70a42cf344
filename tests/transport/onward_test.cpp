// Paths are divided by what scatters them first, and caustic paths go on where they have landed.
#include "photon_classes.h"
#include "photon_plan.h"
#include "photons.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstring>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Glass, a mirror and varnish among diffuse walls: paths begin in every way, and varnish scatters in two.
Scene mixed() {
    Scene s;
    add(s, box_mesh({-2, -2, -2}, {2, 2, 2}, true), diffuse(s, Vec3{0.7f, 0.5f, 0.3f}));
    add_sphere(s, {0, 0, -1}, 0.6f, glass(s));
    add_sphere(s, {1, 1, -1}, 0.4f, mirror(s, 0.8f));
    add_sphere(s, {-1, 1, -1}, 0.4f, material(s, CoatedDiffuseMaterial{spectrum(s, ConstantSpd{0.5f}), {}}));
    s.add(point_light({0.5f, 0.3f, 1.5f}, 1));
    add(s, rectangle({-1, -1, 1.9f}, {-1, 1, 1.9f}, {0, 1, 1.9f}, {0, -1, 1.9f}), diffuse(s, 0.2f)).light =
        white(1);
    return s;
}

/// A white box under a pane of glass, in the light of an even sky, and a grey ball far away: the sky's rays begin on a disk that is
/// wider by far than the box.
Scene box_under_glass(float ball_at) {
    Scene s;
    MaterialId const grey = diffuse(s, 0.7f);
    add(s, rectangle({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}), grey);
    for (auto const& [a, b] : {std::pair{Vec3{0, 0, 0}, Vec3{1, 0, 0}},
                               {Vec3{1, 0, 0}, Vec3{1, 1, 0}},
                               {Vec3{1, 1, 0}, Vec3{0, 1, 0}},
                               {Vec3{0, 1, 0}, Vec3{0, 0, 0}}}) {
        Vec3 const up{0, 0, 1};
        add(s, rectangle(a, b, b + up, a + up), grey);
    }
    add(s, box_mesh({0, 0, 1}, {1, 1, 1.05f}, false), glass(s));
    add_sphere(s, {ball_at, 0, 0}, 0.1f, grey);
    s.add(sky());
    look(s, {0.5f, 0.35f, 0.9f}, {0.5f, 0.7f, 0.3f});
    s.camera.kind = PerspectiveCamera{1.2f, 0, 1e6f};
    return s;
}

float onward_of(World const& world, Settings const& s) { return RenderJob(world, s).photon_plan()->onward; }

bool same(PhotonRecord const& a, PhotonRecord const& b) {
    Photon const x(a), y(b);
    return std::memcmp(&x, &y, sizeof x) == 0;
}

}  // namespace

TEST_CASE("onward: paths that are not the caustic shot's end where they would begin as its") {
    World const world = compile(mixed());
    Settings const s = shot_settings(4000);
    RenderJob const job(world, s);
    int ended = 0;
    int not_ended = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        TracedPath const whole = trace_light_path(job, ShotKind::Global, 1, i, 4000);
        TracedPath const part = trace_light_path(job, ShotKind::Others, 1, i, 4000);
        bool const ends = part.end == &PhotonCounts::elsewhere;
        (ends ? ended : not_ended) += 1;
        REQUIRE(part.photons.size() <= whole.photons.size());
        if (ends)
            CHECK(part.vertices.size() == 2);
        else
            CHECK(part.photons.size() == whole.photons.size());
        for (std::size_t k = 0; k < part.photons.size(); ++k) {
            CHECK(same(part.photons[k], whole.photons[k]));
            CHECK_FALSE(part.photons[k].caustic);
        }
    }
    CHECK(ended > 100);
    CHECK(not_ended > 300);
}

TEST_CASE("onward: both shots together leave the indirect light of paths that are not divided") {
    World const world = compile(mixed());
    auto const low = [](Photon const& p) { return p.bounces() > 0 && !p.caustic() && p.p().z < -0.5f; };
    auto const all = [](Photon const& p) { return p.bounces() > 0 && !p.caustic(); };
    double const alpha = sidak(8);
    for (bool const aim : {true, false})
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
            Settings s = shot_settings(samples(5000, 100000), color, aim);
            CAPTURE(aim);
            CAPTURE(onward_of(world, s));
            if (aim) CHECK(onward_of(world, s) < 0.5f);
            for (Which const& which : {Which(low), Which(all)}) {
                Mean difference;
                Mean undivided;
                for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
                    s.seed = 1000 + batch;
                    double const whole = sum_of(shot_of(world, s, ShotKind::Global).photons, 1, which);
                    undivided.add(whole);
                    difference.add(sum_of(shot_of(world, s, ShotKind::Indirect).photons, 1, which) +
                                   sum_of(shot_of(world, s, ShotKind::Caustic).further, 1, which) - whole);
                }
                auto const a = agrees(difference, 0, 0.01, alpha, undivided.mean());
                CHECK_MESSAGE(a, a);
            }
        }
}

TEST_CASE("onward: the share that goes on is a function of the job, and what is worth its time") {
    auto const of = [](World const& world, int paths, int caustic_paths) {
        Settings s = settings(shooting(paths), 64, 64);
        std::get<SppmIntegrator>(s.integrator).shooting.caustic_paths = caustic_paths;
        return onward_of(world, s);
    };
    World const far = compile(box_under_glass(200));
    CHECK(of(far, 20000, 0) == 0.0f);
    // Who asks for caustics alone gets no other light.
    CHECK(of(far, 0, 20000) == 0.0f);
    // Hardly any path finds the box that is not sent there: all that are sent go on.
    CHECK(of(far, 20000, 20000) == 1.0f);
    // A small ball of glass in a closed room, and as many paths towards it as in all.
    Scene room;
    add(room, box_mesh({-2, -2, -2}, {2, 2, 2}, true), diffuse(room, 0.5f));
    add_sphere(room, {0, 0, -1}, 0.2f, glass(room));
    room.add(point_light({0, 0, 1.5f}, 1));
    World const small = compile(std::move(room));
    tbb::global_control const allowed(tbb::global_control::max_allowed_parallelism, 7);
    float const one = tbb::task_arena(1).execute([&] { return of(small, 20000, 20000); });
    float const seven = tbb::task_arena(7).execute([&] { return of(small, 20000, 20000); });
    CHECK(one == seven);
    CHECK(one > 0.01f);
    CHECK(one < 0.3f);
    // A thousandth of them weighs as much as others, or more.
    CHECK(of(small, 20000, 20) == 1.0f);
}

TEST_CASE("onward: who looks at caustics sees caustics alone, from a map of their own or out of the other") {
    Scene s = mixed();
    look(s, {0, -1.9f, 0.3f}, {0, 1, -0.6f});
    World const world = compile(std::move(s));
    auto const mean_of = [&](PhotonView view, int caustic_paths, bool gathers) {
        PhotonMapIntegrator p = photon_map(4000, gathers, 0.3f, 0.3f);
        p.estimates.nused = 0;
        p.shooting.caustic_paths = caustic_paths;
        p.visualize = view;
        RenderJob const job(world, settings(p, 8, 8));
        bool const alone = view == PhotonView::Caustic && caustic_paths > 0;
        CHECK((job.photon_plan()->onward > 0.0f) == (caustic_paths > 0 && !alone));
        CHECK(job.photon_plan()->caustics_in_global == !alone);
        return film_means(world, settings(p, 8, 8), 4, 11).beauty[1];
    };
    auto const equal = [](Mean const& a, Mean const& b) {
        return std::abs(a.mean() - b.mean()) < a.half_width(1e-4) + b.half_width(1e-4);
    };
    for (bool const gathers : {true, false}) {
        Mean const own = mean_of(PhotonView::Caustic, 4000, gathers);
        CHECK(own.mean() > 0);
        CHECK(equal(own, mean_of(PhotonView::Caustic, 0, gathers)));
        // All light, divided or not.
        Mean const divided = mean_of(PhotonView::Global, 4000, gathers);
        CHECK(divided.mean() > 2 * own.mean());
        CHECK(equal(divided, mean_of(PhotonView::Global, 0, gathers)));
    }
}

TEST_CASE("onward: a box under glass is as bright, however wide its sky") {
    PathIntegrator path;
    path.max_depth = 12;
    double const expected = [&] {
        Settings s = settings(path, 8, 6);
        s.spp = samples(4096, 16384);
        World const near = compile(box_under_glass(1.3f));
        return film_means(near, s, static_cast<std::uint64_t>(samples(128, 512)), 3).beauty[1].mean();
    }();
    for (Integrator const& integrator :
         {Integrator{progressive(12, 2000)}, Integrator{photon_map(2000, true, 0, 0)}}) {
        CAPTURE(integrator.index());
        double const found =
            film_means(compile(box_under_glass(200)), settings(integrator, 8, 6), 4, 7).beauty[1].mean();
        CHECK(found == doctest::Approx(expected).epsilon(0.03));
    }
}
