// Photon integrators where there is nothing to find, or too much of it: no crash, no number that is none, and black only where it is
// dark.
#include "layers.h"
#include "scenes.h"

#include <cstring>

using namespace nephroid;
using namespace nephroid::test;

namespace {

PhotonMapIntegrator photon_map(int paths, bool gathers) {
    PhotonMapIntegrator p;
    p.shooting.global_paths = paths;
    p.final_gather = gathers;
    p.gather_samples = 2;
    return p;
}
SppmIntegrator progressive(int paths) {
    SppmIntegrator p;
    p.shooting.global_paths = paths;
    return p;
}
std::vector<Integrator> integrators(int paths) {
    return {photon_map(paths, true), photon_map(paths, false), progressive(paths)};
}

/// Means of the film by class, green.
struct Picture {
    double beauty = 0;
    std::array<double, kLightClasses> light{};
};
Picture picture(World const& world, Integrator const& integrator, std::uint64_t passes = 2,
                ColorMode color = ColorMode::Rgb, int side = 8) {
    Settings s = settings(integrator, side, side);
    s.film.aovs = true;
    s.color = color;
    s.spp = 2;
    RenderJob const job(world, s);
    Film film = job.make_film();
    RayStats stats;
    for (std::uint64_t i = 0; i < passes; ++i) render_pass(job, i, film, stats);
    CHECK(film.dropped() == 0);
    CHECK(stats.rejected == 0);
    Picture p;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            for (double const v : film.pixel(x, y).rgb) {
                CHECK(std::isfinite(v));
                if (color == ColorMode::Rgb) CHECK(v >= 0);
            }
            p.beauty += film.pixel(x, y).rgb[1] / film.pixel(x, y).weight / (side * side);
            for (std::size_t k = 0; k < kLightClasses; ++k)
                p.light[k] += film.aov(x, y).light[k][1] / film.pixel(x, y).weight / (side * side);
        }
    return p;
}
Picture picture(Scene const& s, Integrator const& i) { return picture(compile(s), i); }

/// A room of side 2 k, a lamp below its ceiling, a ball of glass.
Scene room(float k = 1, bool ball = true, bool lamp = true) {
    Scene s;
    add(s, box_mesh(Vec3(-k), Vec3(k), true), diffuse(s, 0.5f));
    if (lamp)
        add(s, Quad{Vec3{-0.25f, 0.25f, 0.95f} * k, Vec3{0.5f, 0, 0} * k, Vec3{0, -0.5f, 0} * k}).light =
            white(10);
    if (ball) {
        double const d = static_cast<double>(k);
        add(s, Sphere{0.4f * k, -0.4f * k, 0.4f * k}, glass(s)).to_group =
            translate(0.3 * d, 0.2 * d, -0.5 * d);
    }
    s.camera.kind = PerspectiveCamera{1.4f, 0, 1e30f};
    look(s, Vec3{0.1f, -0.9f, 0.1f} * k, Vec3{0, 0.2f, -0.3f} * k);
    return s;
}

}  // namespace

TEST_CASE("nothing: no lights, no surfaces, neither, and nothing in view") {
    for (Integrator const& i : integrators(500)) {
        CAPTURE(i.index());
        CHECK(picture(room(1, true, false), i).beauty == 0);
        CHECK(picture(Scene{}, i).beauty == 0);
        Scene sky_alone;
        sky_alone.add(sky(2));
        CHECK(picture(sky_alone, i).light[0] == doctest::Approx(2).epsilon(1e-3));
        Scene away = room();
        look(away, {0, 0, 5}, {0, 0, 10});
        CHECK(picture(away, i).beauty == 0);
        Scene unlit = room(1, true, false);
        unlit.add(point_light({0, 0, 0.5f}, 0));
        CHECK(picture(unlit, i).beauty == 0);
    }
}

TEST_CASE("no diffuse surface: mirrors and glass show the lamp, and no photon is anywhere") {
    Scene s;
    add(s, box_mesh(Vec3(-1), Vec3(1), true), mirror(s, 0.8f));
    add(s, Sphere{0.4f, -0.4f, 0.4f}, glass(s)).to_group = translate(0.3, 0.2, -0.5);
    add(s, Quad{{-0.25f, 0.25f, 0.95f}, {0.5f, 0, 0}, {0, -0.5f, 0}}).light = white(10);
    s.camera.kind = PerspectiveCamera{1.4f, 0, 1e30f};
    look(s, {0.1f, -0.9f, 0.1f}, {0, 0.2f, -0.3f});
    World const world = compile(std::move(s));
    for (Integrator const& i : integrators(500)) {
        Picture const p = picture(world, i);
        CHECK(p.light[3] > 0.05);
        CHECK(p.light[1] + p.light[2] == 0);
    }
}

TEST_CASE("a camera in glass, and a lamp in glass: light comes in and out") {
    Scene s = room();
    look(s, {0.3f, 0.2f, -0.5f}, {0, 0.9f, -0.2f});  // in the ball
    World const in_ball = compile(s);
    Scene lit = room(1, true, false);
    Object& lamp = add(lit, Sphere{0.1f, -0.1f, 0.1f});
    lamp.light = white(20);
    lamp.to_group = translate(0.3, 0.2, -0.5);
    World const lit_ball = compile(lit);
    for (World const* world : {&in_ball, &lit_ball}) {
        Picture const truth = picture(*world, path(8), 600);
        for (Integrator const& i : integrators(20000 / kSanitizerShare)) {
            Picture const p = picture(*world, i, 2, ColorMode::Rgb, 16);
            // All light from the lamp in the ball is a caustic at first.
            if (world == &lit_ball) CHECK(p.light[0] == 0);
            if (world == &lit_ball) CHECK(p.light[1] > 0.2 * p.beauty);
            CHECK(p.light[1] + p.light[2] == doctest::Approx(truth.light[1] + truth.light[2])
                                                 .epsilon(0.15 * (kSanitizerShare > 1 ? 3 : 1)));
        }
    }
}

TEST_CASE("no photons: direct light alone, or all but one map") {
    World const world = compile(room());
    for (Integrator const& base : integrators(2000))
        for (auto const& [global, caustic] : {std::pair{0, 0}, {0, 2000}, {2000, 0}, {1, 1}}) {
            CAPTURE(base.index());
            Integrator i = base;
            std::visit(
                [&, g = global, c = caustic](auto& x) {
                    if constexpr (requires { x.shooting; }) {
                        x.shooting.global_paths = g;
                        x.shooting.caustic_paths = c;
                    }
                },
                i);
            Picture const p = picture(world, i);
            CHECK(p.light[0] > 0.05);
            if (global == 0 && caustic == 0) CHECK(p.light[1] == 0);
            // Gather rays find near surfaces by themselves.
            if (global == 0 && caustic == 0 && i.index() == 4) CHECK(p.light[2] == 0);
            if (global == 2000) CHECK(p.light[2] > 0.02);
            if (caustic == 2000) CHECK(p.light[1] > 0.001);
        }
}

TEST_CASE("one photon for each estimate, more than there are, and radii of any size") {
    World const world = compile(room());
    Picture const truth = picture(world, path(8), 400);
    for (int const nused : {0, 1, 2, 100000})
        for (float const radius : {0.0f, 1e-30f, 1e-6f, 1e3f, 1e18f, 1e30f})
            for (Integrator const& base : integrators(1000)) {
                CAPTURE(nused);
                CAPTURE(radius);
                Integrator i = base;
                std::visit(
                    [&](auto& x) {
                        if constexpr (requires { x.estimates; }) {
                            x.estimates.nused = nused;
                            x.estimates.radius = radius;
                        }
                    },
                    i);
                Picture const p = picture(world, i, 1);
                CHECK(p.light[0] == doctest::Approx(truth.light[0]).epsilon(0.1));
                if (radius == 0 && (nused == 0)) CHECK(p.light[2] > 0.3 * truth.light[2]);
            }
}

TEST_CASE("all photons at one point: a beam without width") {
    for (float const angle : {1e-8f, 1e-6f, 1e-3f}) {
        Scene s;
        add(s, floor_quad(1), diffuse(s, 0.5f));
        add(s, Quad{{-1, -1, 0.5f}, {2, 0, 0}, {0, 2, 0}}, glass(s, ConstantSpd{1.0001f}));
        SpotLight l;
        l.from = {0, 0, 1};
        l.to = {0, 0, 0};
        l.cone_angle = angle;
        l.cone_delta = 0;
        s.add(Light{l, {}, {}});
        look(s, {0, -1, 2}, {0, 0, 0});
        World const world = compile(std::move(s));
        for (int const nused : {0, 1, 50})
            for (Integrator const& base : integrators(3000)) {
                Integrator i = base;
                std::visit(
                    [&](auto& x) {
                        if constexpr (requires { x.estimates; }) x.estimates.nused = nused;
                    },
                    i);
                picture(world, i);
            }
    }
}

TEST_CASE("the same picture at any size of the scene, and the same bits at powers of two") {
    auto const film_of = [](float k, Integrator const& i, ColorMode color) {
        World const world = compile(room(k));
        Settings s = settings(i, 10, 10);
        s.color = color;
        s.spp = 2;
        RenderJob const job(world, s);
        Film film = job.make_film();
        RayStats stats;
        for (std::uint64_t p = 0; p < 2; ++p) render_pass(job, p, film, stats);
        CHECK(film.dropped() == 0);
        return film;
    };
    for (Integrator const& i : integrators(2000 / kSanitizerShare)) {
        CAPTURE(i.index());
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
            Film const one = film_of(1, i, color);
            for (float const k : {0x1p-13f, 0x1p20f}) {
                Film const other = film_of(k, i, color);
                int different = 0;
                for (int y = 0; y < 10; ++y)
                    for (int x = 0; x < 10; ++x)
                        different +=
                            std::memcmp(&one.pixel(x, y), &other.pixel(x, y), sizeof(PixelSums)) != 0;
                CHECK(different == 0);
            }
        }
        Picture const one = picture(compile(room()), i, 4);
        for (float const k : {1e-3f, 1e5f}) {
            Picture const other = picture(compile(room(k)), i, 4);
            CHECK(other.beauty == doctest::Approx(one.beauty).epsilon(0.03));
            CHECK(other.light[2] == doctest::Approx(one.light[2]).epsilon(0.2));
        }
    }
}

TEST_CASE("a hundred thousand lights, instances, alpha that varies, few spectral passes") {
    Scene s;
    add(s, floor_quad(4), diffuse(s, 0.5f));
    CheckerboardTexture checks;
    checks.mapping = UvMapping{4, 4, 0, 0};
    checks.tex1 = s.add(Texture{ConstantFloatTexture{1}, {}});
    checks.tex2 = s.add(Texture{ConstantFloatTexture{0}, {}});
    GroupId const tree = s.add(Group{.name = "tree"});
    Object leaf;
    leaf.shape = Quad{{-0.3f, -0.3f, 0}, {0.6f, 0, 0}, {0, 0.6f, 0}};
    leaf.material = diffuse(s, 0.7f);
    leaf.alpha = s.add(Texture{checks, {}});
    s.groups[tree.value].objects.push_back(leaf);
    Object drop;
    drop.shape = Sphere{0.2f, -0.2f, 0.2f};
    drop.material = glass(s);
    drop.to_group = translate(0, 0, 0.5);
    s.groups[tree.value].objects.push_back(drop);
    for (int i = 0; i < 5; ++i)
        s.world().instances.push_back({.group = tree, .to_parent = rows_of(translate(-2 + i, 0.3 * i, 0.6))});
    Scene many = s;
    Random random(1);
    int const lights = 100'000 / kSanitizerShare;
    for (int i = 0; i < lights; ++i)
        many.add(point_light({4 * random.unit() - 2, 4 * random.unit() - 2, 2 + random.unit()},
                             3.0f / static_cast<float>(lights)));
    s.add(point_light({0, 0, 2.5f}, 3));
    for (Scene* scene : {&s, &many}) {
        look_parallel(*scene, {0, -3, 3}, {0, 3, -3}, 2);
        World const world = compile(*scene);
        Picture const truth = picture(world, path(5), scene == &s ? 1000 : 300);
        for (Integrator const& i : integrators(5000))
            for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
                if (scene == &many && color == ColorMode::Spectral) continue;
                Picture const p = picture(world, i, 3, color, 16);
                CAPTURE(i.index());
                double const tint = color == ColorMode::Spectral ? 0.3 : 0;  // few passes
                CHECK(p.light[0] == doctest::Approx(truth.light[0]).epsilon(0.1 + tint));
                CHECK(p.light[2] == doctest::Approx(truth.light[2]).epsilon(0.25 + tint));
            }
    }
}
