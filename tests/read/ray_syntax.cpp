// .ray files: words, blocks, and what is refused, where.
#include "rays.h"

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("versions, byte order marks, line ends and comments") {
    for (char const* version : {"0.9", "1.0", "1.1", "1"})
        CHECK(read_ray_bytes(std::string("SBT-raytracer ") + version + " sphere {}").world().objects.size() ==
              1);
    CHECK(read_ray_bytes("\xef\xbb\xbfSBT-raytracer 1.0\r\n// caf\xc3\xa9\r\nsphere {\r\n}\r\n")
              .world()
              .objects.size() == 1);
    CHECK(read_ray("/* one\n * sphere {} */ sphere {} // sphere {}").world().objects.size() == 1);
    CHECK(read_ray("sphere { name = \"\xc3\xbc\" }; ; ;").world().objects.size() == 1);
    CHECK(read_ray("").world().objects.empty());
    CHECK(error_in_ray_bytes("SBT-raytracer 1.2 sphere {}") ==
          "t.ray:1: version 1.2 is not known: 0.9, 1.0 and 1.1 are read");
    CHECK(
        error_in_ray_bytes("") ==
        "t.ray:1: \"SBT-raytracer 1.1\", which begins a .ray file, should be here, not the end of the file");
    CHECK(contains(error_in_ray_bytes("WorldBegin"), "t.ray:1: \"SBT-raytracer 1.1\""));
}

TEST_CASE("gzip'd files, and names in capitals") {
    Folder const folder;
    CHECK(read_scene(folder.write("A.RAY", "SBT-raytracer 1.0 box {}")).world().objects.size() == 1);
    CHECK(contains(error_of([&] { read_scene(folder.write("a.rays", "")); }),
                   "unknown kind of scene; .pbrt, .ray, .ply and .obj are read"));
    // gzip of "SBT-raytracer 1.0 box {}"
    std::string const packed(
        "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\x03\x0b\x76\x0a\xd1\x2d\x4a\xac\x2c\x29\x4a\x4c\x4e"
        "\x2d\x52\x30\xd4\x33\x50\x48\xca\xaf\x50\xa8\xae\xe5\x02\x00\x4c\x96\xa0\x23\x19\x00\x00\x00",
        45);
    CHECK(read_scene(folder.write("b.ray.gz", packed)).world().objects.size() == 1);
}

TEST_CASE("what is wrong, and on which line") {
    auto const check = [](std::string const& text, std::string const& message) {
        CAPTURE(text);
        CHECK(error_in_ray(text) == "t.ray:" + message);
    };
    // Words
    check("\n\n/* never ends\n\n", "4: this comment is not closed: end it with */");
    check("sphere { name = \"a\n\" }", "2: unterminated string: close it with a \" on the same line");
    check("sphere { name = \"a", "2: unterminated string: close it with a \" on the same line");
    check("\n$", "3: \"$\" has no meaning here: names, numbers, strings and ( ) { } , = ; have");
    check("\xc3\xa9", "2: \"\xc3\xa9\" has no meaning here: names, numbers, strings and ( ) { } , = ; have");
    check(std::string("a\n\0", 3), "3: a NUL byte; scene files are text");
    check("scale(1.2.3, sphere {})", "2: \"1.2.3\" is no finite number; write one such as -0.5 or 1e-3");
    check("scale(1e999, sphere {})", "2: \"1e999\" is no finite number; write one such as -0.5 or 1e-3");
    check("cone { height = 1e99 }",
          "2: \"1e99\" is no number of single precision; write one such as -0.5 or 1e-3");
    // Blocks
    check("sphere {\n\n", "2: this { is not closed: add a }");
    check("{ sphere {}\n", "2: this { is not closed: add a }");
    check("sphere", "2: \"{\" should be here, not the end of the file");
    check("sphere {\n)", "3: an attribute of sphere, or \"}\", should be here, not \")\"");
    check("sphere {\n radius = 3 }",
          "3: unknown attribute \"radius\" of sphere; use one of \"material\", \"name\"");
    check("cone {\n hieght = 3 }", "3: unknown attribute \"hieght\" of cone (did you mean \"height\"?)");
    check("cone { capped = 3 }", "2: true or false should be here, not \"3\"");
    check("box { name = 3 }", "2: a name, or a string in quotes, should be here, not \"3\"");
    check("box { name 3 }", "2: \"=\" should be here, not \"3\"");
    // Objects
    check("spere {}", "2: unknown object \"spere\" (did you mean \"sphere\"?)");
    check("fork {}",
          "2: unknown object \"fork\"; use one of \"sphere\", \"box\", \"square\", \"cylinder\", \"cone\", "
          "\"polymesh\", \"trimesh\", \"translate\", \"rotate\", \"scale\", \"transform\", \"camera\", "
          "\"ambient_light\", \"directional_light\", \"point_light\", \"area_light\", \"material\"");
    check("\n3", "3: a camera, a light, a material or geometry should be here, not \"3\"");
    check("scale(2, camera {})", "2: camera must not stand inside a transform or group; move it out");
    check("{ point_light {} }", "2: point_light must not stand inside a transform or group; move it out");
    check("scale(2, 3, 4, 5)", "2: geometry, a transform or a group should be here, not \"5\"");
    check("csg", "2: \"{\" or \"(\" should be here, not the end of the file");
    check("csg {\n(", "2: this { is not closed: add a }");
    // Transforms
    check("translate(1, 2, sphere {})", "2: a number should be here, not \"sphere\"");
    check("translate(1, 2, 3, sphere {}", "2: \")\" should be here, not the end of the file");
    check("rotate(0, 0, 0, 1, sphere {})", "2: the axis of a rotation must not be (0, 0, 0)");
    check("transform((1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,1,1), sphere {})",
          "2: the last row of a transform must be (0, 0, 0, 1)");
    check("scale(1e200,\nscale(1e200, sphere {}))", "3: the transforms overflow here; use smaller numbers");
    // Camera
    check("camera { fov = 0 }", "2: \"fov\" must be above 0 and below 180 degrees");
    check("camera {\naspectratio = 0 }",
          "3: \"aspectratio\" (width over height) must be between 0.01 and 100");
    check("camera { viewdir = (0,0,1) }", "2: the camera has \"viewdir\" without \"updir\"; add it");
    check("camera { updir = (0,0,1) }", "2: the camera has \"updir\" without \"viewdir\"; add it");
    check("camera { viewdir = (0,0,1) updir = (0,0,2) }",
          "2: the camera's direction has no length, or is along \"updir\"; change one of them");
    check("camera { quaternian = (0,0,0,0) }", "2: the camera's \"quaternian\" has no length, or too much");
    // Materials
    check("sphere { material = wood }", "2: no material \"wood\" is defined before");
    check("material { name = wood }\nsphere { material = \"woot\" }",
          "3: no material \"woot\" is defined before (did you mean \"wood\"?)");
    check("material { diffuse = (1,1,1) }",
          "2: this material has no name, and is of no use; give it one, or write "
          "\"material =\"");
    check("material = { name = a }\nmaterial = { shininess = -1 }", "3: the shininess must not be negative");
    check("material = { index = 0 }", "2: the index must be between 0.001 and 1000 (glass: 1.5)");
    check("material = { diffuse = 1 }", "2: \"(\" should be here, not \"1\"");
    check("material = { diffuse = (1, 1) }", "2: \",\" should be here, not \")\"");
    check("material = { diffuse = map(3) }", "2: a name, or a string in quotes, should be here, not \"3\"");
    check("sphere { material = { diffuse = (3e38,0,0); transmissive = (3e38,0,0) } }",
          "2: the colours of the material are too large; divide them");
    // Meshes
    check("polymesh { faces = ((0,1,2)) }", "2: polymesh needs \"points\"");
    check("trimesh { points = ((0,0,0)) }", "2: trimesh needs \"faces\"");
    check("polymesh { points = ((0,0,0));\nfaces = ((0,0)) }", "3: a face needs at least three corners");
    check("polymesh { points = ((0,0,0)); faces = ((0,0,1)) }",
          "2: polymesh: a face names point 1, but there are 1, counted from 0");
    for (char const* corner : {"-1", "0.5", "3000000000"})
        check("polymesh { points = ((0,0,0)); faces = ((0,0," + std::string(corner) + ")) }",
              "2: the corner of a face must be the number of a point, from 0");
    check("polymesh { points = ((0,0,0)); faces = ((0,0,0)); normals = ((0,0,1),(0,0,1)) }",
          "2: polymesh: 2 normals for 1 points; give one for each");
    check("polymesh { points = ((0,0,0)); faces = ((0,0,0)); materials = ({},{}) }",
          "2: polymesh: 2 materials for 1 points; give one for each");
    check("polymesh { points = ((0,0,0)", "2: this ( is not closed: add a )");
    check("cone { top_radius = -1 }", "2: the radii of a cone must not be negative");
    // Lights
    check("point_light { color = (1,1,1) }", "2: point_light has no \"position\"; add it");
    check("point_light { position = (1,1,1) }", "2: point_light has no \"color\"; add it");
    check("point_light { position = (1,1,1)\nposition = (1,1,1) }",
          "3: point_light: \"position\" is given twice; keep one");
    check("point_light { color = (1,1,1)\ncolour = (1,1,1) }",
          "3: point_light: \"color\" is given twice; keep one");
    check("point_light { linear_attenuation_coeff = -1 }",
          "2: \"linear_attenuation_coeff\" must not be negative");
    check("ambient_light {}", "2: ambient_light has no \"color\"; add it");
    check("directional_light { color = (1,1,1) }", "2: directional_light has no \"direction\"; add it");
    check("directional_light { color = (1,1,1) direction = (0,0,0) }",
          "2: the direction is (0, 0, 0): say where the light goes");
    std::string const area = "area_light { color = (1,1,1); position = (0,0,0); ";
    check(area + "}",
          "2: area_light needs either \"light_radius\" (a ball), or \"u\" and \"v\" (the edges of a "
          "parallelogram)");
    check(area + "u = (1,0,0) light_radius = 1 }",
          "2: area_light needs either \"light_radius\" (a ball), or \"u\" and \"v\" (the edges of a "
          "parallelogram)");
    check(area + "u = (1,0,0) }", "2: area_light has no \"v\"; add it");
    check(area + "light_radius = 0 }", "2: \"light_radius\" must be above 0");
}

TEST_CASE("names are defined once; what is defined is said") {
    auto const message = error_in_ray("material { name = a }\n\nmaterial { name = a }");
    CHECK(contains(message, "t.ray:2; give it another name"));
    CHECK(contains(error_of([] { read_ray("material { name = a }\n\nmaterial { name = a }"); }),
                   "t.ray:4: material \"a\" is already defined at "));
}

TEST_CASE("limits: nesting, cones") {
    auto const nested = [](int depth) {
        std::string text;
        for (int i = 0; i < depth; ++i) text += i % 2 == 0 ? "scale(1," : "{";
        text += "sphere {}";
        for (int i = depth - 1; i >= 0; --i) text += i % 2 == 0 ? ")" : "}";
        return text;
    };
    CHECK(read_ray(nested(500)).world().objects.size() == 1);
    CHECK(error_in_ray(nested(501)) == "t.ray:2: transforms and groups are nested more than 500 deep");
    CHECK(contains(error_in_ray(nested(1000000)), "nested more than 500 deep"));
    // What is passed over may be as deep as it likes.
    CHECK(read_ray("csg " + std::string(100000, '{') + std::string(100000, '}')).world().objects.empty());
}

TEST_CASE("what is left out, and what is given twice, is noted") {
    auto const scene = read_ray(
        "skybox { up = \"a.png\"; { () } }\nscale(2, metaball { a = 1 })\n{ csg(1, 2) box {} }\n"
        "camera { fov = 30; fov = 40; }\ncamera {}\nsphere { name = a; name = b }");
    auto const text = notes(scene);
    CHECK(contains(text, "t.ray:2: skybox is an extension that is not rendered: left out"));
    CHECK(contains(text, "t.ray:3: metaball is an extension that is not rendered: left out"));
    CHECK(contains(text, "t.ray:4: csg is an extension"));
    CHECK(contains(text, "t.ray:5: camera: \"fov\" is given twice: the last one counts"));
    CHECK(contains(text, "t.ray:6: a second camera: what it says replaces what the first one said"));
    CHECK(contains(text, "t.ray:7: sphere: \"name\" is given twice: the last one counts"));
    CHECK(scene.world().objects.size() == 2);
    CHECK(
        contains(notes(read_ray("sphere {}")), "no camera: one at the origin that looks along -z stands in"));
}
