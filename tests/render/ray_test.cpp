// What .ray scenes look like, in numbers: radiances that those programs would have shown, and those of our models behind them.
#include <doctest/doctest.h>

#include "films.h"
#include "statistics.h"

#include <unistd.h>
#include <filesystem>
#include <fstream>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Scene ray_scene(std::string const& text) {
    auto const path =
        std::filesystem::temp_directory_path() / ("nephroid-ray-" + std::to_string(getpid()) + ".ray");
    std::ofstream(path) << "SBT-raytracer 1.1\n" << text;
    Scene scene = read_scene(path);
    std::filesystem::remove(path);
    return scene;
}

/// The radiance in the middle, seen along -z from (0, 0, 5).
Vec3 seen(std::string const& text, std::uint64_t passes = 64) {
    Scene scene =
        ray_scene("camera { position = (0,0,5); viewdir = (0,0,-1); updir = (0,1,0); fov = 0.02 }\n" + text);
    scene.settings.film.resolution = {1, 1};
    scene.settings.filter = BoxFilter{};
    Settings const settings = scene.settings;
    World const world = compile(std::move(scene));
    Film const film = rendered(RenderJob(world, settings), {0, passes});
    auto const& p = film.pixel(0, 0);
    CHECK(film.dropped() == 0);
    auto const mean = [&](std::size_t c) { return static_cast<float>(p.rgb[c] / p.weight); };
    return {mean(0), mean(1), mean(2)};
}
void check(Vec3 found, Vec3 expected, double tolerance = 1e-4) {
    for (int c = 0; c < 3; ++c) CHECK(found[c] == doctest::Approx(double{expected[c]}).epsilon(tolerance));
}

std::string const kSquare =
    "scale(4, square { material = { diffuse = (0.2, 0.4, 0.6); ambient = (0.2, 0.4, 0.6) } })\n";

}  // namespace

TEST_CASE("a light of colour c shows a diffuse square that faces it as kd c") {
    check(seen(kSquare + "directional_light { direction = (0,0,-1); color = (1, 0.5, 0.25) }"),
          {0.2f, 0.2f, 0.15f});
    // ... times the cosine.
    check(seen(kSquare + "directional_light { direction = (3,0,-4); color = (1, 1, 1) }"),
          {0.16f, 0.32f, 0.48f});
    check(seen(kSquare + "ambient_light { color = (0.5, 1, 1) }", 4096), {0.1f, 0.4f, 0.6f}, 2e-3);
    check(seen(kSquare + "point_light { position = (0,0,2); color = (1,1,1) }"), {0.05f, 0.1f, 0.15f});
    check(seen(kSquare +
               "point_light { position = (0,0,2); color = (1,1,1); quadratic_attenuation_coeff = 0.5 }"),
          {0.1f, 0.2f, 0.3f});
    // The square is the scene, and its middle the scene's.
    check(seen(kSquare + "point_light { position = (0,0,2); color = (1,1,1); constant_attenuation_coeff = 1; "
                         "linear_attenuation_coeff = 0.5; quadratic_attenuation_coeff = 0.5 }"),
          {0.05f, 0.1f, 0.15f});
}

TEST_CASE("a light's attenuation makes nothing brighter than its colour") {
    std::string const light =
        "point_light { position = (0,0,4); color = (1,1,1); quadratic_attenuation_coeff = ";
    std::string const weak = light + "0.001 } ";
    check(seen(kSquare + weak + weak + light + "1 }", 4096), Vec3{0.2f, 0.4f, 0.6f} * (2 + 1.0f / 16), 1e-2);
}

TEST_CASE("an area light's ball lights as the point light; a parallelogram by its solid angle") {
    check(seen(kSquare + "area_light { position = (3,0,4); color = (1,1,1); light_radius = 0.3 }", 1024),
          Vec3{0.2f, 0.4f, 0.6f} * (0.8f / 25), 2e-3);
    // A small one of area A at distance d: kd L A cos cos / (pi d^2), here with both cosines 4/5.
    check(seen(kSquare + "area_light { position = (2.98,-0.02,4); u = (0,0.04,0); v = (0.04,0,0); color = "
                         "(100,100,100) }",
               1024),
          Vec3{0.2f, 0.4f, 0.6f} * (100 * 0.0016f * 0.64f / (kPi * 25)), 5e-3);
}

TEST_CASE("emission is seen as it is written, from both sides of a square") {
    check(seen("square { material = { emissive = (3, 2, 1) } }", 4), {3, 2, 1});
    check(seen("rotate(0,1,0,3.14159265, square { material = { emissive = (3, 2, 1) } })", 4), {3, 2, 1});
}

TEST_CASE("the highlight of a small light, head-on, is as bright as Phong's: ks c") {
    for (char const* shininess : {"20", "100", "0.4"}) {
        CAPTURE(shininess);
        auto const scene =
            std::string(
                "scale(4, square { material = { specular = (0.9,0.6,0.3); reflective = (0,0,0); "
                "shininess = ") +
            shininess + " } })\ndirectional_light { direction = (0,0,-1); color = (1,0.5,0.5) }";
        // The lobe is the only part, and all samples see it.
        check(seen(scene), {0.9f, 0.3f, 0.15f}, 1e-3);
    }
    // 20 degrees off the mirror direction, those programs have cos^n of that angle.
    auto const off = seen(
        "scale(4, square { material = { specular = (1,1,1); reflective = (0,0,0); shininess = 30 } })\n"
        "directional_light { direction = (0.34202,0,-0.93969); color = (1,1,1) }");
    CHECK(off.x == doctest::Approx(std::pow(0.93969, 30)).epsilon(0.08));
}

TEST_CASE("mirrors show what is behind the camera, by their share") {
    std::string const lamp = "translate(0,0,8, scale(20, square { material = { emissive = (1,2,3) } }))\n";
    check(seen(lamp + "scale(4, square { material = { reflective = (0.5,0.25,0.1) } })"), {0.5f, 0.5f, 0.3f},
          1e-3);
    // Half of the samples choose the mirror: the mean is the same. What is diffuse is black here.
    auto const mixed = seen(
        lamp + "scale(4, square { material = { reflective = (0.5,0.25,0.1); transmissive = (0.5,0,0) } })",
        4096);
    check(mixed, {0.5f, 0.5f, 0.3f}, 0.02);
}

TEST_CASE("what is transmissive lets light through: straight without an index, by Fresnel with one") {
    std::string const lamp = "translate(0,0,-3, scale(20, square { material = { emissive = (1,2,3) } }))\n";
    check(seen(lamp + "square { material = { transmissive = (0.5,0.25,0.1) } }"), {0.5f, 0.5f, 0.3f}, 1e-3);
    // A slab of index 1.5: two sides that reflect 4% each, and what goes to and fro between them. The tint counts at each side.
    auto const slab = [&](float tint) {
        float const r = 0.04f, t = 0.96f * tint;
        return t * t / (1 - r * r);
    };
    check(seen(lamp + "box { material = { transmissive = (1,1,1); index = 1.5 } }", 8192),
          Vec3{1, 2, 3} * slab(1), 0.01);
    check(seen(lamp + "box { material = { transmissive = (0.5,0.5,0.5); index = 1.5 } }", 8192),
          Vec3{1, 2, 3} * slab(0.5f), 0.03);
}

TEST_CASE("energy: under a white sky nothing is brighter than it") {
    for (char const* material :
         {"diffuse = (1,1,1); specular = (1,1,1); shininess = 20; transmissive = (1,1,1)",
          "diffuse = (1,1,1); specular = (1,1,1); shininess = 300; reflective = (1,1,1)",
          "specular = (1,1,1); shininess = 1.5; reflective = (0,0,0)",
          "transmissive = (1,1,1); index = 1.5"}) {
        CAPTURE(material);
        auto const c = seen(std::string("translate(0.3, 0.5, 0, sphere { material = { ") + material +
                                " } })\nambient_light { color = (1,1,1) }",
                            4096);
        CHECK(max_component(c) <= 1.001f);
        CHECK(max_component(c) > 0.1f);
    }
}
