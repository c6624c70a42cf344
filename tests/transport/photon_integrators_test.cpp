// Both photon integrators against closed forms and against the path tracer, class of light by class: what one finds by chance the
// others read from maps, and nothing twice. Estimates from maps are blurred over their radius, so that means over films are compared,
// with a stated room for what blurs over edges.
#include "layers.h"
#include "scene/match.h"
#include "scenes.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

constexpr double kPiD = 3.14159265358979323846;
char const* const kClassNames[] = {"direct", "caustic", "indirect", "specular"};

/// All photons within the radii; automatic ones where 0.
PhotonMapIntegrator photon_map(int paths, bool gathers, float radius, float caustic_radius) {
    PhotonMapIntegrator p;
    p.shooting.global_paths = paths;
    p.final_gather = gathers;
    p.gather_samples = 4;
    p.estimates.radius = radius;
    p.estimates.caustic_radius = caustic_radius;
    if (!gathers) p.estimates.nused = 0;
    return p;
}
SppmIntegrator progressive(int max_depth, int paths, float radius = 0) {
    SppmIntegrator p;
    p.max_depth = max_depth;
    p.shooting.global_paths = paths;
    p.shooting.max_depth = max_depth;
    p.estimates.radius = radius;
    p.estimates.edge_correction = true;
    return p;
}

/// The film's means: classes, and what is left of the beauty without them.
struct FilmMeans {
    std::array<std::array<Mean, 3>, kLightClasses> light;
    std::array<Mean, 3> beauty;
    double missing = 0;  // the largest |beauty - sum of classes| / beauty
};
FilmMeans film_means(World const& world, Settings s, std::uint64_t passes, std::uint64_t first_seed) {
    s.film.aovs = true;
    FilmMeans means;
    RayStats stats;
    int const nx = s.film.resolution.x, ny = s.film.resolution.y;
    for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
        s.seed = first_seed * 1000 + batch;
        RenderJob const job(world, s);
        Film film = job.make_film();
        for (std::uint64_t i = 0; i < passes; ++i) render_pass(job, i, film, stats);
        CHECK(film.dropped() == 0);
        for (std::size_t c = 0; c < 3; ++c) {
            double all = 0;
            std::array<double, kLightClasses> by_class{};
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x) {
                    double const w = film.pixel(x, y).weight * nx * ny;
                    all += film.pixel(x, y).rgb[c] / w;
                    for (std::size_t k = 0; k < kLightClasses; ++k)
                        by_class[k] += film.aov(x, y).light[k][c] / w;
                }
            double sum = 0;
            for (std::size_t k = 0; k < kLightClasses; ++k) {
                means.light[k][c].add(by_class[k]);
                sum += by_class[k];
            }
            means.beauty[c].add(all);
            if (all > 0) means.missing = std::max(means.missing, std::abs(sum - all) / all);
        }
    }
    CHECK(stats.rejected == 0);
    return means;
}

MaterialId rough_metal(Scene& s, float alpha) {
    ConductorMaterial m;
    m.reflectance = spectrum(s, RgbAlbedoSpd{{0.9f, 0.7f, 0.4f}});
    m.roughness = {s.add(Texture{ConstantFloatTexture{alpha}, {}}), {}, false};
    return material(s, m);
}
MaterialId coated(Scene& s, float alpha, CoatModel model = CoatModel::Automatic) {
    CoatedDiffuseMaterial m;
    m.reflectance = spectrum(s, ConstantSpd{0.5f});
    m.coat.model = model;
    m.coat.roughness = {s.add(Texture{ConstantFloatTexture{alpha}, {}}), {}, false};
    m.coat.thickness = s.add(Texture{ConstantFloatTexture{0.01f}, {}});
    return material(s, m);
}
MaterialId leaf(Scene& s) {
    DiffuseTransmissionMaterial m;
    m.reflectance = spectrum(s, ConstantSpd{0.3f});
    m.transmittance = spectrum(s, ConstantSpd{0.5f});
    return material(s, m);
}
MaterialId rough_glass(Scene& s, float alpha) {
    DielectricMaterial m;
    m.roughness = {s.add(Texture{ConstantFloatTexture{alpha}, {}}), {}, false};
    return material(s, m);
}
MaterialId flint(Scene& s) { return glass(s, TabulatedSpd{{380, 500, 700}, {1.9f, 1.7f, 1.5f}}); }
MaterialId thin(Scene& s) { return material(s, ThinDielectricMaterial{}); }
MaterialId plastic(Scene& s) {
    PlasticMaterial m;
    m.reflectance = spectrum(s, ConstantSpd{0.5f});
    return material(s, m);
}
MaterialId half_mirror(Scene& s) {
    return material(
        s, MixMaterial{diffuse(s, 0.5f), mirror(s, 0.9f), s.add(Texture{ConstantFloatTexture{0.5f}, {}})});
}
MaterialId veil(Scene& s) {
    return material(s, MixMaterial{diffuse(s, 0.8f), material(s, InterfaceMaterial{}),
                                   s.add(Texture{ConstantFloatTexture{0.75f}, {}})});
}

using Make = MaterialId (*)(Scene&);
struct Case {
    char const* name;
    Make make;
    bool quick = true;  // not only when there is time
    ColorMode color = ColorMode::Rgb;
    float alpha = 1;
};
Case const kMaterials[] = {
    {"glass", [](Scene& s) { return glass(s); }},
    {"mirror", [](Scene& s) { return mirror(s, 0.9f); }},
    {"flint", flint, true, ColorMode::Spectral},
    {"metal, near-specular", [](Scene& s) { return rough_metal(s, 0.05f); }},
    {"metal, rough", [](Scene& s) { return rough_metal(s, 0.3f); }},
    {"coated, smooth", [](Scene& s) { return coated(s, 0); }},
    {"coated, rough", [](Scene& s) { return coated(s, 0.4f); }},
    {"leaf", leaf},
    {"half mirror", half_mirror},
    {"alpha", [](Scene& s) { return diffuse(s, 0.8f); }, true, ColorMode::Rgb, 0.4f},
    {"a quarter diffuse, or not there", veil, false},
    {"diffuse", [](Scene& s) { return diffuse(s, 0.5f); }, false},
    {"thin glass", thin, false},
    {"glass, near-specular", [](Scene& s) { return rough_glass(s, 0.05f); }, false},
    {"glass, rough", [](Scene& s) { return rough_glass(s, 0.3f); }, false},
    {"coated, near-specular", [](Scene& s) { return coated(s, 0.05f); }, false},
    {"coated, walks", [](Scene& s) { return coated(s, 0, CoatModel::Stochastic); }, false},
    {"plastic", plastic, false}};

/// A room with a large lamp below its ceiling, and a ball on each side of it.
Scene room_with(Make make, float alpha = 1) {
    Scene s;
    add(s, box_mesh({-1, -1, -1}, {1, 1, 1}, true), diffuse(s, Vec3{0.5f, 0.4f, 0.3f}));
    MaterialId const m = make(s);
    add(s, Sphere{0.5f, -0.5f, 0.5f}, m).to_group = translate(-0.4, 0.3, -0.3);
    add(s, Sphere{0.3f, -0.3f, 0.3f}, m).to_group = translate(0.5, -0.1, 0.2);
    if (alpha < 1)
        for (std::size_t i = 1; i < 3; ++i)
            s.world().objects[i].alpha = s.add(Texture{ConstantFloatTexture{alpha}, {}});
    add(s, Quad{{-0.8f, -0.8f, 0.9f}, {0, 1.6f, 0}, {1.6f, 0, 0}}).light = white(1);
    s.camera.kind = PerspectiveCamera{1.4f, 0, 1e6f};
    look(s, {0.05f, -0.95f, 0.1f}, {0, 1, -0.2f});
    return s;
}

struct How {
    char const* name;
    Integrator integrator;
    int spp = 1;
    std::uint64_t passes = 1;
    double room[kLightClasses] = {0.01, 0.02, 0.02, 0.01};  // for blur, as a share of the beauty
};

/// Each class equals that of the settings' integrator, over so many passes.
void check_classes(World const& world, Settings s, std::uint64_t passes, std::vector<How> const& hows,
                   double within) {
    FilmMeans const truth = film_means(world, s, passes, 1);
    for (How const& how : hows) {
        s.integrator = how.integrator;
        s.spp = how.spp;
        FilmMeans const seen = film_means(world, s, how.passes, 2);
        CHECK(seen.missing <= 1e-5);
        for (std::size_t k = 0; k < kLightClasses; ++k)
            for (std::size_t c = 0; c < 3; ++c) {
                Mean const& a = seen.light[k][c];
                Mean const& b = truth.light[k][c];
                double const beauty = truth.beauty[c].mean();
                double const error = std::hypot(a.standard_error(), b.standard_error());
                double const off = (a.mean() - b.mean()) / beauty;
                double const past = std::max(0.0, std::abs(off) - how.room[k]) * beauty;
                double const p = past > 0 ? student_p(past / error, kBatches - 1) : 1;
                CHECK_MESSAGE(p >= 1e-4, how.name, ", ", kClassNames[k], ", channel ", c, ": ", a.mean(),
                              " +- ", a.standard_error(), ", path tracing ", b.mean(), " +- ",
                              b.standard_error());
                CHECK_MESSAGE(error / beauty <= within * (kSanitizerShare > 1 ? 4 : 1), how.name, ", ",
                              kClassNames[k], ": inconclusive, +- ", error / beauty);
            }
    }
}

}  // namespace

TEST_CASE("each class of light equals the path tracer's, material by material") {
    for (Case const& m : kMaterials) {
        if (!m.quick && !full()) continue;
        CAPTURE(m.name);
        World const world = compile(room_with(m.make, m.alpha));
        Settings s = settings(path(12), 10, 10);
        s.color = m.color;
        bool const spectral = m.color == ColorMode::Spectral;
        // Wavelengths belong to the pass: colours need many.
        std::uint64_t const passes = spectral ? 8 : 1;
        int const n = samples(spectral ? 200 : 1000, 40000);
        check_classes(world, s, static_cast<std::uint64_t>(samples(14, 320)),
                      {{"gathered", photon_map(n, true, 0, 0.05f), 3, passes},
                       {"read", photon_map(n, false, 0.05f, 0.05f), 3, passes},
                       {"sppm", progressive(12, n, 0.05f), 1, 2 * passes}},
                      full() ? 0.015 : 0.04);
    }
}

TEST_CASE("a point light and a sky: light tracing finds each class that the maps hold") {
    // A floor seen from right above it, between balls of glass and metal and the light.
    for (bool const sky_too : {false, true}) {
        CAPTURE(sky_too);
        Scene s;
        add(s, floor_quad(1.5f), diffuse(s, Vec3{0.6f, 0.5f, 0.4f}));
        add(s, Quad{{-1.5f, 1.2f, 0}, {0, 0, 1.5f}, {3, 0, 0}}, diffuse(s, 0.7f));
        add(s, Sphere{0.4f, -0.4f, 0.4f}, glass(s)).to_group = translate(-0.5, 0, 0.9);
        add(s, Sphere{0.4f, -0.4f, 0.4f}, rough_metal(s, 0.05f)).to_group = translate(0.7, 0, 0.9);
        s.add(point_light({0, -0.3f, 2}, 2));
        if (sky_too) s.add(sky(0.3f));
        look_parallel(s, {0, 0, 0.4f}, {0, 0, -1}, 0.9f);
        World const world = compile(std::move(s));
        int const n = samples(4000, 40000);
        LightPathIntegrator lights;
        lights.max_depth = 8;
        lights.paths = samples(30000, 300000);
        check_classes(world, settings(lights, 12, 12), 2,
                      {{"gathered", photon_map(n, true, 0, 0.04f), 4, 1},
                       {"read", photon_map(n, false, 0.05f, 0.04f), 4, 1},
                       {"sppm", progressive(8, n, 0.04f), 1, 3}},
                      0.025);
    }
}

TEST_CASE("closed forms: a furnace, a point light in a sphere, an integrating sphere") {
    // L_e / (1 - R) = 2; rho I / (pi r^2 (1 - rho)) = 1; and rho Phi / (A (1 - rho)) of indirect irradiance, wherever the light is.
    int const n = samples(4000, 100000);
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

TEST_CASE("sppm cut at a depth is what path tracing is at that depth") {
    Scene s = room_with(kMaterials[0].make);
    World const world = compile(std::move(s));
    for (int const depth : {0, 1, 2, 3}) {
        CAPTURE(depth);
        check_classes(world, settings(path(depth), 12, 12), static_cast<std::uint64_t>(samples(24, 240)),
                      {{"sppm", progressive(depth, samples(2500, 40000), 0.05f), 1, 2}}, 0.02);
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
    lights.paths = samples(2000, 20000);
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
