// Layers of light by its ways: they add up to the picture, and each is what its letters say.
#include "layers.h"
#include "scenes.h"
#include "transport/light_class.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

enum : std::size_t { kDirect, kCaustic, kIndirect, kSpecular };

/// Diffuse walls, a mirror, glass, a nearly smooth metal, a lamp; all four classes are in it.
Scene mixed_room() {
    Scene s;
    add(s, box_mesh({-2, -2, -2}, {2, 2, 2}, true), diffuse(s, Vec3{0.7f, 0.5f, 0.3f}));
    ConductorMaterial polished;
    polished.reflectance = spectrum(s, ConstantSpd{0.8f});
    polished.roughness = {s.add(Texture{ConstantFloatTexture{0.02f}, {}}), {}, false};
    add(s, Sphere{0.5f, -0.5f, 0.5f}, material(s, polished)).to_group = translate(-1, 0.5, -0.5);
    add(s, Sphere{0.5f, -0.5f, 0.5f}, mirror(s, 0.9f)).to_group = translate(1, 0.8, 0);
    add(s, Sphere{0.4f, -0.4f, 0.4f}, glass(s)).to_group = translate(0, 0.2, -1);
    add(s, Quad{{-1.5f, -1.5f, 1.9f}, {0, 3, 0}, {3, 0, 0}}).light = white(10, true);
    s.add(point_light({1.5f, -1, 1}, 2));
    s.camera.kind = PerspectiveCamera{1.4f, 0, 1e6f};
    look(s, {0, -1.9f, 0.3f}, {0, 1, 0});
    return s;
}

}  // namespace

TEST_CASE("a path has the same class from either end") {
    // All words of up to six scatterings.
    for (int length = 1; length <= 6; ++length)
        for (int word = 0; word < 1 << length; ++word) {
            PathClass from_eye, from_light;
            for (int i = 0; i < length; ++i) from_eye.scatter((word >> i & 1) != 0);
            for (int i = length - 1; i > 0; --i) from_light.scatter((word >> i & 1) != 0);
            LightClass const expected = from_eye.ends_on_light();
            CHECK(from_light.seen_after((word & 1) != 0) == expected);
            // By Heckbert's letters: how many D, and whether an S stands before the first of them.
            int diffuse = 0;
            for (int i = 0; i < length; ++i) diffuse += (word >> i & 1) == 0;
            bool const begins_specular = (word >> (length - 1) & 1) != 0;
            CHECK(expected == (diffuse == 0      ? LightClass::Specular
                               : diffuse > 1     ? LightClass::Indirect
                               : begins_specular ? LightClass::Caustic
                                                 : LightClass::Direct));
        }
    CHECK(PathClass().ends_on_light() == LightClass::Direct);
}

TEST_CASE("the layers add up to the picture, whatever the integrator, filter and limit") {
    World const world = compile(mixed_room());
    LightPathIntegrator light_paths;
    light_paths.paths = 2000;
    SppmIntegrator sppm;
    sppm.shooting.global_paths = 500;
    std::vector<Integrator> const integrators{
        path(6), naive(path(6)), without_mis(path(6)), DirectIntegrator{}, WhittedIntegrator{},
        sppm,    light_paths};
    for (Integrator const& integrator : integrators)
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral})
            for (float const limit : {kInfinity, 0.7f}) {
                CAPTURE(integrator.index());
                CAPTURE(limit);
                Settings s = settings(integrator, 12, 10);
                s.filter = LanczosSincFilter{{2, 2}};
                s.color = color;
                s.film.aovs = true;
                s.film.max_component = limit;
                RenderJob const job(world, s);
                Film film = job.make_film();
                RayStats stats;
                for (std::uint64_t i = 0; i < 4; ++i) render_pass(job, i, film, stats);
                std::array<double, kLightClasses> seen{};
                for (int y = 0; y < 10; ++y)
                    for (int x = 0; x < 12; ++x) {
                        PixelSums const& p = film.pixel(x, y);
                        AovSums const& a = film.aov(x, y);
                        // Negative lobes: what is summed is larger than the sum.
                        double const scale = std::sqrt(p.square[0] + p.square[1] + p.square[2]) + 1e-30;
                        for (std::size_t c = 0; c < 3; ++c) {
                            double sum = 0;
                            for (std::size_t k = 0; k < kLightClasses; ++k) sum += a.light[k][c];
                            CHECK(std::abs(sum - p.rgb[c]) <= 1e-5 * scale);
                            for (std::size_t k = 0; k < kLightClasses; ++k)
                                seen[k] += std::abs(a.light[k][c]);
                        }
                    }
                CHECK(seen[kDirect] > 0);
                bool const one_bounce = std::holds_alternative<DirectIntegrator>(integrator) ||
                                        std::holds_alternative<WhittedIntegrator>(integrator);
                if (!one_bounce) CHECK(seen[kIndirect] > 0);
                if (one_bounce) CHECK(seen[kIndirect] == 0);
                if (!std::holds_alternative<LightPathIntegrator>(integrator)) CHECK(seen[kSpecular] > 0);
            }
}

TEST_CASE("a limit on the largest component scales all layers alike") {
    World const world = compile(mixed_room());
    Settings s = settings(path(6), 12, 10);
    s.film.aovs = true;
    s.film.max_component = 0.2f;
    RenderJob const job(world, s);
    Film film = job.make_film();
    RayStats stats;
    render_pass(job, 0, film, stats);
    int limited = 0;
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 12; ++x) {
            AovSums const& a = film.aov(x, y);
            double largest = 0;
            for (std::size_t c = 0; c < 3; ++c)
                largest = std::max(largest, a.light[0][c] + a.light[1][c] + a.light[2][c] + a.light[3][c]);
            CHECK(largest <= 0.2 * (1 + 1e-5));
            limited += largest > 0.2 * (1 - 1e-5);
        }
    CHECK(limited > 20);
}

TEST_CASE("the light that layers show: one mirror, one lamp, one floor") {
    // A sphere light of radius r and radiance I / (pi r^2) is a point of intensity I, but that paths find it in the mirror. Seen from
    // afar it is uniform: E = pi L (r/d)^2 cos.
    double const r = 0.3;
    Scene s;
    Object& lamp = add(s, Sphere{0.3f, -0.3f, 0.3f});
    lamp.light = white(static_cast<float>(1 / (kPiD * r * r)));
    lamp.to_group = translate(0, 0, 1);
    add(s, floor_quad(3), diffuse(s, 0.5f));
    add(s, Quad{{1, -3, 0}, {0, 6, 0}, {0, 0, 6}}, mirror(s, 1.0f));  // faces either way
    look_parallel(s, {0.5f, 0, 0.02f}, {0, 0, -1}, 0.002f);
    World const world = compile(std::move(s));
    PathIntegrator deep = path(3);
    auto const means = measure_layers(world, settings(deep, 1, 1), samples(24'000, 400'000));
    auto const& light = means[0].light;
    double const to_radiance = 0.5 / kPiD;
    auto const direct = agrees(light[kDirect][1], 0.715542 * to_radiance, 0.005, 0.005);
    CHECK_MESSAGE(direct, direct);
    auto const caustic =
        agrees(light[kCaustic][1], 0.170677 * to_radiance, 0.03 * (kSanitizerShare > 1 ? 4 : 1), 0.005);
    CHECK_MESSAGE(caustic, caustic);
    CHECK(light[kSpecular][1].mean() == 0);
}

TEST_CASE(
    "a lamp is direct where it is seen, specular in a mirror or through glass; what a mirror shows of a "
    "floor is the floor's") {
    auto const seen = [](bool lamp, MaterialId (*make)(Scene&)) {
        Scene s;
        add(s, floor_quad(3), make(s));
        if (lamp)
            add(s, floor_quad(9, 4)).light = white(1, true);
        else
            add(s, floor_quad(9, 4), diffuse(s, 0.5f));
        s.add(point_light({0, 0, 2}, 1));
        look_parallel(s, {0, 0, 1}, {0, 0, -1}, 0.1f);
        World const world = compile(std::move(s));
        auto const means = measure_layers(world, settings(path(1 + (lamp ? 0 : 1)), 1, 1), 4);
        std::array<double, 4> v{};
        for (std::size_t k = 0; k < 4; ++k) v[k] = means[0].light[k][1].mean();
        return v;
    };
    auto const in_mirror = seen(true, [](Scene& s) { return mirror(s, 0.75f); });
    CHECK(in_mirror[kSpecular] == doctest::Approx(0.75));
    CHECK(in_mirror[kDirect] + in_mirror[kCaustic] + in_mirror[kIndirect] == 0);
    auto const floor_in_mirror = seen(false, [](Scene& s) { return mirror(s, 1.0f); });
    CHECK(floor_in_mirror[kDirect] == doctest::Approx(0.5 / kPiD / 4).epsilon(0.01));
    CHECK(floor_in_mirror[kSpecular] + floor_in_mirror[kCaustic] + floor_in_mirror[kIndirect] == 0);
    Scene s;
    add(s, floor_quad(3)).light = white(2, true);
    look_parallel(s, {0, 0, 1}, {0, 0, -1}, 0.1f);
    auto const means = measure_layers(compile(std::move(s)), settings(path(0), 1, 1), 1);
    CHECK(means[0].light[kDirect][1].mean() == doctest::Approx(2));
}

TEST_CASE("a furnace: all but the first bounce is indirect, and nothing a caustic") {
    Scene s;
    add(s, box_mesh({-1, -1, -1}, {1, 1, 1}, true), diffuse(s, 0.5f)).light = white(1);
    look_around(s, {0.1f, 0.2f, 0.3f});
    World const world = compile(std::move(s));
    for (bool const naively : {false, true}) {
        PathIntegrator const p = naively ? naive(path(4)) : path(4);
        auto const means = measure_layers(world, settings(p, 1, 1), samples(600, 6000));
        auto const& light = means[0].light;
        // L_e + R L_e, and R^2 + R^3 + R^4.
        auto const direct = agrees(light[kDirect][1], 1.5, 0.005, 0.005);
        CHECK_MESSAGE(direct, direct);
        auto const indirect = agrees(light[kIndirect][1], 0.4375, 0.01, 0.005);
        CHECK_MESSAGE(indirect, indirect);
        CHECK(light[kCaustic][1].mean() + light[kSpecular][1].mean() == 0);
    }
}
