// What is worked out for eight paths at once has the bits of what is worked out for one: a world whose surfaces have plain colours, which
// is where paths go together, makes the very picture that it makes when the same colours come from textures, where each goes alone.
#include "photons.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>

namespace nephroid::test {
namespace {

enum class Colours { Plain, Textured };
enum class Lamp { Rectangle, TwoSided, Triangle, Skew, Large, Two, Unseen };
constexpr Lamp kLamps[] = {Lamp::Rectangle, Lamp::TwoSided, Lamp::Triangle, Lamp::Skew,
                           Lamp::Large,     Lamp::Two,      Lamp::Unseen};

MaterialId painted(Scene& s, Colours how, Vec3 rgb) {
    TextureId colour = spectrum(s, RgbAlbedoSpd{rgb});
    if (how == Colours::Textured)
        colour = s.add(Texture{ScaleTexture{colour, s.add(Texture{ConstantFloatTexture{1}, {}})}, {}});
    return material(s, DiffuseMaterial{colour});
}

/// A tent of four triangles whose normals lean outwards.
TriangleMesh tent(Vec3 at) {
    TriangleMesh m;
    m.p = {at + Vec3{-0.5f, -0.5f, 0}, at + Vec3{0.5f, -0.5f, 0}, at + Vec3{0.5f, 0.5f, 0},
           at + Vec3{-0.5f, 0.5f, 0}, at + Vec3{0, 0, 0.7f}};
    m.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    for (Vec3 const p : m.p) m.n.push_back(normalize(p - at + Vec3{0, 0, 0.3f}));
    return m;
}

/// Everything that paths in lanes pass on their way: meshes with and without normals, turned around, of instances, balls that have a plain
/// colour, and glass and mirrors where each goes alone again.
Scene room(Colours how, Lamp lamp) {
    Scene s;
    add(s, box_mesh({-2, -2, -2}, {2, 2, 2}, true), painted(s, how, {0.7f, 0.5f, 0.3f}));
    add(s, tent({0.9f, 0.9f, -2}), painted(s, how, {0.2f, 0.8f, 0.4f}));
    add(s, box_mesh({-1.6f, 0.6f, -2}, {-0.9f, 1.3f, -0.6f}, true), painted(s, how, {0.6f, 0.6f, 0.9f}))
        .reverse_orientation = true;
    add_sphere(s, {0.2f, 0, -1.5f}, 0.4f, painted(s, how, {0.9f, 0.9f, 0.2f}));
    add_sphere(s, {1.2f, -0.4f, -1.4f}, 0.5f, glass(s));
    add_sphere(s, {-1, -0.6f, -1.5f}, 0.4f, mirror(s, 0.8f));
    Group group;
    add(group, tent({0, 0, 0}), painted(s, how, {0.8f, 0.3f, 0.3f}));
    s.groups.push_back(std::move(group));
    Instance instance;
    instance.group = GroupId{static_cast<std::uint32_t>(s.groups.size() - 1)};
    instance.to_parent = rows_of(translate(-0.3, 1.2, -1.2));
    s.world().instances.push_back(instance);

    TriangleMesh shining =
        rectangle({-0.5f, -0.4f, 1.9f}, {-0.5f, 0.4f, 1.9f}, {0.5f, 0.4f, 1.9f}, {0.5f, -0.4f, 1.9f});
    if (lamp == Lamp::Triangle) shining.triangles.pop_back();
    if (lamp == Lamp::Skew) shining.p[2].x += 0.3f, shining.p[1].x += 0.3f;
    if (lamp == Lamp::Large)
        shining =
            rectangle({-1.9f, -1.9f, 1.9f}, {-1.9f, 1.9f, 1.9f}, {1.9f, 1.9f, 1.9f}, {1.9f, -1.9f, 1.9f});
    Object& o = add(s, std::move(shining), diffuse(s, 0.3f));
    o.light = white(4, lamp == Lamp::TwoSided);
    if (lamp == Lamp::Unseen) o.alpha = s.add(Texture{ConstantFloatTexture{0}, {}});
    if (lamp == Lamp::Two) s.add(point_light({0, 1.5f, 0}, 1));
    look(s, {0, -1.9f, 0.2f}, {0, 0.5f, -0.8f});
    return s;
}

std::vector<std::pair<std::string, Integrator>> integrators() {
    PathIntegrator path{.max_depth = 8};
    PathIntegrator no_mis = path;
    no_mis.sample_bsdf_mis = false;
    PathIntegrator no_lights = path;
    no_lights.sample_lights = false;
    PathIntegrator fixed = path;
    fixed.roulette = {RouletteKind::Fixed, 0.7f};
    PathIntegrator by_area = path;
    by_area.roulette.kind = RouletteKind::None;
    by_area.lights.shapes = ShapeSampling::Area;
    PathIntegrator shortest = path;
    shortest.max_depth = 0;
    SppmIntegrator sppm = shooting(3000);
    sppm.estimates.radius = 0.3f;
    sppm.estimates.caustic_radius = 0.1f;
    return {{"path", path},
            {"no MIS", no_mis},
            {"no lights", no_lights},
            {"fixed roulette", fixed},
            {"by area", by_area},
            {"emission alone", shortest},
            {"sppm", sppm}};
}

Film rendered(World const& world, Settings const& settings) {
    RenderJob const job(world, settings);
    Film film = job.make_film();
    RayStats stats;
    for (std::uint64_t pass = 0; pass < 2; ++pass) render_pass(job, pass, film, stats);
    return film;
}

/// How many pixels of the two are not the same to the bit.
int differing(Film const& a, Film const& b) {
    int n = 0;
    for (int y = 0; y < a.resolution().y; ++y)
        for (int x = 0; x < a.resolution().x; ++x)
            n += static_cast<int>(a.pixel(x, y).rgb != b.pixel(x, y).rgb);
    return n;
}

}  // namespace

TEST_CASE("in lanes: paths make the bits that they make alone") {
    for (Lamp const lamp : kLamps) {
        World const plain = compile(room(Colours::Plain, lamp));
        World const textured = compile(room(Colours::Textured, lamp));
        REQUIRE(plain.has_lone_flat_light() == (lamp != Lamp::Two && lamp != Lamp::Unseen));
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral})
            for (auto const& [name, integrator] : integrators()) {
                Settings s;
                s.color = color;
                s.film.resolution = {23, 17};  // eights do not fit
                s.integrator = integrator;
                std::string const what = name;  // clang 14 captures no structured bindings
                CAPTURE(what);
                CAPTURE(static_cast<int>(lamp));
                Film const together = rendered(plain, s);
                CHECK(differing(together, rendered(textured, s)) == 0);
                double sum = 0;
                for (int i = 0; i < 23 * 17; ++i) sum += together.pixel(i % 23, i / 23).rgb[1];
                // The lamp itself is not in every picture, nor met by chance where nothing is there.
                CHECK((sum > 1 || name == "emission alone" || name == "no lights"));
            }
    }
}

TEST_CASE("in lanes: other samplers, layers and lenses") {
    World const plain = compile(room(Colours::Plain, Lamp::Rectangle));
    World const textured = compile(room(Colours::Textured, Lamp::Rectangle));
    for (auto const& [name, integrator] : integrators()) {
        std::string const what = name;
        CAPTURE(what);
        Settings s;
        s.film.resolution = {23, 17};
        s.integrator = integrator;
        s.sampler = IndependentSampler{};
        CHECK(differing(rendered(plain, s), rendered(textured, s)) == 0);
        s.sampler = StratifiedSampler{};
        CHECK(differing(rendered(plain, s), rendered(textured, s)) == 0);
        s.film.aovs = true;
        Film const a = rendered(plain, s);
        Film const b = rendered(textured, s);
        CHECK(differing(a, b) == 0);
        int other = 0;
        for (int i = 0; i < 23 * 17; ++i)
            other += std::memcmp(&a.aov(i % 23, i / 23).position, &b.aov(i % 23, i / 23).position,
                                 sizeof a.aov(0, 0).position) != 0;
        CHECK(other == 0);
    }
}

TEST_CASE("in lanes: photons are those of paths that are followed alone") {
    for (Lamp const lamp : kLamps) {
        World const world = compile(room(Colours::Plain, lamp));
        CAPTURE(static_cast<int>(lamp));
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral})
            for (ShotKind const kind : {ShotKind::Global, ShotKind::Indirect, ShotKind::Caustic}) {
                int const paths = 2000;
                Settings const s = shot_settings(paths, color, true, 5);
                Shot const shot = shot_of(world, s, kind, 3);
                RenderJob const job(world, s);
                std::vector<Photon> alone;
                std::vector<Photon> further;
                std::vector<PhotonCounts> ends(shot.by_source.size());
                for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(paths); ++i) {
                    TracedPath const path =
                        trace_light_path(job, kind, 3, i, static_cast<std::uint64_t>(paths));
                    PhotonCounts& counts = ends[world.source_of(path.light)];
                    ++counts.emitted;
                    ++(counts.*path.end);
                    counts.stored += path.photons.size();
                    counts.further += path.further.size();
                    for (PhotonRecord const& r : path.photons) alone.emplace_back(r);
                    for (PhotonRecord const& r : path.further) further.emplace_back(r);
                }
                for (std::size_t i = 0; i < ends.size(); ++i)
                    CHECK(std::memcmp(&ends[i], &shot.by_source[i], sizeof(PhotonCounts)) == 0);
                CHECK(shot.photons.size() > 100);
                REQUIRE(shot.photons.size() == alone.size());
                CHECK(std::memcmp(shot.photons.data(), alone.data(), alone.size() * sizeof(Photon)) == 0);
                CHECK((shot.further.size() > 100) == (kind == ShotKind::Caustic));
                REQUIRE(shot.further.size() == further.size());
                if (!further.empty())
                    CHECK(std::memcmp(shot.further.data(), further.data(), further.size() * sizeof(Photon)) ==
                          0);
            }
    }
}

}  // namespace nephroid::test
