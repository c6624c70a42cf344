// Parameter lists: types, counts, unknown names.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("one value stands with or without brackets") {
    CHECK(shape_of<Sphere>(read_world("Shape \"sphere\" \"float radius\" 2")).radius == 2);
    CHECK(shape_of<Sphere>(read_world("Shape \"sphere\" \"float radius\" [ 2 ]")).radius == 2);
    CHECK(shape_of<Sphere>(read_world("Shape \"sphere\" \"  float \t radius \" [2]")).radius == 2);
}

TEST_CASE("each type, by its names") {
    auto const scene = read_world(R"(
        Shape "quad" "point origin" [1 2 3] "vector u" [4 0 0] "vector3 v" [0 5 0]
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "normal N" [0 0 1 0 0 1 0 0 1] "point2 uv" [0 0 1 0 0 1]
        Shape "trianglemesh" "point P" [0 0 0 1 0 0 0 1 0] "normal3 N" [0 0 1 0 0 1 0 0 1]
        AreaLightSource "diffuse" "bool twosided" true
        Shape "sphere"
        AreaLightSource "diffuse" "bool twosided" "false" "blackbody L" 3000
        Shape "sphere")");
    auto const& q = shape_of<Quad>(scene);
    CHECK(q.origin == Vec3{1, 2, 3});
    CHECK(q.edge_u == Vec3{4, 0, 0});
    CHECK(q.edge_v == Vec3{0, 5, 0});
    CHECK(shape_of<TriangleMesh>(scene, 1).n.size() == 3);
    CHECK(shape_of<TriangleMesh>(scene, 1).uv[1] == Vec2{1, 0});
    CHECK(shape_of<TriangleMesh>(scene, 2).n.size() == 3);
    CHECK(scene.world().objects[3].light->two_sided);
    CHECK_FALSE(scene.world().objects[4].light->two_sided);
    CHECK(as<BlackbodySpd>(scene.world().objects[4].light->radiance).kelvin == 3000);
    CHECK(notes(scene).empty());
}

TEST_CASE("spectra: pairs, names, files") {
    Folder const folder;
    folder.write("s/a.spd", "# comment\n400 1\n500 2 # more\r\n\n600 3");
    auto const spd = [&](std::string const& value) {
        auto const scene = read_pbrt_string("WorldBegin LightSource \"point\" \"spectrum I\" " + value,
                                            "t.pbrt", folder.path());
        return as<PointLight>(scene.lights[0].kind).intensity;
    };
    CHECK(as<TabulatedSpd>(spd("[400 1 500 2]")).lambda == std::vector<float>{400, 500});
    CHECK(as<TabulatedSpd>(spd("[400 1 500 2]")).value == std::vector<float>{1, 2});
    CHECK(as<NamedSpd>(spd("\"stdillum-D65\"")).name == "stdillum-D65");
    CHECK(as<TabulatedSpd>(spd("\"s/a.spd\"")).lambda == std::vector<float>{400, 500, 600});
    CHECK(as<TabulatedSpd>(spd("\"s/a.spd\"")).value == std::vector<float>{1, 2, 3});

    auto const fails = [&](std::string const& value) { return error_of([&] { spd(value); }); };
    CHECK(fails("[400 1 500]") ==
          "t.pbrt:1: parameter \"spectrum I\" has 3 values, which is not a multiple of 2");
    CHECK(contains(fails("[500 1 400 2]"), "t.pbrt:1: parameter \"spectrum I\": wavelengths must increase"));
    CHECK(contains(fails("[500 \"x\"]"), "either finite numbers or a quoted name"));
    CHECK(contains(fails("\"stdillum-D66\""), "did you mean \"stdillum-D65\"?"));
    CHECK(contains(fails("[\"stdillum-D65\" \"glass-BK7\"]"), "needs 1 values, not 2"));
    auto const bad_file = [&](std::string const& text) {
        folder.write("bad.spd", text);
        auto const message = fails("\"bad.spd\"");
        return message.substr(message.rfind("bad.spd"));
    };
    CHECK(bad_file("") == "bad.spd: no samples; lines are `wavelength value`");
    CHECK(bad_file("400 1\n500") == "bad.spd:2: the last wavelength has no value");
    CHECK(bad_file("400 nan") == "bad.spd:1: \"nan\" is not a finite number; lines are `wavelength value`");
    CHECK(bad_file("500 1\n400 1") == "bad.spd:2: wavelengths must increase");
    CHECK(contains(bad_file("# nothing\n"), "no samples"));
}

TEST_CASE("wrong types and counts name the line") {
    CHECK(error_in_world("Shape \"sphere\"\n\"float radius\" \"x\"") ==
          "t.pbrt:3: parameter \"float radius\": \"x\" is not a finite number");
    CHECK(error_in_world("Shape \"sphere\" \"integer radius\" 1") ==
          "t.pbrt:2: Shape \"sphere\": parameter \"radius\" is a \"integer\"; it must be a \"float\"");
    CHECK(error_in_world("Shape \"sphere\" \"float radius\" [1 2]") ==
          "t.pbrt:2: Shape \"sphere\": parameter \"radius\" needs 1 value, not 2");
    CHECK(error_in_world("Shape \"sphere\" \"float radius\" []") ==
          "t.pbrt:2: parameter \"float radius\" has no value");
    CHECK(error_in_world("Material \"diffuse\" \"rgb reflectance\" [1 1]") ==
          "t.pbrt:2: parameter \"rgb reflectance\" has 2 values, which is not a multiple of 3");
    CHECK(contains(error_in_world("Material \"diffuse\" \"rgb reflectance\" [1 1 1 1 1 1]"),
                   "needs 3 values, not 6"));
    CHECK(contains(error_in_world("Shape \"sphere\" \"radius\" 1"),
                   "t.pbrt:2: \"radius\": a parameter is declared as"));
    CHECK(
        contains(error_in_world("Shape \"sphere\" \"flout radius\" 1"), "\"flout\" is not a parameter type"));
    CHECK(contains(error_in_world("Material \"diffuse\" \"color Kd\" [1 1 1]"),
                   "is of pbrt-v3; in pbrt-v4 it is \"rgb\""));
    CHECK(contains(error_in_world("LightSource \"point\" \"blackbody I\" [3000 2]"),
                   "two values as in pbrt-v3"));
    CHECK(contains(error_in_world("AreaLightSource \"diffuse\" \"bool twosided\" 1"),
                   "1 is not true or false"));
    CHECK(contains(error_in_world("LightSource \"point\" \"rgb I\" [-1 0 0]"),
                   "t.pbrt:2: parameter \"rgb I\" has a negative component"));
}

TEST_CASE("unknown and repeated parameters are noted") {
    auto const scene = read_world(
        "Shape \"sphere\" \"float raduis\" 2\n\"float xyzzy\" 1\n \"float zmin\" 0 \"float zmin\" -0.5");
    CHECK(shape_of<Sphere>(scene).radius == 1);
    CHECK(shape_of<Sphere>(scene).z_min == -0.5f);
    auto const n = notes(scene);
    CHECK(contains(n,
                   "t.pbrt:2: Shape \"sphere\": parameter \"raduis\" is unknown and ignored (did you mean "
                   "\"radius\"?)"));
    CHECK(contains(n, "t.pbrt:3: Shape \"sphere\": parameter \"xyzzy\" is unknown and ignored\n"));
    CHECK(contains(n, "t.pbrt:4: Shape \"sphere\": parameter \"zmin\" is given twice; the last one counts"));
}

TEST_CASE("Attribute sets parameters for later directives, in its block only") {
    auto const scene = read_world(R"(
        AttributeBegin
        Attribute "shape" "float radius" 3 "float zmax" 1
        Attribute "light" "rgb L" [2 2 2]
        Attribute "material" "rgb reflectance" [0.25 0.25 0.25]
        AreaLightSource "diffuse"
        Material "diffuse"
        Shape "sphere"
        Shape "sphere" "float radius" 2
        AttributeEnd
        Shape "sphere")");
    CHECK(shape_of<Sphere>(scene, 0).radius == 3);
    CHECK(shape_of<Sphere>(scene, 0).z_max == 1);
    CHECK(shape_of<Sphere>(scene, 1).radius == 2);
    CHECK(shape_of<Sphere>(scene, 2).radius == 1);
    CHECK(as<RgbIlluminantSpd>(scene.world().objects[0].light->radiance).rgb == Vec3{2, 2, 2});
    auto const& reflectance =
        texture_of<ConstantSpectrumTexture>(scene, material_of<DiffuseMaterial>(scene, 0).reflectance);
    CHECK(as<RgbAlbedoSpd>(reflectance.value).rgb == Vec3{0.25f, 0.25f, 0.25f});
    CHECK(notes(scene).empty());
    CHECK(contains(error_in_world("Attribute \"camera\" \"float fov\" 1"), "t.pbrt:2: Attribute \"camera\""));
}

TEST_CASE("what Attribute sets is shared, not copied, and bounded") {
    // 20000 nested blocks, each of which adds to a list with a long one in it.
    std::string points, text, ends;
    for (int i = 0; i < 30000; ++i) points += "0 0 0 ";
    text = "Attribute \"shape\" \"point3 P\" [" + points + "]\n";
    for (int i = 0; i < 20000; ++i) {
        text += "AttributeBegin Attribute \"shape\" \"float radius\" " + std::to_string(i + 1) + "\n";
        ends += "AttributeEnd ";
    }
    auto const nested = read_world(text + "Shape \"sphere\" " + ends);
    CHECK(shape_of<Sphere>(nested).radius == 20000);
    // The same, again and again, between what keeps the list.
    text.clear();
    for (int i = 0; i < 5000; ++i)
        text += "Attribute \"material\" \"rgb reflectance\" [0.5 0.5 0.5] Material \"diffuse\"\n";
    CHECK(error_in_world(text) == "no error");
    text.clear();
    for (int i = 0; i < 1001; ++i) text += "Attribute \"shape\" \"float p" + std::to_string(i) + "\" 1\n";
    CHECK(error_in_world(text) ==
          "t.pbrt:1002: more than 1000 parameters are set by Attribute \"shape\" at once; close blocks, or "
          "set fewer");
}

TEST_CASE("parameters of Attribute that an entity has with another type are skipped") {
    auto const scene = read_world(R"(Attribute "shape" "float radius" 2
        Attribute "shape" "integer radius" 3
        Attribute "shape" "string zmin" "x"
        Attribute "material" "bool reflectance" true
        Material "conductor" Shape "sphere")");
    CHECK(shape_of<Sphere>(scene).radius == 2);
    CHECK(shape_of<Sphere>(scene).z_min == -2);
    CHECK(material_of<ConductorMaterial>(scene).eta.valid());
    CHECK(contains(notes(scene),
                   "t.pbrt:4: Shape \"sphere\": parameter \"zmin\" of Attribute is a \"string\", not a "
                   "\"float\": skipped"));
    CHECK(contains(notes(scene), "t.pbrt:5: Material \"conductor\": parameter \"reflectance\" of Attribute"));
    CHECK(scene.notes.size() == 2);
    // An own one of the wrong type stays an error.
    CHECK(contains(
        error_in_world("Attribute \"shape\" \"float radius\" 2 Shape \"sphere\" \"integer radius\" 3"),
        "it must be a \"float\""));
}

TEST_CASE("names in messages are short and harmless") {
    std::string const name(5000, 'x');
    for (auto const& text : {"Shape \"" + name + "\"", "Shape \"sphere\" \"float " + name + "\" 1",
                             "CoordSysTransform \"" + name + "\""}) {
        auto const said = notes(read_world(text));
        CHECK(said.size() < 250);
        CHECK(contains(said, "xxx…\""));
    }
    for (auto const& text :
         {"ObjectInstance \"" + name + "\"", "NamedMaterial \"" + name + "\" Shape \"sphere\"",
          "Material \"" + name + "\"", "Texture \"" + name + "\" \"float\" \"" + name + "\"",
          "Shape \"sphere\" \"integer " + name + "\" 0.5"}) {
        CAPTURE(text);
        CHECK(error_in_world(text).size() < 400);
        CHECK(contains(error_in_world(text), "x…\""));
    }
    auto const wild = error_in_world("Material \"a\x1b[31m\\n\"");
    CHECK(contains(wild, "a\\x1b[31m\\n"));
    CHECK(wild.find('\x1b') == std::string::npos);
    // Not in the middle of a character.
    std::string umlauts;
    for (int i = 0; i < 100; ++i) umlauts += "ä";
    CHECK(contains(error_in_world("Material \"a" + umlauts + "\""), "ää…\""));
}

TEST_CASE("the same note is said a few times only") {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "Shape \"curve\"\n";
    auto const scene = read_world(text);
    CHECK(scene.notes.size() == 6);
    CHECK(contains(scene.notes.back().text, "the last of 995 more such notes"));
}
