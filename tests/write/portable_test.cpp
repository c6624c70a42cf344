// --portable: only pbrt-v4's own, read without a note, and of the same shape.
#include "everything.h"
#include "support.h"

#include <array>

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("a portable scene of everything has pbrt-v4's words only, and is read without a note") {
    Folder const folder;
    Scene s = Everything().s;
    for (Integrator const& i :
         std::vector<Integrator>{PathIntegrator{}, WhittedIntegrator{}, DirectIntegrator{},
                                 PhotonMapIntegrator{}, SppmIntegrator{}, LightPathIntegrator{}}) {
        s.settings.integrator = i;
        auto const replaced = write_pbrt(s, folder / "out.pbrt", {.portable = true});
        Scene const back = read_scene(folder / "out.pbrt");
        CHECK(notes(back) == "");
        validate(back);
        auto const text = contents(folder / "out.pbrt");
        for (char const* ours : {"\"box\"",
                                 "\"quad\"",
                                 "\"plastic\"",
                                 "\"ashikhminshirley\"",
                                 "\"metallicroughness\"",
                                 "\"sunsky\"",
                                 ".ies",
                                 "\"photonmap\"",
                                 "\"whitted\"",
                                 "\"direct\"",
                                 "priority",
                                 "\"float absorption",
                                 ".radians",
                                 "\"string inverse",
                                 "srgb-acesd60",
                                 "Option \"string color\"",
                                 "multiscatter",
                                 "distribution",
                                 "\"string layers",
                                 "roulette",
                                 "shapesampling",
                                 "normalscale",
                                 "\"float reflectance",
                                 "\"float value\" 0.15",
                                 "mapping\" \"latlong"}) {
            CAPTURE(ours);
            CHECK(text.find(ours) == std::string::npos);
        }
        CHECK(replaced.size() >= 12);
        for (Note const& n : replaced) CHECK(!n.text.empty());
        CHECK(back.lights.size() == s.lights.size() - 1);  // the daylight
        // What absorbs is a medium, for which the path tracer has another name.
        CHECK(text.find("MakeNamedMedium") != std::string::npos);
        CHECK((text.find("Integrator \"path\"") == std::string::npos));
        auto const* glass = std::get_if<DielectricMaterial>(&back[back.world().objects[1].material].kind);
        REQUIRE(glass);
        auto const* absorbs = std::get_if<RgbUnboundedSpd>(&glass->interior.absorption);
        REQUIRE(absorbs);
        CHECK(absorbs->rgb == Vec3{0.5f, 1.5f, 2.5f});
    }
}

TEST_CASE("a portable scene of pbrt-v4's own things is the same scene") {
    Folder const folder;
    Scene s;
    s.settings.film.resolution = {32, 32};
    MaterialId const red = s.add(
        Material{DiffuseMaterial{s.add(Texture{ConstantSpectrumTexture{RgbAlbedoSpd{{0.8f, 0.1f, 0.1f}}}})}});
    s.world().objects.push_back({.shape = Sphere{}, .material = red});
    s.add(Light{PointLight{.from = {1, 2, 3}}});
    CHECK(write_pbrt(s, folder / "out.pbrt", {.portable = true}).empty());
    Scene const back = read_scene(folder / "out.pbrt");
    CHECK(hash(back) == hash(s));
    CHECK(hash(back.settings) == hash(s.settings));
}

TEST_CASE("a box becomes patches that lie on it and look outwards, a quad one that looks the same way") {
    Folder const folder;
    Scene s;
    MaterialId const gray =
        s.add(Material{DiffuseMaterial{s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.5f}}})}});
    Box const box{{-1, -2, -3}, {1, 3, 5}};
    Quad const quad{{1, 2, 3}, {0.5f, 0, 0.25f}, {0, 3, 1}};
    s.world().objects.push_back({.shape = box, .material = gray});
    s.world().objects.push_back({.shape = quad, .material = gray});
    Scene const back = there_and_back(s, folder / "out.pbrt", true);
    auto const& m = std::get<BilinearMesh>(back.world().objects[0].shape);
    REQUIRE(m.patches.size() == 6);
    Vec3 const centre = 0.5f * (box.lo + box.hi);
    double area = 0;
    auto const normal_of = [](BilinearMesh const& mesh, std::array<int, 4> const& q) {
        auto const p = [&](std::size_t k) { return mesh.p[static_cast<std::size_t>(q[k])]; };
        CHECK(p(0) + p(3) == p(1) + p(2));
        return cross(p(1) - p(0), p(2) - p(0));
    };
    for (auto const& q : m.patches) {
        Vec3 const n = normal_of(m, q);
        Vec3 const middle =
            0.5f * (m.p[static_cast<std::size_t>(q[0])] + m.p[static_cast<std::size_t>(q[3])]);
        CHECK(dot(n, middle - centre) > 0);
        area += static_cast<double>(length(n));
    }
    CHECK(area == doctest::Approx(2 * (2 * 5 + 5 * 8 + 8 * 2)));
    auto const& one = std::get<BilinearMesh>(back.world().objects[1].shape);
    CHECK(normal_of(one, one.patches[0]) == cross(quad.edge_u, quad.edge_v));
}

TEST_CASE("the power of a mesh becomes the radiance of its faces") {
    Folder const folder;
    Scene s;
    MaterialId const gray =
        s.add(Material{DiffuseMaterial{s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.5f}}})}});
    s.world().objects.push_back({.shape = Box{{0, 0, 0}, {1, 2, 3}},
                                 .to_group = scale(2, 2, 2),
                                 .material = gray,
                                 .light = AreaLight{.scale = 3, .power = 100}});
    Scene const back = there_and_back(s, folder / "out.pbrt", true);
    auto const& light = *back.world().objects[0].light;
    CHECK(light.power == -1);
    CHECK(static_cast<double>(light.scale) == doctest::Approx(3 * 100 / (3.14159265 * 4 * 22)));
}
