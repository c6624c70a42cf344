// Materials and textures.
#include "helpers.h"
#include "spectrum/named.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {
/// The material of a sphere after `text`.
Scene with(std::string const& text) { return read_world(text + "\nShape \"sphere\""); }
Spd spectrum(Scene const& scene, TextureId id) {
    return texture_of<ConstantSpectrumTexture>(scene, id).value;
}
}  // namespace

TEST_CASE("materials and their defaults") {
    auto scene = with("Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3]");
    CHECK(as<RgbAlbedoSpd>(spectrum(scene, material_of<DiffuseMaterial>(scene).reflectance)).rgb ==
          Vec3{0.1f, 0.2f, 0.3f});
    scene = with("Material \"diffuse\"");
    CHECK(as<ConstantSpd>(spectrum(scene, material_of<DiffuseMaterial>(scene).reflectance)).value == 0.5f);
    scene = with("Material \"dielectric\"");
    CHECK(as<ConstantSpd>(material_of<DielectricMaterial>(scene).eta).value == 1.5f);
    scene = with("Material \"dielectric\" \"float eta\" 1.33");
    CHECK(as<ConstantSpd>(material_of<DielectricMaterial>(scene).eta).value == 1.33f);
    scene = with("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"");
    CHECK(as<NamedSpd>(material_of<DielectricMaterial>(scene).eta).name == "glass-BK7");
    scene = with("Material \"thindielectric\" \"float eta\" 1.2");
    CHECK(as<ConstantSpd>(material_of<ThinDielectricMaterial>(scene).eta).value == 1.2f);
    scene = with("Material \"conductor\"");
    CHECK(as<NamedSpd>(spectrum(scene, material_of<ConductorMaterial>(scene).eta)).name == "metal-Cu-eta");
    CHECK(as<NamedSpd>(spectrum(scene, material_of<ConductorMaterial>(scene).k)).name == "metal-Cu-k");
    CHECK(texture_of<ConstantSpectrumTexture>(scene, material_of<ConductorMaterial>(scene).k).role ==
          SpectrumRole::Unbounded);
    CHECK(notes(scene).empty());
    scene = with("Material \"conductor\" \"rgb reflectance\" [1 0.5 0]");
    CHECK_FALSE(material_of<ConductorMaterial>(scene).eta.valid());
    CHECK(as<RgbAlbedoSpd>(spectrum(scene, material_of<ConductorMaterial>(scene).reflectance)).rgb.y == 0.5f);
    material_of<InterfaceMaterial>(with("Material \"interface\""));
    scene = with("Material \"\"");
    material_of<InterfaceMaterial>(scene);
    CHECK(contains(notes(scene), "it is \"interface\""));
    CHECK(contains(error_in_world("Material \"dielectric\" \"float eta\" 0"), "must be above 0"));
    CHECK(
        contains(error_in_world(
                     "Material \"conductor\" \"rgb reflectance\" [1 1 1] \"spectrum eta\" \"metal-Cu-eta\""),
                 "not both"));
}

TEST_CASE("what is not rendered yet stands in and is noted") {
    for (char const* type : {"subsurface", "hair"}) {
        CAPTURE(type);
        auto const scene = with("Material \"" + std::string(type) + "\" \"float eta\" 1.3");
        material_of<DiffuseMaterial>(scene);
        CHECK(scene.notes.size() == 1);
    }
}

TEST_CASE("roughness: its names, its defaults, and what is out of range") {
    auto scene = with("Material \"conductor\" \"float roughness\" 0.3");
    auto const& both = material_of<ConductorMaterial>(scene).roughness;
    CHECK(both.u == both.v);
    CHECK(texture_of<ConstantFloatTexture>(scene, both.u).value == 0.3f);
    CHECK(both.remap);
    CHECK(both.distribution == Distribution::TrowbridgeReitz);
    CHECK_FALSE(both.multiscatter);
    scene = with(
        "Material \"dielectric\" \"float uroughness\" 0.1 \"float vroughness\" 0.4 \"bool remaproughness\" "
        "false \"string distribution\" \"beckmann\" \"bool multiscatter\" true");
    auto const& two = material_of<DielectricMaterial>(scene).roughness;
    CHECK(texture_of<ConstantFloatTexture>(scene, two.u).value == 0.1f);
    CHECK(texture_of<ConstantFloatTexture>(scene, two.v).value == 0.4f);
    CHECK_FALSE(two.remap);
    CHECK(two.distribution == Distribution::Beckmann);
    CHECK(two.multiscatter);
    // One direction alone: the other is smooth, as in pbrt.
    scene = with("Material \"dielectric\" \"float vroughness\" 0.4");
    CHECK(texture_of<ConstantFloatTexture>(scene, material_of<DielectricMaterial>(scene).roughness.u).value ==
          0.0f);
    CHECK_FALSE(material_of<DielectricMaterial>(with("Material \"dielectric\"")).roughness.u.valid());
    CHECK(contains(notes(with("Material \"conductor\" \"float roughness\" 10")), "above 1"));
    CHECK(notes(with("Material \"conductor\" \"float roughness\" 1e-8")).empty());
    CHECK(contains(error_in_world("Material \"conductor\" \"float roughness\" -0.1"),
                   "t.pbrt:2: \"float roughness\" must not be negative"));
    CHECK(contains(error_in_world("Material \"conductor\" \"float roughness\" nan"), "t.pbrt:2"));
    CHECK(contains(error_in_world("Material \"conductor\" \"string distribution\" \"gauss\""), "beckmann"));
}

TEST_CASE("indices of refraction: bad ones, and the formulas of glass catalogues") {
    for (char const* bad : {"0", "-1.5", "nan", "inf"}) {
        CAPTURE(bad);
        CHECK(contains(error_in_world("Material \"dielectric\" \"float eta\" " + std::string(bad)),
                       "t.pbrt:2"));
    }
    CHECK(notes(with("Material \"dielectric\" \"float eta\" 1")).empty());
    auto const at = [](Scene const& scene, double nm) {
        return interpolate(as<TabulatedSpd>(material_of<DielectricMaterial>(scene).eta), nm);
    };
    // Schott's N-BK7 at the helium d line: 1.5168.
    auto const bk7 = with(
        "Material \"dielectric\" \"float sellmeier\" [1.03961212 0.00600069867 0.231792344 0.0200179144 "
        "1.01046945 103.560653]");
    CHECK(at(bk7, 587.6) == doctest::Approx(1.5168).epsilon(2e-5));
    auto const cauchy = with("Material \"dielectric\" \"float cauchy\" [1.5046 0.0042 0]");
    CHECK(at(cauchy, 500) == doctest::Approx(1.5046 + 0.0042 / 0.25).epsilon(1e-6));
    CHECK(
        contains(error_in_world("Material \"dielectric\" \"float cauchy\" [1.5 0.004]"), "needs 3 numbers"));
    CHECK(contains(error_in_world("Material \"dielectric\" \"float cauchy\" [-3 0 0]"),
                   "gives no index of refraction"));
    CHECK(contains(error_in_world("Material \"dielectric\" \"float eta\" 1.5 \"float cauchy\" [1.5 0.004 0]"),
                   "not both"));
}

TEST_CASE("coats, transmission, measured, and the models that pbrt does not have") {
    auto scene = with(
        "Material \"coateddiffuse\" \"rgb reflectance\" [0.1 0.2 0.3] \"float roughness\" 0.1 \"float "
        "thickness\" "
        "0.5 \"rgb albedo\" [0.5 0.5 0.5] \"float g\" 0.3 \"integer maxdepth\" 20 \"integer nsamples\" 4");
    auto const& diffuse = material_of<CoatedDiffuseMaterial>(scene);
    CHECK(as<RgbAlbedoSpd>(spectrum(scene, diffuse.reflectance)).rgb.x == 0.1f);
    CHECK(texture_of<ConstantFloatTexture>(scene, diffuse.coat.thickness).value == 0.5f);
    CHECK(texture_of<ConstantFloatTexture>(scene, diffuse.coat.g).value == 0.3f);
    CHECK(diffuse.coat.albedo.valid());
    CHECK(diffuse.coat.max_depth == 20);
    CHECK(diffuse.coat.samples == 4);
    CHECK(notes(scene).empty());
    CHECK_FALSE(material_of<CoatedDiffuseMaterial>(with("Material \"coateddiffuse\"")).coat.albedo.valid());
    scene = with(
        "Material \"coatedconductor\" \"spectrum conductor.eta\" \"metal-Ag-eta\" \"spectrum conductor.k\" "
        "\"metal-Ag-k\" \"float conductor.roughness\" 0.2 \"float interface.roughness\" 0.1 \"float "
        "interface.eta\" 1.3");
    auto const& metal = material_of<CoatedConductorMaterial>(scene);
    CHECK(as<NamedSpd>(spectrum(scene, metal.conductor.eta)).name == "metal-Ag-eta");
    CHECK(texture_of<ConstantFloatTexture>(scene, metal.conductor.roughness.u).value == 0.2f);
    CHECK(texture_of<ConstantFloatTexture>(scene, metal.coat.roughness.u).value == 0.1f);
    CHECK(as<ConstantSpd>(metal.coat.eta).value == 1.3f);
    CHECK(notes(scene).empty());
    scene = with("Material \"diffusetransmission\" \"float scale\" 2");
    CHECK(as<ConstantSpd>(spectrum(scene, material_of<DiffuseTransmissionMaterial>(scene).transmittance))
              .value == 0.25f);
    CHECK(material_of<DiffuseTransmissionMaterial>(scene).scale == 2.0f);
    CHECK(contains(error_in_world("Material \"measured\""), "needs a \"string filename\""));
    CHECK(material_of<MeasuredMaterial>(with("Material \"measured\" \"string filename\" \"/a.bsdf\""))
              .file.path == "/a.bsdf");
    scene = with("Material \"ashikhminshirley\" \"float nu\" 10 \"float nv\" 1000");
    CHECK(texture_of<ConstantFloatTexture>(scene, material_of<AshikhminShirleyMaterial>(scene).nv).value ==
          1000.0f);
    CHECK_FALSE(
        material_of<PlasticMaterial>(with("Material \"plastic\" \"bool nonlinear\" false")).nonlinear);
    scene = with(
        "Material \"metallicroughness\" \"rgb basecolor\" [1 0.5 0.2] \"float metallic\" 0 \"float "
        "transmission\" 1 "
        "\"bool thinwalled\" false \"rgb attenuationcolor\" [0.5 1 1] \"float attenuationdistance\" 2 "
        "\"float "
        "clearcoat\" 1 \"rgb sheencolor\" [1 1 1] \"float anisotropyrotation\" 90 \"float ior\" 1.4");
    auto const& gltf = material_of<MetallicRoughnessMaterial>(scene);
    CHECK_FALSE(gltf.transmission.thin);
    // ln 2 / 2: after a length of 2 half the red is left.
    CHECK(as<RgbUnboundedSpd>(gltf.transmission.interior.absorption).rgb.x ==
          doctest::Approx(0.34657359).epsilon(1e-6));
    CHECK(as<RgbUnboundedSpd>(gltf.transmission.interior.absorption).rgb.y == 0.0f);
    CHECK(gltf.anisotropy.rotation == doctest::Approx(1.5707963));
    CHECK(gltf.multiscatter);
    CHECK(notes(scene).empty());
    validate(scene);
    CHECK(contains(error_in_world("Material \"metallicroughness\" \"float ior\" 0.5"), "at least 1"));
    CHECK(contains(notes(with("Material \"metallicroughness\" \"float absorption\" 2")),
                   "thin walls have no inside"));
}

TEST_CASE("interiors: priority and absorption") {
    auto const scene =
        with("Material \"dielectric\" \"integer priority\" 3 \"rgb absorption\" [0.1 0.2 0.3]");
    auto const& inside = material_of<DielectricMaterial>(scene).interior;
    CHECK(inside.priority == 3);
    CHECK(as<RgbUnboundedSpd>(inside.absorption).rgb.z == doctest::Approx(0.3));
    CHECK(
        contains(error_in_world("Material \"dielectric\" \"integer priority\" -1"), "must not be negative"));
    CHECK(contains(error_in_world("Material \"dielectric\" \"rgb absorption\" [0.1 -1 0]"), "negative"));
    CHECK(contains(error_in_world("Material \"dielectric\" \"rgb attenuationcolor\" [1 1 1] \"float "
                                  "attenuationdistance\" 0"),
                   "must be above 0"));
    CHECK(contains(error_of([&] { validate(with("Material \"dielectric\" \"float absorption\" -1")); }),
                   "must not be negative"));
}

TEST_CASE("normal maps and bumps belong to any surface, and to no mix") {
    auto scene =
        with("Texture \"d\" \"float\" \"constant\"\nMaterial \"dielectric\" \"texture displacement\" \"d\"");
    CHECK(scene[scene.world().objects[0].material].displacement.valid());
    scene = with("Material \"diffuse\" \"string normalmap\" \"/n.png\"");
    auto const id = scene[scene.world().objects[0].material].normal_map.image;
    REQUIRE(id.valid());
    CHECK(scene.images[id.value].encoding == "linear");
    CHECK(contains(notes(with("Material \"interface\" \"string normalmap\" \"/n.png\"")), "normalmap"));
}

TEST_CASE("unknown and old materials") {
    CHECK(contains(
        error_in_world("Material \"matte\""),
        "t.pbrt:2: Material \"matte\": material \"matte\" is of pbrt-v3; in pbrt-v4 write \"diffuse\""));
    CHECK(contains(error_in_world("Material \"difuse\""), "did you mean \"diffuse\"?"));
}

TEST_CASE("named materials") {
    auto const scene = read_world(R"(NamedMaterial "later" Shape "sphere"
        MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [1 0 0]
        MakeNamedMaterial "later" "string type" "dielectric"
        NamedMaterial "red" Shape "sphere" Shape "sphere")");
    material_of<DielectricMaterial>(scene, 0);
    material_of<DiffuseMaterial>(scene, 1);
    CHECK(scene.world().objects[1].material == scene.world().objects[2].material);
    CHECK(scene[scene.world().objects[1].material].name == "red");
    CHECK(scene.locate(scene[scene.world().objects[1].material].where) == "t.pbrt:3");
    std::string const unknown =
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\"\nNamedMaterial \"rad\"\n";
    CHECK(error_in_world(unknown + "Shape \"sphere\"") ==
          "t.pbrt:3: no material \"rad\" is defined (did you mean \"red\"?)");
    // As long as nothing is made of it, it is a slip only.
    auto const unused = read_world(unknown + "NamedMaterial \"red\" Shape \"sphere\"");
    CHECK(notes(unused) ==
          "t.pbrt:3: no material \"rad\" is defined (did you mean \"red\"?), but no shape uses it\n");
    validate(unused);
    CHECK(contains(error_in_world("MakeNamedMaterial \"a\""), "needs a \"string type\""));
    CHECK(contains(error_in_world("MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\nMakeNamedMaterial "
                                  "\"a\" \"string type\" \"diffuse\""),
                   "t.pbrt:3: material \"a\" is already defined"));
}

TEST_CASE("mixed materials") {
    std::string const two =
        "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"b\" \"string type\" "
        "\"dielectric\"\n";
    auto const scene =
        with(two + "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.25");
    auto const& m = material_of<MixMaterial>(scene);
    CHECK(scene[m.a].name == "a");
    CHECK(scene[m.b].name == "b");
    CHECK(texture_of<ConstantFloatTexture>(scene, m.amount).value == 0.25f);
    CHECK(contains(error_in_world("Material \"mix\" \"string materials\" [\"a\" \"b\"]"),
                   "no material \"a\" is defined"));
    // Named ones are made first, so one without a name may stand before them.
    auto const early =
        read_world("Material \"mix\" \"string materials\" [\"a\" \"b\"] Shape \"sphere\"\n" + two);
    CHECK(early[material_of<MixMaterial>(early).b].name == "b");
    CHECK(contains(
        error_in_world("MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"m\" \"m\"]"),
        "is defined before"));
    CHECK(contains(error_in_world("Material \"mix\""), "needs \"string materials\" with two names"));
}

TEST_CASE("mixes of mixes of the same are refused before they are evaluated 2^n times") {
    std::string text = "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n";
    for (int i = 1; i <= 64; ++i) {
        auto const below = "\"m" + std::to_string(i - 1) + "\" ";
        text += "MakeNamedMaterial \"m" + std::to_string(i) +
                "\" \"string type\" \"mix\" \"string materials\" [" + below + below + "]\n";
    }
    auto const message = error_of([&] { validate(read_world(text)); });
    CAPTURE(message);
    CHECK(message.starts_with("t.pbrt:13: the material takes more than 4096 evaluations"));
    // pbrt makes float textures before those of spectra, and pictures before all others.
    auto const forward = with(
        "Material \"diffuse\" \"texture reflectance\" \"s\" Texture \"s\" \"spectrum\" \"mix\" "
        "\"texture amount\" \"f\" \"texture tex1\" \"i\" Texture \"f\" \"float\" \"scale\" "
        "\"texture tex\" \"j\" Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"/a.png\" "
        "Texture \"j\" \"float\" \"imagemap\" \"string filename\" \"/b.png\"");
    CHECK(forward.images.size() == 2);
    CHECK(contains(
        error_in_world("Texture \"f\" \"float\" \"scale\" \"texture tex\" \"g\"\nTexture \"g\" \"float\" "
                       "\"constant\""),
        "t.pbrt:2: no float texture \"g\" is defined before this one"));
    std::string chain = "Texture \"t0\" \"float\" \"constant\"\n";
    for (int i = 1; i <= 64; ++i) {
        auto const below = " \"t" + std::to_string(i - 1) + "\"";
        chain += "Texture \"t" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex\"" + below +
                 " \"texture scale\"" + below + "\n";
    }
    chain += "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n";
    chain += "Material \"mix\" \"string materials\" [\"a\" \"a\"] \"texture amount\" \"t64\"";
    CHECK(error_of([&] {
              validate(read_world(chain));
          }).starts_with("t.pbrt:14: the texture takes more than 4096 evaluations"));
}

TEST_CASE("an index of refraction is above 0 at every wavelength") {
    for (char const* eta :
         {"\"spectrum eta\" [400 1.5 700 0]", "\"spectrum eta\" [400 -1 700 1.5]", "\"rgb eta\" [1.5 0 1.5]"})
        for (char const* type : {"dielectric", "thindielectric"}) {
            CAPTURE(eta);
            CHECK(contains(
                error_of([&] { validate(read_world("\nMaterial \"" + std::string(type) + "\" " + eta)); }),
                "t.pbrt:3: the index of refraction must be above 0"));
        }
}

TEST_CASE("textures") {
    auto const scene = with(R"(
        Scale 2 2 2
        Texture "i" "spectrum" "imagemap" "string filename" "/a.png" "string wrap" "clamp" "float scale" 3 "bool invert" true
            "string encoding" "gamma 2.2" "string filter" "trilinear" "float uscale" 4 "float vdelta" 5
        Texture "c" "spectrum" "checkerboard" "texture tex1" "i" "rgb tex2" [0.5 0.5 0.5] "integer dimension" 3
        Texture "f" "float" "constant" "float value" 0.75
        Texture "s" "spectrum" "scale" "texture tex" "c" "texture scale" "f"
        Texture "m" "spectrum" "mix" "texture tex1" "s"
        Identity
        Material "diffuse" "texture reflectance" "m")");
    auto const& mix = texture_of<MixTexture>(scene, material_of<DiffuseMaterial>(scene).reflectance);
    CHECK(texture_of<ConstantFloatTexture>(scene, mix.amount).value == 0.5f);
    CHECK(as<ConstantSpd>(spectrum(scene, mix.tex2)).value == 1);
    auto const& scaled = texture_of<ScaleTexture>(scene, mix.tex1);
    CHECK(texture_of<ConstantFloatTexture>(scene, scaled.scale).value == 0.75f);
    auto const& checks = texture_of<CheckerboardTexture>(scene, scaled.tex);
    CHECK(checks.dimension == 3);
    CHECK(checks.world_to_texture.m[0][0] == 0.5);
    auto const& image = texture_of<ImageTexture>(scene, checks.tex1);
    CHECK(scene[image.image].path == "/a.png");
    CHECK(scene[image.image].encoding == "gamma 2.2");
    CHECK(image.wrap == WrapMode::Clamp);
    CHECK(image.filter == FilterMode::Trilinear);
    CHECK(image.scale == 3);
    CHECK(image.invert);
    CHECK(image.is_spectrum);
    CHECK(as<UvMapping>(image.mapping).su == 4);
    CHECK(as<UvMapping>(image.mapping).dv == 5);
    CHECK(notes(scene).empty());
}

TEST_CASE("texture mappings") {
    auto const mapping = [](std::string const& text) {
        auto const scene =
            with("Translate 1 0 0 Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"/a.png\" " +
                 text + " Identity Material \"diffuse\" \"texture reflectance\" \"t\"");
        return texture_of<ImageTexture>(scene, material_of<DiffuseMaterial>(scene).reflectance).mapping;
    };
    CHECK(as<SphericalMapping>(mapping("\"string mapping\" \"spherical\"")).world_to_texture.m[0][3] == -1);
    CHECK(as<CylindricalMapping>(mapping("\"string mapping\" \"cylindrical\"")).world_to_texture.m[0][3] ==
          -1);
    auto const planar =
        as<PlanarMapping>(mapping("\"string mapping\" \"planar\" \"vector3 v1\" [0 0 2] \"float udelta\" 3"));
    CHECK(planar.v1 == Vec3{0, 0, 2});
    CHECK(planar.v2 == Vec3{0, 1, 0});
    CHECK(planar.du == 3);
    CHECK(planar.world_to_texture.m[0][3] == -1);
    CHECK(contains(error_of([&] { mapping("\"string mapping\" \"cubic\""); }), "use one of \"uv\""));
}

TEST_CASE("one texture in two roles") {
    auto const scene = with(R"(Texture "t" "spectrum" "constant" "rgb value" [0.5 0.5 0.5]
        Material "diffuse" "texture reflectance" "t" Shape "sphere"
        Material "conductor" "texture eta" "t" "texture k" "t")");
    as<RgbAlbedoSpd>(spectrum(scene, material_of<DiffuseMaterial>(scene, 0).reflectance));
    auto const& metal = material_of<ConductorMaterial>(scene, 1);
    as<RgbUnboundedSpd>(spectrum(scene, metal.eta));
    CHECK(metal.eta == metal.k);
}

TEST_CASE("textures that cannot be") {
    CHECK(error_in_world("Texture \"a\" \"spectrum\" \"scale\"\n \"texture tex\" \"b\"\nTexture \"b\" "
                         "\"spectrum\" \"scale\" \"texture tex\" \"a\"") ==
          "t.pbrt:3: no spectrum texture \"b\" is defined before this one");
    CHECK(error_in_world("Texture \"a\" \"spectrum\" \"scale\" \"texture tex\" \"a\"") ==
          "t.pbrt:2: no spectrum texture \"a\" is defined before this one");
    CHECK(error_in_world("Texture \"wood\" \"spectrum\" \"constant\"\nMaterial \"diffuse\" \"texture "
                         "reflectance\" \"wod\"") ==
          "t.pbrt:3: no spectrum texture \"wod\" is defined (did you mean \"wood\"?)");
    CHECK(contains(
        error_in_world(
            "Texture \"f\" \"float\" \"constant\"\nMaterial \"diffuse\" \"texture reflectance\" \"f\""),
        "needs a spectrum texture, and \"f\" is a float texture"));
    CHECK(contains(error_in_world("Texture \"a\" \"color\" \"constant\""), "\"color\" is pbrt-v3's name"));
    CHECK(
        contains(error_in_world("Texture \"a\" \"float\" \"constant\"\nTexture \"a\" \"float\" \"constant\""),
                 "t.pbrt:3: texture \"a\" is already defined at t.pbrt:2"));
    CHECK(contains(error_in_world("Texture \"a\" \"float\" \"imagemap\""), "needs a \"string filename\""));
    CHECK(contains(error_in_world("Texture \"a\" \"float\" \"chekerboard\""),
                   "did you mean \"checkerboard\"?"));
    std::string chain = "Texture \"t0\" \"float\" \"constant\"\n";
    for (int i = 1; i < 5000; ++i)
        chain += "Texture \"t" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex\" \"t" +
                 std::to_string(i - 1) + "\"\n";
    CHECK(contains(error_in_world(chain), "nested more than 512 deep"));
}

TEST_CASE("unused textures are checked, but not kept") {
    auto const scene =
        with("Texture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"/a.png\" \"float uscal\" 2");
    CHECK(scene.images.empty());
    CHECK(scene.textures.size() == 1);  // the default material's
    CHECK(contains(notes(scene), "did you mean \"uscale\"?"));
}

TEST_CASE("textures made of others and of noise, and their defaults") {
    auto const spectrum_of = [](std::string const& text) {
        return with(text + " Material \"diffuse\" \"texture reflectance\" \"t\"");
    };
    auto const float_of = [](std::string const& text) {
        return with("Translate 1 0 0 " + text + R"( Texture "m" "spectrum" "mix" "texture amount" "t"
            Material "diffuse" "texture reflectance" "m")");
    };
    auto const top = [](Scene const& s) { return material_of<DiffuseMaterial>(s).reflectance; };
    auto const amount = [&](Scene const& s) { return texture_of<MixTexture>(s, top(s)).amount; };
    auto const value = [](Scene const& s, TextureId id) { return as<ConstantSpd>(spectrum(s, id)).value; };

    auto s = spectrum_of("Texture \"t\" \"spectrum\" \"bilerp\" \"float uscale\" 3");
    auto const& bilerp = texture_of<BilerpTexture>(s, top(s));
    CHECK(as<UvMapping>(bilerp.mapping).su == 3);
    CHECK(value(s, bilerp.v00) == 0);
    CHECK(value(s, bilerp.v01) == 1);
    CHECK(value(s, bilerp.v10) == 0);
    CHECK(value(s, bilerp.v11) == 1);
    s = spectrum_of("Texture \"t\" \"spectrum\" \"dots\" \"float vdelta\" 2");
    auto const& dots = texture_of<DotsTexture>(s, top(s));
    CHECK(as<UvMapping>(dots.mapping).dv == 2);
    CHECK(value(s, dots.outside) == 1);  // pbrt-v4's "inside" is around the dots
    CHECK(value(s, dots.inside) == 0);
    s = spectrum_of("Texture \"t\" \"spectrum\" \"directionmix\"");
    auto const& mix = texture_of<DirectionMixTexture>(s, top(s));
    CHECK(value(s, mix.tex1) == 0);
    CHECK(value(s, mix.tex2) == 1);
    CHECK(mix.dir == Vec3{0, 1, 0});
    // The direction turns with the current transform, and comes out with length 1.
    s = spectrum_of(
        "Scale 1 2 1 Rotate 90 0 0 1 Texture \"t\" \"spectrum\" \"directionmix\" \"vector3 dir\" [5 0 0]");
    CHECK(std::abs(texture_of<DirectionMixTexture>(s, top(s)).dir.y - 1) < 1e-6f);
    s = spectrum_of("Translate 0 1 0 Texture \"t\" \"spectrum\" \"marble\"");
    auto const& marble = texture_of<MarbleTexture>(s, top(s));
    CHECK(marble.octaves == 8);
    CHECK(marble.roughness == 0.5f);
    CHECK(marble.scale == 1);
    CHECK(marble.variation == 0.2f);
    CHECK(marble.world_to_texture.m[1][3] == -1);
    CHECK(notes(s).empty());

    s = float_of("Texture \"t\" \"float\" \"fbm\"");
    auto const& fbm = texture_of<FbmTexture>(s, amount(s));
    CHECK(fbm.octaves == 8);
    CHECK(fbm.roughness == 0.5f);
    CHECK(fbm.world_to_texture.m[0][3] == -1);
    s = float_of("Texture \"t\" \"float\" \"wrinkled\" \"integer octaves\" 4 \"float roughness\" 0.25");
    CHECK(texture_of<WrinkledTexture>(s, amount(s)).octaves == 4);
    CHECK(texture_of<WrinkledTexture>(s, amount(s)).roughness == 0.25f);
    s = float_of("Texture \"t\" \"float\" \"windy\"");
    CHECK(texture_of<WindyTexture>(s, amount(s)).world_to_texture.m[0][3] == -1);
    validate(s);
    s = float_of("Texture \"t\" \"float\" \"bilerp\" \"float v00\" 0.25");
    CHECK(texture_of<ConstantFloatTexture>(s, texture_of<BilerpTexture>(s, amount(s)).v00).value == 0.25f);
    CHECK(notes(s).empty());
    s = with("Texture \"t\" \"float\" \"ptex\" \"string filename\" \"a.ptx\"");
    CHECK(notes(s) == "t.pbrt:2: Texture \"t\" \"ptex\": is not rendered: a constant 0.5 stands in\n");
}

TEST_CASE("textures of the wrong type, and numbers out of range") {
    auto const error = [](std::string const& text) { return error_in_world("Texture \"t\" " + text); };
    for (char const* kind : {"fbm", "wrinkled", "windy"})
        CHECK(contains(error("\"spectrum\" \"" + std::string(kind) + "\""), "t.pbrt:2: Texture \"t\""));
    CHECK(contains(error("\"spectrum\" \"fbm\""), "is a float texture only"));
    CHECK(contains(error("\"float\" \"marble\""), "is a spectrum texture only"));
    CHECK(contains(error("\"float\" \"fbm\" \"integer octaves\" -1"), "\"octaves\" must be 0 to 64"));
    CHECK(contains(error("\"float\" \"fbm\" \"integer octaves\" 2000000000"), "must be 0 to 64"));
    CHECK(contains(error("\"float\" \"directionmix\" \"vector3 dir\" [0 0 0]"), "without length"));
    CHECK(contains(error("\"float\" \"checkerboard\" \"integer dimension\" 4"), "must be 2 or 3"));
    std::string const picture = "\"spectrum\" \"imagemap\" \"string filename\" \"a.png\" ";
    CHECK(contains(error(picture + "\"float maxanisotropy\" 0.5"), "must be at least 1"));
    CHECK(contains(error(picture + "\n\"string encoding\" \"srgb\""), "must be \"linear\", \"sRGB\""));
    for (char const* encoding : {"gamma", "gamma x", "gamma 0", "gamma -1", "gamma nan", "linear ", "SRGB"})
        CHECK(contains(error(picture + "\"string encoding\" \"" + encoding + "\""), "\"encoding\" must be"));
    CHECK(contains(error(picture + "\"string filter\" \"box\""), "use one of"));
    CHECK(contains(error(picture + "\"string wrap\" \"mirror\""), "use one of"));
}
