// What lets a written scene be read as the same bits: angles in radians, inverses by name, constants, a white of its own.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("angles may be given in radians") {
    auto const fov = [](std::string const& parameters) {
        return std::get<PerspectiveCamera>(
                   read("Camera \"perspective\" " + parameters + " WorldBegin").camera.kind)
            .fov;
    };
    CHECK(fov("\"float fov.radians\" 0.7123457") == 0.7123457f);
    CHECK(fov("\"float fov\" 40") == radians(40));
    CHECK(contains(error_in("Camera \"perspective\" \"float fov\" 40 \"float fov.radians\" 1 WorldBegin"),
                   "give either \"fov\" or \"fov.radians\", not both"));
    CHECK(contains(error_in("Camera \"perspective\" \"float fov.radians\" 3.2 WorldBegin"),
                   "\"fov\" must be above 0 and below 180"));
    CHECK(shape_of<Sphere>(read_world("Shape \"sphere\" \"float phimax.radians\" 1.2345678")).phi_max ==
          1.2345678f);
    CHECK(shape_of<Sphere>(read_world("Shape \"sphere\" \"float phimax.radians\" 7")).phi_max == kTwoPi);
}

TEST_CASE("the inverse of the current transform may be named, and must be it") {
    std::string const there =
        "Transform [ 1 0 0 0  0 1 0 0  0 0 1 0  0.1 0.2 0.3 1 ] CoordinateSystem \"there\" ";
    std::string const back = "Transform [ 1 0 0 0  0 1 0 0  0 0 1 0  -0.1000000001 -0.2 -0.3 1 ] ";
    CHECK(read(there + back + "Camera \"perspective\" \"string inverse\" \"there\" WorldBegin")
              .camera.to_world == translate(0.1, 0.2, 0.3));
    CHECK(read(there + back + "Camera \"perspective\" WorldBegin").camera.to_world !=
          translate(0.1, 0.2, 0.3));
    CHECK(contains(error_in(there + "Camera \"perspective\" \"string inverse\" \"there\" WorldBegin"),
                   "t.pbrt:1: Camera \"perspective\": \"inverse\": \"there\" is not the inverse"));
    CHECK(contains(error_in(back + "Camera \"perspective\" \"string inverse\" \"their\" WorldBegin"),
                   "no coordinate system \"their\" is defined"));
    auto const scene = read_world(there + back + R"(Texture "t" "float" "windy" "string inverse" "there"
        Material "dielectric" "texture roughness" "t" Shape "sphere")");
    auto const id = material_of<DielectricMaterial>(scene).roughness.u;
    CHECK(std::get<WindyTexture>(scene[id].kind).world_to_texture == translate(0.1, 0.2, 0.3));
    CHECK(notes(scene).empty());
    CHECK(contains(error_in_world(there + "Texture \"t\" \"float\" \"windy\" \"string inverse\" \"there\""),
                   "t.pbrt:2: Texture \"t\": \"inverse\""));
}

TEST_CASE("a float where a spectrum is wanted is the same at all wavelengths") {
    auto const scene = read_world(R"(Material "diffuse" "float reflectance" 0.25 Shape "sphere"
        LightSource "infinite" "float L" 3
        Texture "t" "spectrum" "constant" "float value" 0.75
        Material "diffuse" "texture reflectance" "t" Shape "sphere")");
    auto const level = [&](std::size_t object) {
        auto const& t = scene[material_of<DiffuseMaterial>(scene, object).reflectance];
        return std::get<ConstantSpd>(std::get<ConstantSpectrumTexture>(t.kind).value).value;
    };
    CHECK(level(0) == 0.25f);
    CHECK(level(1) == 0.75f);
    CHECK(std::get<ConstantSpd>(std::get<InfiniteLight>(scene.lights[0].kind).radiance).value == 3);
    CHECK(notes(scene).empty());
}

TEST_CASE("sRGB's numbers under the white of ACES") {
    auto const scene =
        read_world("ColorSpace \"srgb-acesd60\" LightSource \"infinite\" \"rgb L\" [ 0.2 0.3 0.4 ]");
    auto const& rgb = std::get<RgbIlluminantSpd>(std::get<InfiniteLight>(scene.lights[0].kind).radiance);
    CHECK(rgb.rgb == Vec3{0.2f, 0.3f, 0.4f});
    CHECK(rgb.white == RgbWhite::AcesD60);
}

TEST_CASE("a stratified sampler may have another number of samples than of strata") {
    auto const settings = read(
                              "Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 2 "
                              "\"integer pixelsamples\" 7 WorldBegin")
                              .settings;
    CHECK(settings.spp == 7);
    CHECK(std::get<StratifiedSampler>(settings.sampler).x_strata == 3);
}

TEST_CASE("the two surfaces of a coated metal may differ in all that makes them rough") {
    auto const scene = read_world(R"(Material "coatedconductor" "bool remaproughness" false
        "bool conductor.remaproughness" true "string interface.distribution" "beckmann" "bool interface.multiscatter" true
        Shape "sphere")");
    auto const& m = material_of<CoatedConductorMaterial>(scene);
    CHECK(m.conductor.roughness.remap);
    CHECK_FALSE(m.coat.roughness.remap);
    CHECK(m.coat.roughness.distribution == Distribution::Beckmann);
    CHECK(m.conductor.roughness.distribution == Distribution::TrowbridgeReitz);
    CHECK(m.coat.roughness.multiscatter);
    CHECK_FALSE(m.conductor.roughness.multiscatter);
    CHECK(notes(scene).empty());
}
