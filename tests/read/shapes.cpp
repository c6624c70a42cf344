// Shapes and lights: parameters and defaults.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {
float match_power(LightKind const& kind) {
    if (auto const* spot = std::get_if<SpotLight>(&kind)) return spot->power;
    return std::get<PointLight>(kind).power;
}
}  // namespace

TEST_CASE("quadrics") {
    auto const scene = read_world(R"(
        Shape "sphere" "float radius" 2 "float phimax" 90
        Shape "sphere" "float radius" 2 "float zmin" 5 "float zmax" -1
        Shape "cylinder"
        Shape "disk" "float height" 3 "float innerradius" 0.5)");
    auto const& s = shape_of<Sphere>(scene, 0);
    CHECK(s.radius == 2);
    CHECK(s.z_min == -2);
    CHECK(s.z_max == 2);
    CHECK(s.phi_max == doctest::Approx(kPiOver2));
    CHECK(shape_of<Sphere>(scene, 1).z_min == -1);
    CHECK(shape_of<Sphere>(scene, 1).z_max == 2);
    auto const& c = shape_of<Cylinder>(scene, 2);
    CHECK(c.radius == 1);
    CHECK(c.z_min == -1);
    CHECK(c.z_max == 1);
    CHECK(c.phi_max == kTwoPi);
    auto const& d = shape_of<Disk>(scene, 3);
    CHECK(d.height == 3);
    CHECK(d.radius == 1);
    CHECK(d.inner_radius == 0.5f);
}

TEST_CASE("triangle meshes") {
    auto const scene = read_world(R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 0] "integer indices" [0 1 2 1 3 2])");
    CHECK(shape_of<TriangleMesh>(scene, 0).triangles == std::vector<Vec3i>{{0, 1, 2}});
    CHECK(shape_of<TriangleMesh>(scene, 1).triangles == std::vector<Vec3i>{{0, 1, 2}, {1, 3, 2}});
    CHECK(shape_of<TriangleMesh>(scene, 1).p[3] == Vec3{1, 1, 0});
    std::string const square = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n";
    CHECK(contains(error_in_world(square), "needs \"integer indices\""));
    CHECK(contains(error_in_world(square + "\"integer indices\" [0 1 4]"),
                   "t.pbrt:3: Shape \"trianglemesh\": \"indices\": 4 is not a point; there are 4"));
    CHECK(contains(error_in_world(square + "\"integer indices\" [0 1 -1]"), "-1 is not a point"));
    auto const excess = read_world(square + "\"integer indices\" [0 1 2 3]");
    CHECK(shape_of<TriangleMesh>(excess).triangles.size() == 1);
    CHECK(contains(notes(excess), "4 entries are not a multiple of 3: the last ones are dropped"));
    CHECK(contains(error_in_world("Shape \"trianglemesh\""), "needs \"point3 P\""));
    auto const short_uv = read_world(square + "\"integer indices\" [0 1 2] \"point2 uv\" [0 0]");
    CHECK(shape_of<TriangleMesh>(short_uv).uv.empty());
    CHECK(contains(notes(short_uv), "\"uv\" has 1 entries for 4 points, and is dropped"));
}

TEST_CASE("patches, subdivision, and shapes of our own") {
    auto const scene = read_world(R"(
        Shape "bilinearmesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 0]
        Shape "loopsubdiv" "integer levels" 2 "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]
        Shape "box" "point3 lo" [1 0 0] "point3 hi" [0 2 3]
        Shape "quad")");
    CHECK(shape_of<BilinearMesh>(scene, 0).patches == std::vector<std::array<int, 4>>{{0, 1, 2, 3}});
    CHECK(shape_of<LoopSubdivision>(scene, 1).levels == 2);
    CHECK(shape_of<Box>(scene, 2).lo == Vec3{0, 0, 0});
    CHECK(shape_of<Box>(scene, 2).hi == Vec3{1, 2, 3});
    CHECK(shape_of<Quad>(scene, 3).edge_u == Vec3{2, 0, 0});
    CHECK(contains(error_in_world("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]"),
                   "needs \"integer indices\" unless it has just 4 points"));
}

TEST_CASE("unknown shapes are left out") {
    auto const scene = read_world("Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]\nShape \"spere\"");
    CHECK(scene.world().objects.empty());
    CHECK(contains(notes(scene), "t.pbrt:2: Shape \"curve\": is not rendered yet: left out"));
    CHECK(contains(notes(scene),
                   "t.pbrt:3: Shape \"spere\": is an unknown shape: left out (did you mean \"sphere\"?)"));
}

TEST_CASE("alpha") {
    auto const scene = read_world(R"(Shape "sphere" "float alpha" 1
        Shape "sphere" "float alpha" 0
        Shape "curve" "texture alpha" "a"
        Shape "sphere" "texture alpha" "a"
        Texture "a" "float" "constant" "float value" 0.5
        AreaLightSource "diffuse" Shape "sphere" "float alpha" 0)");
    auto const& o = scene.world().objects;
    REQUIRE(o.size() == 3);
    CHECK_FALSE(o[0].alpha.valid());
    CHECK(texture_of<ConstantFloatTexture>(scene, o[1].alpha).value == 0.5f);
    CHECK(texture_of<ConstantFloatTexture>(scene, o[2].alpha).value == 0);
    CHECK_FALSE(contains(notes(scene), "alpha"));
    CHECK(error_in_world("Shape \"sphere\"\n \"texture alpha\" \"nope\"") ==
          "t.pbrt:3: no float texture \"nope\" is defined");
}

TEST_CASE("lights") {
    auto const scene = read_world(R"(
        Translate 1 2 3
        LightSource "point" "rgb I" [1 2 3] "float scale" 4 "float power" 5 "point3 from" [6 7 8]
        LightSource "spot" "point3 to" [1 0 0] "float coneangle" 60 "float conedeltaangle" 30
        LightSource "distant" "float illuminance" 9
        LightSource "infinite" "string filename" "/sky.exr" "string mapping" "latlong" "float scale" 2
        LightSource "infinite" "blackbody L" 5000
        LightSource "projection" "string filename" "/slide.png" "float fov" 40 "float power" 40
        LightSource "goniometric" "string filename" "/lamp.exr" "blackbody I" 3000 "float scale" 3)");
    REQUIRE(scene.lights.size() == 7);
    auto const& p = as<PointLight>(scene.lights[0].kind);
    CHECK(as<RgbIlluminantSpd>(p.intensity).rgb == Vec3{1, 2, 3});
    CHECK(p.scale == 4);
    CHECK(p.power == 5);
    CHECK(p.from == Vec3{6, 7, 8});
    CHECK(scene.lights[0].to_world.m[2][3] == 3);
    auto const& s = as<SpotLight>(scene.lights[1].kind);
    CHECK(s.to == Vec3{1, 0, 0});
    CHECK(s.cone_angle == doctest::Approx(kPi / 3));
    CHECK(s.cone_delta == doctest::Approx(kPi / 6));
    CHECK(s.power == -1);
    CHECK(as<DistantLight>(scene.lights[2].kind).illuminance == 9);
    CHECK(as<DistantLight>(scene.lights[2].kind).to == Vec3{0, 0, 1});
    auto const& sky = as<InfiniteLight>(scene.lights[3].kind);
    CHECK(scene[sky.image].path == "/sky.exr");
    CHECK(sky.mapping == EnvironmentMapping::LatLong);
    CHECK(sky.scale == 2);
    CHECK(as<BlackbodySpd>(as<InfiniteLight>(scene.lights[4].kind).radiance).kelvin == 5000);
    auto const& slide = as<ProjectionLight>(scene.lights[5].kind);
    CHECK(scene[slide.image].path == "/slide.png");
    CHECK(slide.fov == doctest::Approx(40 * kPi / 180));
    CHECK(slide.power == 40);
    auto const& lamp = as<GoniometricLight>(scene.lights[6].kind);
    CHECK(scene[lamp.image].path == "/lamp.exr");
    CHECK(as<BlackbodySpd>(lamp.intensity).kelvin == 3000);
    CHECK(lamp.scale == 3);
    CHECK(notes(scene).empty());
    CHECK(contains(error_in_world("LightSource \"goniometric\""),
                   "it needs a \"filename\" of a square equal-area"));
    CHECK(contains(error_in_world("LightSource \"projection\""), "it needs a \"filename\" of a picture"));
    CHECK(
        contains(error_in_world("LightSource \"projection\" \"string filename\" \"a.png\" \"float fov\" 180"),
                 "\"fov\" must be above 0 and below 180"));

    CHECK(contains(error_in_world("LightSource \"infinite\" \"rgb L\" [1 1 1] \"string filename\" \"a.exr\""),
                   "not both"));
    CHECK(contains(error_in_world("LightSource \"spot\" \"point3 to\" [0 0 0]"), "it has no direction"));
    CHECK(contains(error_in_world("LightSource \"spott\""), "did you mean \"spot\"?"));
    CHECK(contains(error_in_world("LightSource \"point\" \"blackbody I\" 0"), "must be above 0 K"));
}

TEST_CASE("power and illuminance of 0 are none, as in pbrt") {
    for (char const* text : {"\"point\" \"float power\" 0", "\"spot\" \"float power\" 0"}) {
        auto const scene = read_world("LightSource " + std::string(text));
        auto const power = match_power(scene.lights.at(0).kind);
        CHECK(power == -1);
        CHECK(contains(notes(scene), "t.pbrt:2: LightSource"));
        CHECK(contains(notes(scene), "\"power\" is not above 0 and counts as not given"));
    }
    auto const sun = read_world("LightSource \"distant\" \"float illuminance\" 0");
    CHECK(as<DistantLight>(sun.lights.at(0).kind).illuminance == -1);
    CHECK(notes(read_world("LightSource \"point\"")).empty());
}

TEST_CASE("power of a mesh is that of all its faces, and said to be") {
    std::string const light = "AreaLightSource \"diffuse\" \"float power\" 5\n";
    std::string const points =
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"integer indices\" ";
    CHECK(contains(notes(read_world(light + points + "[0 1 2 1 2 3]")),
                   "t.pbrt:3: the light's \"power\" is that of"));
    CHECK(notes(read_world(light + points + "[0 1 2]")).empty());
    CHECK(notes(read_world("AreaLightSource \"diffuse\"\n" + points + "[0 1 2 1 2 3]")).empty());
}

TEST_CASE("a spot's falloff is at most its cone") {
    auto const scene = read_world("LightSource \"spot\" \"float coneangle\" 10 \"float conedeltaangle\" 20");
    auto const& spot = as<SpotLight>(scene.lights.at(0).kind);
    CHECK(spot.cone_delta == spot.cone_angle);
    CHECK(contains(notes(scene), "t.pbrt:2: LightSource \"spot\": \"conedeltaangle\" is above"));
    validate(scene);
}

TEST_CASE("shapes without area are skipped with a note") {
    auto scene = read_world(R"(Shape "sphere" "float radius" 0
        Shape "sphere" "float zmin" 2 "float zmax" 3
        Shape "cylinder" "float radius" 0
        Shape "disk" "float radius" 0
        Shape "quad" "vector3 u" [0 0 0]
        AreaLightSource "diffuse" Shape "disk" "float phimax" 0)");
    CHECK(scene.world().objects.size() == 6);
    drop_degenerate(scene);
    CHECK(scene.world().objects.empty());
    CHECK(scene.notes.size() == 6);
    CHECK(contains(notes(scene), "t.pbrt:2: the object has no area: object skipped"));
    validate(scene);
    CHECK(contains(error_in_world("Shape \"sphere\" \"float radius\" -1"), "must not be negative"));
}

TEST_CASE("a transform that overflows is said to") {
    auto scene = read_world("Scale 1e30 1e30 1e30 Scale 1e30 1e30 1e30\nShape \"sphere\"");
    drop_degenerate(scene);
    CHECK(contains(error_of([&] { validate(scene); }), "t.pbrt:3: the object's transform overflows"));
}

TEST_CASE("area lights") {
    auto const scene = read_world(
        R"(AreaLightSource "diffuse" "rgb L" [3 2 1] "float scale" 2 "float power" 7 "bool twosided" true
        Shape "sphere"
        AreaLightSource "diffuse" "string filename" "/e.png" Shape "sphere"
        Material "interface" Shape "sphere")");
    auto const& l = *scene.world().objects[0].light;
    CHECK(as<RgbIlluminantSpd>(l.radiance).rgb == Vec3{3, 2, 1});
    CHECK(l.scale == 2);
    CHECK(l.power == 7);
    CHECK(l.two_sided);
    CHECK(scene.locate(l.where) == "t.pbrt:2");
    CHECK(scene[scene.world().objects[1].light->image].path == "/e.png");
    // pbrt: interfaces do not emit
    CHECK_FALSE(scene.world().objects[2].light.has_value());
    CHECK(contains(notes(scene), "t.pbrt:5: a surface of \"interface\" does not emit"));
    CHECK(contains(error_in_world("AreaLightSource \"area\""), "in pbrt-v4 it is \"diffuse\""));
}
