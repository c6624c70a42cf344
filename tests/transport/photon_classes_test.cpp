// Both photon integrators against path and light tracing, class of light by class: what one finds by chance the others read from maps,
// and nothing twice. Estimates from maps are blurred over their radius, so that means over films are compared, with a stated room for
// what blurs over edges.
#include "photon_classes.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

char const* const kClassNames[] = {"direct", "caustic", "indirect", "specular"};

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
    double room[kLightClasses] = {0.002, 0.005, 0.008, 0.002};  // for blur, as a share of the beauty
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

TEST_CASE("sppm cut at a depth is what path tracing is at that depth") {
    Scene s = room_with(kMaterials[0].make);
    World const world = compile(std::move(s));
    for (int const depth : {0, 1, 2, 3}) {
        CAPTURE(depth);
        check_classes(world, settings(path(depth), 12, 12), static_cast<std::uint64_t>(samples(24, 240)),
                      {{"sppm", progressive(depth, samples(2500, 40000), 0.05f), 1, 2}}, 0.02);
    }
}
