// Blocks, objects and instances, and where directives may stand.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("attribute blocks save the graphics state") {
    auto const scene = read_world(R"(
        AttributeBegin
          Translate 1 0 0
          ReverseOrientation
          AreaLightSource "diffuse"
          Material "dielectric"
          Shape "sphere"
        AttributeEnd
        TransformBegin
          ReverseOrientation ReverseOrientation
          Shape "sphere"
        TransformEnd)");
    auto const& objects = scene.world().objects;
    REQUIRE(objects.size() == 2);
    CHECK(objects[0].reverse_orientation);
    CHECK(objects[0].light.has_value());
    CHECK(objects[0].to_group.m[0][3] == 1);
    material_of<DielectricMaterial>(scene, 0);
    CHECK_FALSE(objects[1].reverse_orientation);
    CHECK_FALSE(objects[1].light.has_value());
    CHECK(objects[1].to_group.m[0][3] == 0);
    // pbrt's default: diffuse 0.5
    auto const& gray =
        texture_of<ConstantSpectrumTexture>(scene, material_of<DiffuseMaterial>(scene, 1).reflectance);
    CHECK(as<ConstantSpd>(gray.value).value == 0.5f);
    CHECK(contains(notes(scene), "TransformBegin is deprecated"));
}

TEST_CASE("unbalanced blocks") {
    // pbrt goes on, too.
    auto const scene = read_world("AttributeEnd Shape \"sphere\"");
    CHECK(scene.world().objects.size() == 1);
    CHECK(notes(scene) == "t.pbrt:2: AttributeEnd without its Begin is ignored\n");
    CHECK(error_in_world("\nAttributeBegin\n") == "t.pbrt:3: AttributeBegin without an AttributeEnd");
    CHECK(error_in_world("ObjectBegin \"a\"") == "t.pbrt:2: ObjectBegin without an ObjectEnd");
    CHECK(error_in_world("ObjectEnd") == "t.pbrt:2: ObjectEnd without its Begin");
    CHECK(error_in_world("ObjectBegin \"a\" AttributeBegin\nObjectEnd") ==
          "t.pbrt:3: ObjectEnd closes what AttributeBegin opened at t.pbrt:2");
    CHECK(error_in_world("ObjectBegin \"a\"\nAttributeEnd") ==
          "t.pbrt:3: AttributeEnd closes what ObjectBegin opened at t.pbrt:2");
}

TEST_CASE("two hundred thousand nested blocks") {
    std::string text;
    for (int i = 0; i < 200000; ++i) text += "AttributeBegin ";
    text += "Shape \"sphere\" ";
    for (int i = 0; i < 200000; ++i) text += "AttributeEnd ";
    CHECK(read_world(text).world().objects.size() == 1);
}

TEST_CASE("instances") {
    auto const scene = read_world(R"(
        Translate 1 0 0
        ObjectBegin "a"
          Translate 0 2 0
          Shape "sphere"
        ObjectEnd
        Shape "disk"
        ObjectBegin "b"
          Scale 2 2 2
          ObjectInstance "a"
        ObjectEnd
        Translate 0 0 3
        ObjectInstance "b"
        ObjectInstance "b")");
    REQUIRE(scene.groups.size() == 3);
    CHECK(scene.groups[1].name == "a");
    REQUIRE(scene.groups[1].objects.size() == 1);
    // As in pbrt, the transform at ObjectBegin counts for the shapes inside.
    CHECK(scene.groups[1].objects[0].to_group.m[0][3] == 1);
    CHECK(scene.groups[1].objects[0].to_group.m[1][3] == 2);
    REQUIRE(scene.groups[2].instances.size() == 1);
    CHECK(scene.groups[2].instances[0].group == GroupId{1});
    CHECK(scene.groups[2].instances[0].to_parent == AffineRows{{{2, 0, 0, 1}, {0, 2, 0, 0}, {0, 0, 2, 0}}});
    REQUIRE(scene.world().instances.size() == 2);
    CHECK(scene.world().instances[1].group == GroupId{2});
    CHECK(scene.world().instances[1].to_parent == AffineRows{{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 3}}});
    CHECK(scene.world().objects.size() == 1);
    CHECK(notes(scene).empty());
}

TEST_CASE("instances that cannot be") {
    CHECK(error_in_world("ObjectBegin \"tree\" ObjectEnd\nObjectInstance \"tee\"") ==
          "t.pbrt:3: no object \"tee\" is defined (did you mean \"tree\"?)");
    CHECK(error_in_world("ObjectBegin \"a\"\nObjectInstance \"a\" ObjectEnd") ==
          "t.pbrt:3: object \"a\" contains itself");
    CHECK(contains(error_in_world("ObjectBegin \"a\"\nObjectBegin \"b\""),
                   "t.pbrt:3: ObjectBegin inside another object"));
    CHECK(error_in_world("ObjectBegin \"a\" ObjectEnd\nObjectBegin \"a\"") ==
          "t.pbrt:3: object \"a\" is already defined at t.pbrt:2");
    CHECK(contains(
        error_in_world(
            "ObjectBegin \"a\" ObjectEnd Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]\nObjectInstance \"a\""),
        "t.pbrt:3: the transform of an instance"));
    // Defined later is fine, as in pbrt.
    auto const scene = read_world("ObjectInstance \"a\" ObjectBegin \"a\" Shape \"sphere\" ObjectEnd");
    CHECK(scene.groups.at(1).objects.size() == 1);
}

TEST_CASE("area lights inside objects are kept and noted") {
    auto const scene = read_world(
        "ObjectBegin \"a\" AreaLightSource \"diffuse\" Shape \"sphere\" ObjectEnd ObjectInstance \"a\"");
    CHECK(scene.groups[1].objects[0].light.has_value());
    CHECK(contains(notes(scene), "an area light inside an object"));
}

TEST_CASE("what may stand before WorldBegin, and what after") {
    CHECK(error_in_world("WorldBegin") == "t.pbrt:2: a second WorldBegin; a scene has one");
    for (char const* text :
         {"Camera \"perspective\"", "Film \"rgb\"", "Sampler \"sobol\"", "Integrator \"path\"",
          "PixelFilter \"box\"", "Accelerator \"bvh\"", "TransformTimes 0 1"}) {
        CAPTURE(text);
        CHECK(contains(error_in_world(text), "must stand before WorldBegin"));
        CHECK(error_in(std::string(text) + "\nWorldBegin") == "no error");
    }
    for (char const* text :
         {"Shape \"sphere\"", "LightSource \"point\"", "AreaLightSource \"diffuse\"",
          "AttributeBegin AttributeEnd", "Material \"diffuse\"", "Texture \"a\" \"float\" \"constant\"",
          "ReverseOrientation", "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"",
          "ObjectBegin \"a\" ObjectEnd"}) {
        CAPTURE(text);
        CHECK(contains(error_in(text), "must stand after WorldBegin"));
        CHECK(error_in_world(text) == "no error");
    }
}

TEST_CASE("unknown directives") {
    CHECK(error_in_world("Shapes \"sphere\"") ==
          "t.pbrt:2: unknown directive Shapes (did you mean \"Shape\"?)");
    CHECK(error_in_world("\n\"sphere\"") ==
          "t.pbrt:3: \"sphere\" stands where a directive such as Shape should be");
    CHECK(contains(error_in_world("\n]"), "t.pbrt:3: \"]\" stands where"));
    CHECK(contains(error_in("SurfaceIntegrator \"path\""), "in pbrt-v4 it is Integrator"));
    CHECK(contains(notes(read_world("WorldEnd")), "t.pbrt:2: WorldEnd is of pbrt-v3"));
}

TEST_CASE("what a medium absorbs belongs to the dielectric that it is in") {
    auto const scene = read(
        "MakeNamedMedium \"juice\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 3] \"rgb sigma_s\" "
        "[0 0 0] "
        "\"float scale\" 2 WorldBegin Material \"dielectric\" Shape \"sphere\" MediumInterface \"juice\" "
        "\"\" "
        "Shape \"sphere\" Shape \"sphere\" MediumInterface \"\" Shape \"sphere\"");
    CHECK(scene.notes.empty());
    auto const& o = scene.world().objects;
    REQUIRE(o.size() == 4);
    auto const absorption = [&](std::size_t i) {
        return as<DielectricMaterial>(scene[o[i].material].kind).interior.absorption;
    };
    CHECK(as<ConstantSpd>(absorption(0)).value == 0);
    CHECK(as<RgbUnboundedSpd>(absorption(1)).rgb == Vec3{2, 4, 6});
    CHECK(o[1].material == o[2].material);
    CHECK(o[3].material == o[0].material);
}

TEST_CASE("media are noted") {
    auto const scene = read(
        "MakeNamedMedium \"fog\" \"string type\" \"uniformgrid\"\nMakeNamedMedium \"milk\" \"string type\" "
        "\"homogeneous\" \"rgb sigma_a\" [1 1 1]\nWorldBegin MediumInterface \"milk\" \"\"\nShape "
        "\"sphere\"");
    CHECK(scene.world().objects.size() == 1);
    CHECK(contains(notes(scene), "t.pbrt:1: MakeNamedMedium \"fog\": is not rendered yet"));
    CHECK(contains(notes(scene), "t.pbrt:2: MakeNamedMedium \"milk\": its scattering is not rendered yet"));
    CHECK(contains(notes(scene),
                   "t.pbrt:4: what medium \"milk\" absorbs is rendered inside dielectrics alone"));
    CHECK(scene.notes.size() == 3);
    CHECK(contains(
        error_in("MakeNamedMedium \"a\" \"string type\" \"homogeneous\"\nMakeNamedMedium \"a\" \"string "
                 "type\" \"homogeneous\""),
        "t.pbrt:2: medium \"a\" is already defined"));
    CHECK(contains(error_in("MakeNamedMedium \"a\""),
                   "t.pbrt:1: MakeNamedMedium \"a\": needs a \"string type\""));
    CHECK(contains(
        notes(read("MakeNamedMedium \"a\" \"string type\" \"cloud\"\n\"float densty\" 2 WorldBegin")),
        "t.pbrt:2: MakeNamedMedium \"a\": parameter \"densty\" is unknown and ignored (did you mean "
        "\"density\"?)"));
    CHECK(contains(
        notes(read("MakeNamedMedium \"fog\" \"string type\" \"cloud\" WorldBegin\nMediumInterface \"fig\" "
                   "\"fog\"")),
        "t.pbrt:2: no medium \"fig\" is defined (did you mean \"fog\"?)"));
    // What is outside absorbs only as the inside of something else.
    std::string const juice =
        "MakeNamedMedium \"juice\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [0 0 0] WorldBegin "
        "Material \"dielectric\"\nMediumInterface \"\" \"juice\" Shape \"sphere\" ";
    CHECK(notes(read(juice)).find("t.pbrt:2: what medium \"juice\" absorbs outside of surfaces") !=
          std::string::npos);
    CHECK(read(juice + "MediumInterface \"juice\" \"\" Shape \"sphere\"").notes.empty());
    // What Attribute sets for media is theirs: here their type.
    CHECK(error_in("Attribute \"medium\" \"string type\" \"homogeneous\" MakeNamedMedium \"a\" WorldBegin") ==
          "no error");
}
