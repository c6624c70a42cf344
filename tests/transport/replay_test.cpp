// A replayed path is the one that was rendered: its value has the bits that the film got, and its parts add up to it.
#include "transport/replay.h"
#include "measure.h"
#include "scenes.h"
#include "transport/render_pass.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>
#include <tuple>

namespace nephroid::test {
namespace {

/// A room of quads with a lamp that is a surface, a point light, a glass ball, a mirror and a glossy floor.
Scene room_of_everything(bool sky) {
    Scene s;
    MaterialId const white = diffuse(s, Vec3{0.8f, 0.7f, 0.6f});
    MaterialId const red = diffuse(s, Vec3{0.8f, 0.1f, 0.1f});
    ConductorMaterial rough;
    rough.reflectance = spectrum(s, RgbAlbedoSpd{{0.9f, 0.8f, 0.5f}});
    rough.roughness.u = s.add(Texture{ConstantFloatTexture{0.2f}, {}});
    MaterialId const glossy = material(s, rough);
    add(s, floor_quad(4), glossy);
    add(s, Quad{{-4, 4, 0}, {8, 0, 0}, {0, 0, 5}}, white);
    add(s, Quad{{-4, -4, 0}, {0, 8, 0}, {0, 0, 5}}, red);
    add(s, Sphere{1}, glass(s, NamedSpd{"glass-BK7"})).to_group = translate(-1.2, 0, 1);
    add(s, Sphere{0.8f}, mirror(s, 0.9f)).to_group = translate(1.2, 0.5, 0.8);
    add(s, Quad{{-1, -1, 4.5f}, {0, 2, 0}, {2, 0, 0}}, white).light = nephroid::test::white(10);
    s.lights.push_back(point_light({2, -3, 4}, 20));
    if (sky) s.lights.push_back(nephroid::test::sky(0.3f));
    look(s, {0, -7, 2.5f}, {0, 0, 1.2f});
    return s;
}

/// A glass of absorbing liquid and a mix with an interface: paths that end in bodies and pass surfaces.
Scene bodies() {
    Scene s;
    DielectricMaterial wine;
    wine.interior.absorption = RgbUnboundedSpd{{0.1f, 0.9f, 1.2f}};
    wine.interior.priority = 1;
    MaterialId const white = diffuse(s, 0.7f);
    MaterialId const open = material(s, InterfaceMaterial{});
    MaterialId const half =
        material(s, MixMaterial{white, open, s.add(Texture{ConstantFloatTexture{0.5f}, {}})});
    add(s, floor_quad(6), white);
    add(s, Sphere{1}, material(s, wine)).to_group = translate(0, 0, 1);
    add(s, Sphere{1.3f}, half).to_group = translate(0, 0, 1.2);
    s.lights.push_back(sky(0.5f));
    add(s, Disk{5, 1.5f}, {}).light = nephroid::test::white(5, true);
    look(s, {0, -6, 2}, {0, 0, 1});
    return s;
}

bool same_bits(Vec3 a, Vec3 b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(Spectrum a, Spectrum b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Kind {
    char const* name;
    Integrator integrator;
    bool one_path;  // contributions come in the order in which the integrator adds them
};
std::vector<Kind> kinds() {
    PathIntegrator no_lights{.max_depth = 6};
    no_lights.sample_lights = false;
    PathIntegrator no_mis{.max_depth = 6};
    no_mis.sample_bsdf_mis = false;
    return {{"path", PathIntegrator{.max_depth = 8}, true},
            {"path without lights", no_lights, true},
            {"path without MIS", no_mis, true},
            {"direct", DirectIntegrator{}, true},
            {"whitted", WhittedIntegrator{.max_depth = 5}, false}};
}

}  // namespace

TEST_CASE("a replayed path is what the film got, to the bit") {
    for (auto const& [name, make] : {std::pair{"room", +[] { return room_of_everything(false); }},
                                     {"room under a sky", +[] { return room_of_everything(true); }},
                                     {"bodies", +[] { return bodies(); }}})
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral})
            for (Kind const& kind : kinds()) {
                char const* const scene_name = name;  // clang 14 captures no structured bindings
                CAPTURE(scene_name);
                CAPTURE(kind.name);
                World const world = compile(make());
                Settings settings;
                settings.color = color;
                settings.film.resolution = {16, 12};
                settings.filter = MitchellFilter{};
                settings.integrator = kind.integrator;
                settings.seed = 5;
                RenderJob const job(world, settings);
                int wrong = 0, unsummed = 0, other = 0, lit = 0, met = 0;
                for (std::uint64_t const pass :
                     {std::uint64_t{0}, std::uint64_t{7}, std::uint64_t{1} << 40}) {
                    Film film = job.make_film();
                    RayStats stats;
                    render_pass(job, pass, film, stats);
                    for (int y = 0; y < 12; ++y)
                        for (int x = 0; x < 16; ++x) {
                            PathRecord const r = replay(job, pass, {x, y});
                            PixelSums const& sums = film.pixel(x, y);
                            double const w = static_cast<double>(r.weight);
                            bool same = sums.weight == w && sums.samples == 1;
                            for (int c = 0; c < 3; ++c)
                                same =
                                    same &&
                                    std::bit_cast<std::uint64_t>(0.0 + w * static_cast<double>(r.value[c])) ==
                                        std::bit_cast<std::uint64_t>(sums.rgb[static_cast<std::size_t>(c)]);
                            wrong += !same;
                            // The parts are the whole.
                            Spectrum const whole = r.seen.total(), parts = r.sum.total();
                            if (kind.one_path)
                                unsummed += !same_bits(whole, parts);
                            else
                                unsummed += !((whole - parts).max() <= 1e-5f * whole.max() &&
                                              (parts - whole).max() <= 1e-5f * whole.max());
                            Spectrum listed;
                            Vec3 rgb{0, 0, 0};
                            for (LightTried const& t : r.tried) listed += t.contribution, rgb += t.rgb, ++lit;
                            for (LightMet const& m : r.met) listed += m.contribution, rgb += m.rgb, ++met;
                            unsummed +=
                                std::abs(listed.average() - whole.average()) > 1e-5f * whole.average();
                            unsummed +=
                                max_component(abs(rgb - r.value)) > 1e-4f * max_component(abs(r.value));
                            // Once more.
                            PathRecord const again = replay(job, pass, {x, y});
                            bool twice =
                                again.vertices.size() == r.vertices.size() && same_bits(again.value, r.value);
                            for (std::size_t i = 0; twice && i < r.vertices.size(); ++i)
                                twice = same_bits(again.vertices[i].beta, r.vertices[i].beta) &&
                                        (!r.vertices[i].surface ||
                                         same_bits(again.vertices[i].p, r.vertices[i].p));
                            other += !twice;
                        }
                }
                CHECK(wrong == 0);
                CHECK(unsummed == 0);
                CHECK(other == 0);
                CHECK(met > 0);
                auto const* p = std::get_if<PathIntegrator>(&kind.integrator);
                if (p && !p->sample_lights)
                    CHECK(lit == 0);
                else
                    CHECK(lit > 100);
            }
}

TEST_CASE("the vertices of a replayed path hang together") {
    World const world = compile(room_of_everything(false));
    Settings settings;
    settings.color = ColorMode::Rgb;
    settings.film.resolution = {40, 30};
    settings.integrator = PathIntegrator{.max_depth = 10};
    RenderJob const job(world, settings);
    int vertices = 0, specular = 0, transmitted = 0, glossy = 0, diffuse_ones = 0, occluded = 0;
    std::array<int, 7> ends{};
    for (int k = 0; k < 4 * 30; ++k)
        for (int x = 0; x < 40; ++x) {
            PathRecord const r = replay(job, static_cast<std::uint64_t>(k / 30), {x, k % 30});
            REQUIRE(!r.vertices.empty());
            Vec3 before = r.ray.o;
            for (std::size_t i = 0; i < r.vertices.size(); ++i) {
                PathVertex const& v = r.vertices[i];
                ++vertices;
                CHECK(v.id == i);
                CHECK(v.parent == static_cast<int>(i) - 1);
                ++ends[static_cast<std::size_t>(v.end)];
                CHECK((v.end == PathEnd::GoesOn) == (i + 1 < r.vertices.size()));
                if (!v.surface) continue;
                CHECK(length(v.p - (before + v.direction * v.distance)) < 1e-3f);
                CHECK(std::abs(length(v.ng) - 1) < 1e-4f);
                if (v.end == PathEnd::GoesOn) {
                    REQUIRE(v.scatterings.size() == 1);
                    Scattering const& s = v.scatterings[0];
                    CHECK(same_bits(r.vertices[i + 1].direction, s.wi));
                    // Nothing absorbs on the way here.
                    CHECK(same_bits(r.vertices[i + 1].beta, s.beta));
                    CHECK((dot(s.wi, v.ng) * dot(v.direction, v.ng) > 0) == s.transmitted);
                    CHECK(s.survived);
                    CHECK((s.survival > 0 && s.survival <= 1));
                    CHECK(s.pdf > 0);
                    specular += s.kind == ScatterKind::Specular;
                    glossy += s.kind == ScatterKind::Glossy;
                    diffuse_ones += s.kind == ScatterKind::Diffuse;
                    transmitted += s.transmitted;
                    // The pdf of a Lambertian surface, and what that makes of beta.
                    if (s.kind == ScatterKind::Diffuse)
                        CHECK(s.pdf == doctest::Approx(std::abs(dot(s.wi, v.ns)) / kPi).epsilon(1e-3));
                }
                before = v.p;
            }
            for (LightTried const& t : r.tried) {
                REQUIRE(t.vertex < r.vertices.size());
                PathVertex const& v = r.vertices[t.vertex];
                CHECK_FALSE(v.specular);
                CHECK(length(normalize(t.p - v.p) - t.wi) < 1e-3f);
                occluded += t.passing == 0;
                // What the record calls occluded is: nothing else was asked.
                SurfaceHit hit;
                RayStats stats;
                bool const blocked = world.intersect({v.p + t.wi * 1e-3f, t.wi}, length(t.p - v.p) - 2e-3f,
                                                     RayKind::Shadow, stats, hit);
                CHECK(blocked == (t.passing == 0));
                CHECK((t.weight > 0) == (t.passing > 0));
                if (t.delta) CHECK((t.passing == 0 || t.weight == 1));
            }
        }
    CHECK(vertices > 3000);
    CHECK(specular > 300);
    CHECK(transmitted > 200);
    CHECK(glossy > 100);
    CHECK(diffuse_ones > 300);
    CHECK(occluded > 50);
    for (PathEnd const end : {PathEnd::GoesOn, PathEnd::LeftScene, PathEnd::Roulette, PathEnd::Length})
        CHECK(ends[static_cast<std::size_t>(end)] > 0);
}

namespace {

/// Each vertex was reached by what its parent scattered, in that order, and has numbers of its own. The vertices with two children.
int check_tree(PathRecord const& r) {
    std::vector<std::size_t> children(r.vertices.size());
    std::set<std::uint32_t> numbers;
    for (std::size_t i = 0; i < r.vertices.size(); ++i) {
        PathVertex const& v = r.vertices[i];
        CHECK(numbers.insert(v.id).second);
        CHECK((v.id == 0) == (i == 0));
        if (i == 0) continue;
        REQUIRE(v.parent >= 0);
        auto const parent = static_cast<std::size_t>(v.parent);
        REQUIRE(parent < i);
        PathVertex const& from = r.vertices[parent];
        REQUIRE(children[parent] < from.scatterings.size());
        CHECK(same_bits(from.scatterings[children[parent]++].wi, v.direction));
        if (v.surface) CHECK(v.distance == doctest::Approx(double{length(v.p - from.p)}));
    }
    return static_cast<int>(std::count(children.begin(), children.end(), 2));
}

RenderJob deep_job(World const& world, int depth) {
    Settings settings;
    settings.color = ColorMode::Rgb;
    settings.film.resolution = {8, 6};
    settings.integrator = WhittedIntegrator{.max_depth = depth};
    return {world, settings};
}

}  // namespace

TEST_CASE("between two mirrors, however deep, each vertex comes from the one before") {
    Scene s;
    MaterialId const glass = mirror(s, 1);
    add(s, Quad{{-500, 1, -500}, {1000, 0, 0}, {0, 0, 1000}}, glass);
    add(s, Quad{{-500, -1, -500}, {1000, 0, 0}, {0, 0, 1000}}, glass);
    look(s, {0, 0, 0}, {0, 1, 0});
    World const world = compile(std::move(s));
    RenderJob const job = deep_job(world, 60);
    for (int x = 0; x < 8; ++x) {
        PathRecord const r = replay(job, 0, {x, 3});
        REQUIRE(r.vertices.size() == 61);
        for (std::size_t i = 0; i < r.vertices.size(); ++i) {
            CHECK(r.vertices[i].parent == static_cast<int>(i) - 1);
            // Down to where a heap's numbers end, those of a heap.
            if (i > 0 && i < 28) CHECK(r.vertices[i].id == 1u << i);
        }
        CHECK(check_tree(r) == 0);
    }
}

TEST_CASE("a deep tree's branches come from where they branched") {
    // A ball that mirrors most of what is in it: the tree is one chain inside, which lets some out at each vertex.
    Scene s;
    add(s, Sphere{1}, nephroid::test::glass(s, ConstantSpd{10}));
    s.lights.push_back(sky(1));
    look(s, {0, -4, 0}, {0, 0, 0});
    World const world = compile(std::move(s));
    RenderJob const job = deep_job(world, 60);
    PathRecord const r = replay(job, 0, {4, 3});
    REQUIRE(r.vertices.size() > 100);
    CHECK(check_tree(r) == 60);
}

TEST_CASE("Whitted's tree is replayed as a tree") {
    World const world = compile(room_of_everything(false));
    Settings settings;
    settings.color = ColorMode::Rgb;
    settings.film.resolution = {40, 30};
    settings.integrator = WhittedIntegrator{.max_depth = 4};
    RenderJob const job(world, settings);
    int branched = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            PathRecord const r = replay(job, 0, {x, y});
            branched += check_tree(r);
            for (PathVertex const& v : r.vertices) {
                if (v.parent < 0) continue;
                PathVertex const& from = r.vertices[static_cast<std::size_t>(v.parent)];
                CHECK(v.id / 2 == (from.id == 0 ? 1 : from.id));
            }
        }
    CHECK(branched > 50);
}

TEST_CASE("a sample that is not a number says where that came from") {
    // Two skies that are both near the largest float.
    Scene s;
    add(s, floor_quad(3), diffuse(s, 0.5f));
    for (int i = 0; i < 2; ++i) s.lights.push_back(sky(2.5e38f));
    look(s, {0, -5, 1}, {0, 0, 1});
    World const world = compile(std::move(s));
    Settings settings;
    settings.color = ColorMode::Rgb;
    settings.film.resolution = {8, 6};
    RenderJob const job(world, settings);
    Film film = job.make_film();
    RayStats stats;
    render_pass(job, 0, film, stats);
    std::uint64_t broken = 0;
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) {
            PathRecord const r = replay(job, 0, {x, y});
            if (is_finite(r.value)) continue;
            ++broken;
            CHECK_FALSE((r.sum.total().is_finite() && is_finite(job.sensor()(r.sum.total(), r.lambda))));
            CHECK(!(r.met.empty() && r.tried.empty()));
        }
    CHECK(broken == film.dropped());
    CHECK(broken > 0);
}

TEST_CASE("what cannot be replayed is refused") {
    World const world = compile(room_of_everything(false));
    for (Integrator const& i : std::initializer_list<Integrator>{
             PhotonMapIntegrator{.shooting = {.global_paths = 10}, .estimates = {.radius = 0.1f}},
             SppmIntegrator{.shooting = {.global_paths = 10}, .estimates = {.radius = 0.1f}},
             LightPathIntegrator{}}) {
        Settings settings;
        settings.film.resolution = {8, 6};
        settings.integrator = i;
        RenderJob const job(world, settings);
        CHECK_FALSE(can_replay(i));
        CHECK_THROWS_WITH_AS(replay(job, 0, {0, 0}), doctest::Contains("path, direct or whitted"), Error);
    }
    Settings settings;
    settings.film.resolution = {8, 6};
    settings.film.crop = std::array<int, 4>{0, 2, 0, 2};
    RenderJob const job(world, settings);
    for (Vec2i const pixel : {Vec2i{8, 0}, Vec2i{0, 6}, Vec2i{-1, 0}, Vec2i{0, -1}})
        CHECK_THROWS_WITH_AS(replay(job, 0, pixel), doctest::Contains("x goes from 0 to 7"), Error);
    // Outside the window that is rendered is still in the picture.
    CHECK(replay(job, 0, {7, 5}).vertices.size() > 0);
}

}  // namespace nephroid::test
