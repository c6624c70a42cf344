// Skies, suns, spots and points over unoccluded Lambertian surfaces.
#include "image/write.h"
#include "measure.h"
#include "scenes.h"

#include <filesystem>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Scene plane(float reflectance) {
    Scene s;
    add(s, floor_quad(10), diffuse(s, reflectance));
    look_at_point(s, {0.3f, 0.1f, 1}, {0, 0, 0});
    return s;
}

}  // namespace

TEST_CASE("constant sky over a Lambertian plane and a convex body: L = rho") {
    Scene scene = plane(0.5f);
    scene.add(sky());
    World const flat = compile(scene);
    Scene ball;
    add(ball, Sphere{}, diffuse(ball, 0.5f));
    ball.add(sky());
    look_parallel(ball, {0, 0, 3}, {0, 0, -1}, 0.65f);
    World const round = compile(ball);
    for (Integrator const& i : one_bounce()) {
        check_mean(flat, settings(i), 64, 0.5);
        check_mean(round, settings(i), 64, 0.5);
    }
    Settings s = settings(path(1));
    s.color = ColorMode::Spectral;
    check_mean(flat, s, 64, 0.5);
}

TEST_CASE("a sky's illuminance is its irradiance on a facing surface") {
    // A hemisphere of radiance 1 irradiates with pi; asked for 1 lx, a white plane shows 1 / pi.
    Scene scene = plane(1);
    InfiniteLight l;
    l.illuminance = 1;
    scene.add(Light{l, {}, {}});
    check_mean(compile(scene), settings(path(1)), 64, 0.318309886);
}

TEST_CASE("a distant light falls off with the cosine") {
    for (float angle : {0.0f, 30.0f, 60.0f, 80.0f}) {
        Scene scene = plane(0.5f);
        DistantLight l;
        l.from = {std::sin(radians(angle)), 0, std::cos(radians(angle))};
        l.to = {0, 0, 0};
        l.scale = 2;
        scene.add(Light{l, {}, {}});
        World const world = compile(scene);
        double const expected =
            0.5 / static_cast<double>(kPi) * 2 * static_cast<double>(std::cos(radians(angle)));
        for (Integrator const& i :
             {Integrator{DirectIntegrator{1}}, Integrator{path(3)}, Integrator{WhittedIntegrator{1}}})
            check_mean(world, settings(i), 4, expected);
        check_mean(world, settings(naive(path(3))), 4, 0.0);
    }
}

TEST_CASE(
    "a spot: full in the middle, smooth at the edge, nothing outside; a point light: the square of the "
    "distance") {
    Scene scene = plane(0.5f);
    SpotLight l;
    l.from = {0, 0, 2};
    l.to = {0, 0, 0};
    l.scale = 3;
    scene.add(Light{l, {}, {}});
    auto const at = [&](float x, double intensity) {
        Scene s = scene;
        look_at_point(s, {x + 0.1f, 0, 0.5f}, {x, 0, 0});
        double const d2 = static_cast<double>(x) * static_cast<double>(x) + 4;
        double const expected = 0.5 / static_cast<double>(kPi) * intensity / d2 * 2 / std::sqrt(d2);
        for (Integrator const& i :
             {Integrator{DirectIntegrator{1}}, Integrator{path(3)}, Integrator{WhittedIntegrator{1}}})
            check_mean(compile(s), settings(i), 4, expected);
    };
    at(0, 3);
    at(2 * std::tan(radians(20)), 3);
    at(2 * std::tan(radians(31)), 0);
    // Half way between the cones in cosine: smoothstep(1/2) = 1/2.
    float const middle = std::acos(0.5f * (std::cos(l.cone_angle) + std::cos(l.cone_angle - l.cone_delta)));
    at(2 * std::tan(middle), 1.5);
    scene.lights.clear();
    scene.add(point_light({0, 0, 2}, 3));
    at(0, 3);
    at(1.5f, 3);
}

TEST_CASE("an environment picture of one colour is a constant sky") {
    auto const folder = std::filesystem::temp_directory_path() / "nephroid-transport-sky";
    std::filesystem::create_directories(folder);
    for (EnvironmentMapping const mapping : {EnvironmentMapping::EqualArea, EnvironmentMapping::LatLong}) {
        bool const square = mapping == EnvironmentMapping::EqualArea;
        Image image(PixelFormat::Float, square ? 8 : 16, 8, {"R", "G", "B"});
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                for (int c = 0; c < 3; ++c) image.set(x, y, c, 0.25f);
        auto const file = folder / (square ? "square.pfm" : "long.pfm");
        write_pfm(file, image);
        Scene scene = plane(0.5f);
        InfiniteLight l;
        l.mapping = mapping;
        l.scale = 4;
        l.image = scene.add(ImageFile{file.string(), "", {}});
        scene.add(Light{l, rotation(70, 1, 0, 0), {}});
        World const world = compile(scene);
        for (Integrator const& i : one_bounce()) check_mean(world, settings(i), 64, 0.5);
        Settings s = settings(path(1));
        s.color = ColorMode::Spectral;
        check_mean(world, s, 64, 0.5);
    }
    std::filesystem::remove_all(folder);
}
