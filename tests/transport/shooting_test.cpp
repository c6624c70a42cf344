// Shots of photons: power, counts, the law.
#include "photons.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstring>

using namespace nephroid;
using namespace nephroid::test;

namespace {

bool anything(Photon const&) { return true; }

/// A closed box with three lights of constant radiance in it.
Scene lit_box(float reflectance) {
    Scene s;
    add(s, box_mesh({-2, -2, -2}, {2, 2, 2}, true), diffuse(s, reflectance));
    s.add(point_light({0.5f, 0.3f, 1}, 1));
    add_sphere(s, {-1, 0, 0}, 0.2f, diffuse(s, reflectance)).light = white(2);
    add(s, Quad{{0.5f, -1, -1}, {0.7f, 0, 0}, {0, 0.4f, 0}}, diffuse(s, reflectance)).light = white(3, true);
    return s;
}
double const kBoxPower = 4 * kPiD + 2 * kPiD * 4 * kPiD * 0.04 + 3 * 2 * kPiD * 0.28;

/// Glass, a mirror, gloss, diffuse walls, lights that light them in every way.
Scene busy() {
    Scene s;
    add(s, box_mesh({-2, -2, -2}, {2, 2, 2}, true), diffuse(s, Vec3{0.7f, 0.5f, 0.3f}));
    add_sphere(s, {0, 0, -1}, 0.6f, filled(s, 1.5f, {0.1f, 0.4f, 0.8f}));
    add_sphere(s, {1, 1, -1}, 0.4f, mirror(s, 0.8f));
    ConductorMaterial rough;
    rough.reflectance = spectrum(s, ConstantSpd{0.9f});
    rough.roughness.u = s.add(Texture{ConstantFloatTexture{0.25f}, {}});
    rough.roughness.remap = false;
    add_sphere(s, {-1, 1, -1}, 0.4f, material(s, rough));
    s.add(point_light({0.5f, 0.3f, 1.5f}, 1));
    add(s, rectangle({-1, -1, 1.9f}, {-1, 1, 1.9f}, {0, 1, 1.9f}, {0, -1, 1.9f}), diffuse(s, 0.2f)).light =
        white(1);
    s.add(spot_light({0, 0, 1.5f}, {1, 1, -1}, 2, 20, 5));
    return s;
}
constexpr ShotKind kKinds[] = {ShotKind::Global, ShotKind::Others, ShotKind::Indirect, ShotKind::Caustic};

void check_counts(Shot const& shot, std::uint64_t paths) {
    PhotonCounts const all = total(shot);
    CHECK(all.emitted == paths);
    CHECK(all.stored == shot.photons.size());
    CHECK(all.further == shot.further.size());
    for (PhotonCounts const& c : shot.by_source)
        CHECK(c.emitted == c.escaped + c.absorbed + c.too_long + c.landed + c.elsewhere + c.dark + c.broken);
}

bool same_bits(std::vector<Photon> const& a, std::vector<Photon> const& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Photon)) == 0);
}

}  // namespace

TEST_CASE("shooting: a black box stores all of its lights' power, in rgb and at every wavelength") {
    World const world = compile(lit_box(0));
    for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
        Settings const s = shot_settings(10000, color);
        RenderJob const job(world, s);
        for (std::uint64_t pass : {std::uint64_t{0}, std::uint64_t{7}}) {
            Shot const shot = shot_of(world, s, ShotKind::Global, pass);
            CHECK(shot.photons.size() == 10000);
            check_counts(shot, 10000);
            Spectrum const white = world.assets().neutral_illuminant().sample(job.pass_wavelengths(pass));
            for (int lane = 0; lane < (color == ColorMode::Rgb ? 3 : 4); ++lane) {
                double const expected =
                    color == ColorMode::Rgb ? kBoxPower : kBoxPower * static_cast<double>(white[lane]);
                CHECK(sum_of(shot.photons, lane, anything) == doctest::Approx(expected).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("shooting: in a diffuse box, bounce b carries rho^b of the power") {
    constexpr double rho = 0.6;
    World const world = compile(lit_box(0.6f));
    for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
        Settings const s = shot_settings(samples(4000, 40000), color, true, 12);
        RenderJob const job(world, s);
        double const phi = kBoxPower * (color == ColorMode::Rgb
                                            ? 1.0
                                            : static_cast<double>(world.assets().neutral_illuminant().sample(
                                                  job.pass_wavelengths(0))[1]));
        std::array<Mean, 7> by_bounce;
        Mean all;
        for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
            Settings own = s;
            own.seed = 500 + batch;
            // The same wavelengths, or there would be different powers.
            RenderJob const here(world, own);
            double const scale = color == ColorMode::Rgb
                                     ? 1.0
                                     : phi / kBoxPower /
                                           static_cast<double>(world.assets().neutral_illuminant().sample(
                                               here.pass_wavelengths(0))[1]);
            Shot const shot = shot_of(world, own, ShotKind::Global);
            check_counts(shot, shot.paths);
            for (std::uint32_t b = 0; b < by_bounce.size(); ++b)
                by_bounce[b].add(scale *
                                 sum_of(shot.photons, 1, [&](Photon const& p) { return p.bounces() == b; }));
            all.add(scale * sum_of(shot.photons, 1, anything));
        }
        double const alpha = sidak(16);
        for (std::size_t b = 0; b < by_bounce.size(); ++b) {
            auto const a = agrees(by_bounce[b], phi * std::pow(rho, static_cast<double>(b)), 0.05, alpha);
            CHECK_MESSAGE(a, "bounce ", b, ": ", a);
        }
        auto const a = agrees(all, phi * (1 - std::pow(rho, 13)) / (1 - rho), 0.01, alpha);
        CHECK_MESSAGE(a, a);
    }
}

TEST_CASE("shooting: photons of untinted surfaces weigh the same, whatever they went through") {
    Scene scene = lit_box(0.5f);
    add_sphere(scene, {0, 0, 0}, 0.4f, glass(scene));
    add_sphere(scene, {1, 1, 1}, 0.4f, mirror(scene, 0.7f));
    World const world = compile(scene);
    Shot const shot = shot_of(world, shot_settings(20000), ShotKind::Global);
    double least = 1e30, most = 0;
    for (Photon const& p : shot.photons) {
        least = std::min(least, carried(p, 1));
        most = std::max(most, carried(p, 1));
    }
    CHECK(most / least < 1.001);
    // A prism throws three of four wavelengths away; the fourth then stands for all.
    Scene prism = lit_box(0.5f);
    add_sphere(prism, {0, 0, 0}, 0.4f, glass(prism, TabulatedSpd{{400, 700}, {1.54f, 1.5f}}));
    // Tinted: what it swallows, roulette makes up for.
    auto const number = [&](float x) { return prism.add(Texture{ConstantFloatTexture{x}, {}}); };
    MetallicRoughnessMaterial dark;
    dark.base_color = spectrum(prism, ConstantSpd{0.2f});
    dark.metallic = number(0);
    dark.roughness = number(0);
    dark.transmission.factor = number(1);
    dark.transmission.thin = false;
    dark.index.dispersion = 1;
    add_sphere(prism, {1, 1, 1}, 0.6f, material(prism, dark));
    World const spectral = compile(prism);
    Shot const colours = shot_of(spectral, shot_settings(20000, ColorMode::Spectral), ShotKind::Global);
    least = 1e30, most = 0;
    std::size_t heroes = 0;
    for (Photon const& p : colours.photons) {
        heroes += p.hero_only() ? 1 : 0;
        double const w = p.hero_only() ? static_cast<double>(p.power()[0]) / 4 : carried(p, 0);
        least = std::min(least, w);
        most = std::max(most, w);
    }
    CHECK(heroes > 500);
    CHECK(most / least < 1.6);  // white light is not quite the same at all four
}

TEST_CASE("shooting: the same photons on any number of threads, and path by path") {
    // More than there are processors.
    tbb::global_control const allowed(tbb::global_control::max_allowed_parallelism, 7);
    World const world = compile(busy());
    for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral})
        for (bool const aim : {true, false})
            for (ShotKind const kind : kKinds) {
                Settings const s = shot_settings(9001, color, aim);
                Shot const one = tbb::task_arena(1).execute([&] { return shot_of(world, s, kind, 3); });
                CHECK(one.photons.size() > 200);
                CHECK((one.further.size() > 200) == (kind == ShotKind::Caustic));
                check_counts(one, 9001);
                for (int threads : {2, 7}) {
                    Shot const more =
                        tbb::task_arena(threads).execute([&] { return shot_of(world, s, kind, 3); });
                    CHECK(same_bits(one.photons, more.photons));
                    CHECK(same_bits(one.further, more.further));
                    CHECK(more.rays.rays == one.rays.rays);
                    for (std::size_t i = 0; i < one.by_source.size(); ++i)
                        CHECK(std::memcmp(&one.by_source[i], &more.by_source[i], sizeof(PhotonCounts)) == 0);
                }
                RenderJob const job(world, s);
                std::vector<Photon> replayed;
                std::vector<Photon> replayed_further;
                bool connected = true;
                for (std::uint64_t i = 0; i < 9001; ++i) {
                    TracedPath const path = trace_light_path(job, kind, 3, i, 9001);
                    auto const add = [&](std::vector<PhotonRecord> const& records, std::vector<Photon>& to) {
                        for (PhotonRecord const& r : records) {
                            to.emplace_back(r);
                            connected = connected && r.bounces + 1 < path.vertices.size() &&
                                        path.vertices[r.bounces + 1] == r.p && r.light == path.light;
                        }
                    };
                    add(path.photons, replayed);
                    add(path.further, replayed_further);
                }
                CHECK(same_bits(one.photons, replayed));
                CHECK(same_bits(one.further, replayed_further));
                CHECK(connected);
                CHECK(one.rays.rays[static_cast<std::size_t>(RayKind::Camera)] <= 1);
            }
    // Passes differ.
    Settings const s = shot_settings(1000);
    CHECK(!same_bits(shot_of(world, s, ShotKind::Global, 0).photons,
                     shot_of(world, s, ShotKind::Global, 1).photons));
}

TEST_CASE("shooting: without a caustic map, its paths are in the other") {
    World const world = compile(busy());
    Settings without = shot_settings(20000, ColorMode::Rgb, false);
    Shot const global = shot_of(world, without, ShotKind::Global);
    std::get<SppmIntegrator>(without.integrator).shooting.caustic_paths = 0;
    CHECK(same_bits(shot_of(world, without, ShotKind::Others).photons, global.photons));
    auto const indirect = [](Photon const& p) { return p.bounces() > 0; };
    Shot const read_directly = shot_of(world, without, ShotKind::Indirect);
    CHECK(sum_of(read_directly.photons, 1, anything) ==
          doctest::Approx(sum_of(global.photons, 1, indirect)).epsilon(1e-6));
    CHECK(total(read_directly).elsewhere == 0);
}

TEST_CASE("shooting: a light that shines into the void changes nothing but how many photons there are") {
    auto const on_floor = [](Photon const& p) { return length(p.p()) < 1.0f; };
    Scene scene;
    add(scene, floor_quad(2), diffuse(scene, 0.5f));
    add_sphere(scene, {0.2f, 0, 1}, 0.3f, glass(scene));
    scene.add(point_light({0, 0, 2}, 1));
    Scene more = scene;
    more.add(spot_light({0, 0, 5}, {0, 0, 9}, 30, 40, 10));
    World const one = compile(scene), two = compile(more);
    for (ShotKind const kind : {ShotKind::Global, ShotKind::Caustic}) {
        Settings const s = shot_settings(samples(12000, 120000));
        Mean const a = batches_of(one, s, kind, on_floor), b = batches_of(two, s, kind, on_floor);
        double const error = std::hypot(a.standard_error(), b.standard_error());
        CHECK(error < 0.015 * kSanitizerRoom * a.mean());
        CHECK_MESSAGE(student_p((a.mean() - b.mean()) / error, 40) > sidak(2), a.mean(), " ", b.mean(),
                      " +- ", error);
    }
    Shot const shot = shot_of(two, shot_settings(20000), ShotKind::Global);
    CHECK(shot.by_source[1].emitted > 5000);
    CHECK(shot.by_source[1].escaped == shot.by_source[1].emitted);
}

TEST_CASE("shooting: a scene of another size has the same photons") {
    auto const sized = [](float size) {
        Scene s;
        add(s, box_mesh(Vec3{-2, -2, -2} * size, Vec3{2, 2, 2} * size, true),
            diffuse(s, Vec3{0.7f, 0.5f, 0.3f}));
        add_sphere(s, Vec3{0, 0.3f, -1} * size, 0.6f * size, glass(s));
        add_sphere(s, Vec3{1, 1, -1} * size, 0.4f * size, mirror(s, 0.8f));
        s.add(point_light(Vec3{0.5f, 0.3f, 1.5f} * size, size * size));
        add(s, Quad{Vec3{-1, -1, 1.9f} * size, {0, 1.5f * size, 0}, {size, 0, 0}}, diffuse(s, 0.2f)).light =
            white(1);
        s.add(spot_light(Vec3{0, 0, 1.5f} * size, Vec3{1, 1, -1} * size, 2 * size * size, 20, 5));
        return compile(std::move(s));
    };
    World const unit = sized(1);
    for (float const size : {0x1p-13f, 0x1p20f}) {
        World const world = sized(size);
        for (ShotKind const kind : {ShotKind::Global, ShotKind::Caustic}) {
            Shot const a = shot_of(unit, shot_settings(5000), kind);
            Shot const b = shot_of(world, shot_settings(5000), kind);
            REQUIRE(a.photons.size() == b.photons.size());
            bool same = true;
            for (std::size_t i = 0; i < a.photons.size(); ++i)
                same = same && a.photons[i].p() * size == b.photons[i].p() &&
                       a.photons[i].power()[1] * (size * size) == b.photons[i].power()[1] &&
                       a.photons[i].wi() == b.photons[i].wi();
            CHECK(same);
        }
    }
}

TEST_CASE("shooting: one emitter is one source, however many triangles and appearances it has") {
    Scene scene;
    Group lamp;
    TriangleMesh const mesh = box_mesh({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, false);
    add(lamp, mesh).light = white(1);
    lamp.objects.back().light->where = {0, 7};
    GroupId const id = scene.add(lamp);
    for (float x : {-1.0f, 1.0f}) scene.world().instances.push_back({id, rows_of(translate(x, 0, 0)), {}});
    add(scene, box_mesh({-2, -2, -2}, {2, 2, 2}, true), diffuse(scene, 0));
    add_sphere(scene, {0, 0, 1}, 0.1f).light = white(1);
    scene.add(point_light({0, 1, 0}, 0.1f));
    World const world = compile(scene);
    auto const sources = world.light_sources();
    REQUIRE(sources.size() == 3);
    Shot const shot = shot_of(world, shot_settings(20000), ShotKind::Global);
    REQUIRE(shot.by_source.size() == 3);
    double const powers[] = {2 * 0.24 * kPiD, 0.04 * kPiD * kPiD, 0.4 * kPiD};
    double sum = 0;
    for (double const p : powers) sum += p;
    std::array<double, 3> expected{}, counted{};
    for (std::uint32_t i = 0; i < 3; ++i) {
        bool const is_point = std::string(sources[i].kind) == "point";
        // Groups' order is the world's; the lamp is the one with a line.
        std::size_t const which = is_point ? 2 : sources[i].where.line == 7 ? 0 : 1;
        expected[i] = 20000 * powers[which] / sum;
        counted[i] = static_cast<double>(shot.by_source[i].emitted);
        CHECK(counted[i] == doctest::Approx(expected[i]).epsilon(0.02));
    }
    check_counts(shot, 20000);
}

TEST_CASE("shooting: stops soon when told to, and says how far it is") {
    World const world = compile(busy());
    RenderJob const job(world, shot_settings(1000));
    std::atomic<bool> stop = true;
    PrepareControl control;
    control.stop = &stop;
    CHECK(!shoot(job, ShotKind::Global, 0, 100000000, control));
    stop = false;
    double last = 0;
    int calls = 0;
    control.on_progress = [&](double share) {
        CHECK(share > last);
        last = share;
        if (++calls == 3) stop = true;
    };
    CHECK(!shoot(job, ShotKind::Global, 0, 100000000, control));
    CHECK(calls < 20);
    stop = false, last = 0, calls = -1000;
    CHECK(shoot(job, ShotKind::Global, 0, 20000, control).has_value());
    CHECK(last == 1.0);
}

TEST_CASE("shooting: corners") {
    SUBCASE("no lights") {
        Scene s;
        add(s, floor_quad(1), glass(s));
        Shot const shot = shot_of(compile(s), shot_settings(100), ShotKind::Global);
        CHECK(shot.photons.empty());
        CHECK(shot.by_source.empty());
    }
    SUBCASE("no surfaces at all") {
        Scene s;
        s.add(point_light({0, 0, 0}, 1));
        s.add(sky());
        s.add(distant({0, 0, 1}));
        World const world = compile(s);
        for (ShotKind const kind : kKinds) {
            Shot const shot = shot_of(world, shot_settings(5000), kind);
            CHECK(shot.photons.empty());
            check_counts(shot, 5000);
            PhotonCounts const all = total(shot);
            CHECK(all.escaped + all.dark == 5000);
        }
    }
    SUBCASE("no diffuse surface") {
        Scene s;
        add_sphere(s, {0, 0, 0}, 1, glass(s));
        add(s, box_mesh({-2, -2, -2}, {2, 2, 2}, true), mirror(s, 1));
        s.add(point_light({0, 0, 1.5f}, 1));
        for (ShotKind const kind : kKinds) {
            Shot const shot = shot_of(compile(s), shot_settings(5000), kind);
            CHECK(shot.photons.empty());
            check_counts(shot, 5000);
            // A mirror of a metal keeps a little. Those that are not the caustic shot's have nothing to follow.
            bool const follows = kind == ShotKind::Global || kind == ShotKind::Caustic;
            CHECK((follows ? total(shot).too_long : total(shot).elsewhere) > 4900);
            CHECK(total(shot).too_long + total(shot).elsewhere + total(shot).absorbed == 5000);
        }
    }
    SUBCASE("lights of no power") {
        Scene s;
        add(s, floor_quad(1), diffuse(s, 0.5f));
        add_sphere(s, {0, 0, 1}, 0.3f, glass(s));
        s.add(point_light({0, 0, 2}, 0));
        add_sphere(s, {0, 0, 3}, 0.3f).light = white(0);
        for (ShotKind const kind : kKinds) {
            Shot const shot = shot_of(compile(s), shot_settings(100), kind);
            CHECK(shot.photons.empty());
            CHECK(shot.by_source.size() == 2);
            CHECK(total(shot).emitted == 0);
        }
    }
    SUBCASE("no paths, no bounces") {
        World const world = compile(busy());
        CHECK(shot_of(world, shot_settings(0), ShotKind::Global).photons.empty());
        Shot const shot = shot_of(world, shot_settings(1000, ColorMode::Rgb, true, 0), ShotKind::Global);
        CHECK(!shot.photons.empty());
        for (Photon const& p : shot.photons) CHECK(p.bounces() == 0);
        check_counts(shot, 1000);
        TracedPath const nothing =
            trace_light_path(RenderJob(world, shot_settings(0)), ShotKind::Global, 0, 0, 0);
        CHECK(nothing.vertices.empty());
    }
    SUBCASE("light that leaves ends at the bounds") {
        Scene s;
        add(s, Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, diffuse(s, 0.5f));
        s.add(point_light({0, 0, 1}, 1));
        World const world = compile(s);
        RenderJob const job(world, shot_settings(100));
        for (std::uint64_t i = 0; i < 100; ++i) {
            TracedPath const p = trace_light_path(job, ShotKind::Global, 0, i, 100);
            CHECK(p.vertices.size() >= 2);
            for (Vec3 const v : p.vertices) CHECK(length(v) < 10.0f);
        }
    }
    SUBCASE("a hundred thousand lights") {
        Scene s;
        add(s, floor_quad(100), diffuse(s, 0.5f));
        for (int i = 0; i < 50; ++i) add_sphere(s, {static_cast<float>(i), 0, 0.5f}, 0.3f, glass(s));
        for (int i = 0; i < 100000; ++i)
            s.add(point_light({static_cast<float>(i % 300) - 150.0f, static_cast<float>(i / 300) - 150.0f, 2},
                              1));
        World const world = compile(s);
        auto const begun = std::chrono::steady_clock::now();
        RenderJob const job(world, shot_settings(20000));
        std::chrono::duration<double> const took = std::chrono::steady_clock::now() - begun;
        MESSAGE("aim of 1e5 lights at 50 balls: ", took.count(), " s");
        for (ShotKind const kind : {ShotKind::Global, ShotKind::Caustic}) {
            auto const shot = shoot(job, kind, 0, 20000, {});
            check_counts(*shot, 20000);
            CHECK(shot->by_source.size() == 100000);
            CHECK(shot->photons.size() > 200);
        }
    }
}
