// A scene scaled by a power of two gives the same picture to the bit (point lights scaled by its square): no epsilon is hidden
// anywhere between the camera and the film.
#include "scenes.h"

#include "film/film.h"
#include "transport/render_pass.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// `k` times as large. Turns stay, lengths are multiplied.
Scene room(double k) {
    auto const f = static_cast<float>(k);
    Mat4 const grow = scale(k, k, k);
    Mat4 const shrink = scale(1 / k, 1 / k, 1 / k);
    auto const place = [&](Mat4 const& m) { return grow * m * shrink; };
    auto const sized = [&](TriangleMesh m) {
        for (Vec3& p : m.p) p *= f;
        return m;
    };
    Scene s;
    s.files = {"room.pbrt"};
    s.camera.kind = PerspectiveCamera{.fov = 0.9f, .lens_radius = 0.01f * f, .focal_distance = 5 * f};
    s.camera.to_world = place(*inverse(*look_at({0.5, -6, 2.5}, {0, 0, 1}, {0, 0, 1})));
    MaterialId const grey = diffuse(s);
    MaterialId const red = diffuse(s, RgbAlbedoSpd{{0.7f, 0.2f, 0.1f}});
    MaterialId const glass = s.add(Material{DielectricMaterial{NamedSpd{"glass-BK7"}}, "", {}});
    MaterialId const pane = s.add(Material{ThinDielectricMaterial{}, "", {}});
    TextureId const eta =
        s.add(Texture{ConstantSpectrumTexture{NamedSpd{"metal-Cu-eta"}, SpectrumRole::Unbounded}, {}});
    TextureId const kk =
        s.add(Texture{ConstantSpectrumTexture{NamedSpd{"metal-Cu-k"}, SpectrumRole::Unbounded}, {}});
    MaterialId const copper = s.add(Material{ConductorMaterial{eta, kk, {}}, "", {}});
    TextureId const t1 = s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.2f}}, {}});
    TextureId const t2 = s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.8f}}, {}});
    CheckerboardTexture checks;
    checks.mapping = UvMapping{8, 8, 0, 0};
    checks.tex1 = t1, checks.tex2 = t2;
    MaterialId const floor = s.add(Material{DiffuseMaterial{s.add(Texture{checks, {}})}, "", {}});
    auto const add = [&](Shape shape, MaterialId m, Mat4 const& to = {}) -> Object& {
        s.world().objects.push_back(object(std::move(shape), m, place(to)));
        return s.world().objects.back();
    };
    add(sized(square(4, 0)), floor);
    add(Quad{Vec3{-4, 4, 0} * f, Vec3{8, 0, 0} * f, Vec3{0, 0, 6} * f}, red);
    add(Sphere{0.7f * f, -0.7f * f, 0.7f * f}, glass, translate(-1.2, -1, 0.7));
    add(sized(icosphere(2, 0.6f)), glass, translate(0.3, -1.5, 0.6));
    add(Box{Vec3{-0.5f} * f, Vec3{0.5f} * f}, copper, translate(1.6, 0, 0.5) * *rotate(30, 0, 0, 1));
    // Walks between layers have numbers of the place.
    CoatedDiffuseMaterial lacquer{s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.6f}}, {}}), {}};
    lacquer.coat.model = CoatModel::Stochastic;
    add(Cylinder{0.3f * f, 0, 1.2f * f}, s.add(Material{lacquer, "", {}}), translate(-2, 1, 0));
    add(BilinearMesh{.p = {Vec3{-1, 0, 0} * f, Vec3{1, 0, 0} * f, Vec3{-1, 0.3f, 1} * f,
                           Vec3{1, -0.3f, 1} * f},
                     .patches = {{0, 1, 2, 3}}},
        pane, translate(0, -2.5, 0.2));
    add(sized(square(0.6f, 0)), grey, translate(0.5, 0.5, 4) * *rotate(180, 1, 0, 0)).light = emission(8);
    add(Sphere{0.2f * f, -0.2f * f, 0.2f * f}, grey, translate(2.5, -1, 2)).light = emission(10);
    add(Disk{.height = 0, .radius = 0.4f * f}, grey, translate(-2.5, 0, 3) * *rotate(160, 1, 0, 0)).light =
        emission(6);
    GroupId const tree = s.add(Group{.name = "tree"});
    s.groups[tree.value].objects.push_back(object(sized(cube(0.2f)), red));
    s.groups[tree.value].objects.push_back(object(Sphere{0.25f * f, -0.25f * f, 0.25f * f}, grey,
                                                  place(translate(0, 0, 0.4) * scale(1, 1, 0.5))));
    Object bulb = object(sized(icosphere(1, 0.05f)), grey, place(translate(0, 0, 0.7)));
    bulb.light = emission(20);
    s.groups[tree.value].objects.push_back(bulb);
    for (int i = 0; i < 5; ++i)
        s.world().instances.push_back(
            {.group = tree,
             .to_parent = rows_of(place(translate(-2 + i, 2.5, 0.2) * *rotate(17 * i, 0, 0, 1)))});
    s.add(Light{PointLight{.scale = 20 * f * f, .from = Vec3{-3, -3, 4} * f}, Mat4{}, {}});
    s.add(Light{SpotLight{.scale = 30 * f * f, .from = Vec3{3, -3, 5} * f, .to = Vec3{0, 0, 0}}, Mat4{}, {}});
    s.add(Light{DistantLight{.scale = 0.5f, .from = {1, 1, 3}, .to = {0, 0, 0}}, Mat4{}, {}});
    s.add(Light{InfiniteLight{.scale = 0.3f}, Mat4{}, {}});
    s.settings.film.resolution = {40, 30};
    s.settings.film.aovs = true;
    return s;
}

/// Radii are automatic.
PhotonMapIntegrator gathering() {
    PhotonMapIntegrator p;
    p.shooting.global_paths = 2000;
    p.gather_samples = 2;
    return p;
}
SppmIntegrator progressive() {
    SppmIntegrator p;
    p.shooting.global_paths = 2000;
    return p;
}

Film render(double k, ColorMode color, Integrator const& integrator) {
    Scene s = room(k);
    s.settings.color = color;
    s.settings.integrator = integrator;
    s.settings.spp = 1;
    World const world = compile(std::move(s));
    RenderJob const job(world, world.scene().settings);
    Film film = job.make_film();
    RayStats stats;
    for (std::uint64_t i = 0; i < 4; ++i) render_pass(job, i, film, stats);
    CHECK(stats.rejected == 0);
    CHECK(film.dropped() == 0);
    return film;
}

}  // namespace

TEST_CASE("a scene scaled by a power of two gives the same bits") {
    std::vector<Integrator> const integrators{PathIntegrator{.max_depth = 8}, DirectIntegrator{},
                                              WhittedIntegrator{}, gathering(), progressive()};
    for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral})
        for (std::size_t i = 0; i < integrators.size(); ++i) {
            Film const one = render(1, color, integrators[i]);
            double sum = 0;
            for (int y = 0; y < one.height(); ++y)
                for (int x = 0; x < one.width(); ++x) sum += one.pixel(x, y).rgb[1];
            CHECK(sum > 100);
            for (double const k : {0x1p-13, 0x1p20}) {
                CAPTURE(k);
                CAPTURE(i);
                Film const other = render(k, color, integrators[i]);
                int pixels = 0;
                int layers = 0;
                for (int y = 0; y < one.height(); ++y)
                    for (int x = 0; x < one.width(); ++x) {
                        if (std::memcmp(&one.pixel(x, y), &other.pixel(x, y), sizeof(PixelSums)) != 0)
                            ++pixels;
                        AovSums const& a = one.aov(x, y);
                        AovSums const& b = other.aov(x, y);
                        if (a.albedo != b.albedo || a.shading_normal != b.shading_normal ||
                            a.geometric_normal != b.geometric_normal || a.material != b.material ||
                            a.depth * k != b.depth || a.position[0] * k != b.position[0])
                            ++layers;
                    }
                CHECK(pixels == 0);
                CHECK(layers == 0);
            }
        }
}
