// .ray files: Phong's terms and lights as our models.
#include "rays.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

Vec3 rgb(Scene const& scene, TextureId id) {
    return as<RgbAlbedoSpd>(texture_of<ConstantSpectrumTexture>(scene, id).value).rgb;
}
float number(Scene const& scene, TextureId id) { return texture_of<ConstantFloatTexture>(scene, id).value; }
template <class T>
T const& kind(Scene const& scene, MaterialId id) {
    return as<T>(scene[id].kind);
}
Scene sphere(std::string const& material) { return valid_ray("sphere { material = { " + material + " } }"); }

}  // namespace

TEST_CASE("diffuse, without a note; and nothing at all is black") {
    auto const scene = sphere("diffuse = (0.1, 0.2, 0.3)");
    CHECK(rgb(scene, material_of<DiffuseMaterial>(scene).reflectance) == Vec3{0.1f, 0.2f, 0.3f});
    CHECK(scene.notes.size() == 1);  // there is no camera
    auto const black = valid_ray("sphere {}");
    CHECK(rgb(black, material_of<DiffuseMaterial>(black).reflectance) == Vec3{0});
    CHECK(contains(notes(sphere("diffuse = (0.1, -0.2, 0.3)")), "t.ray:2: diffuse: what is negative"));
}

TEST_CASE("too much is scaled down, with a note") {
    auto const scene = sphere("diffuse = (2, 1, 0)");
    CHECK(rgb(scene, material_of<DiffuseMaterial>(scene).reflectance) == Vec3{1, 0.5f, 0});
    CHECK(contains(notes(scene), "t.ray:2: more light would leave than arrives"));
    // 0.7 + 0.3 is no more than 1.
    CHECK_FALSE(contains(notes(sphere("diffuse = (0.7,0.7,0.7); reflective = (0.3,0.3,0.3)")), "more light"));
}

TEST_CASE("specular: a lobe of four times the exponent, as bright as Phong's") {
    auto const scene =
        sphere("diffuse = (0.5,0.5,0.5); specular = (0.9,0.6,0.3); reflective = (0,0,0); shininess = 50");
    auto const& m = material_of<AshikhminShirleyMaterial>(scene);
    CHECK(number(scene, m.nu) == 200);
    CHECK(m.nu == m.nv);
    CHECK(rgb(scene, m.reflectance) == Vec3{0.5f});
    Vec3 const s = rgb(scene, m.specular);
    CHECK(s.x == doctest::Approx(0.9 * 8 / 201));
    CHECK(s.z == doctest::Approx(0.3 * 8 / 201));
    CHECK(contains(notes(scene), "t.ray:2: specular: "));
    // Old files count from 0 to 1; and a lobe never has more than k_s.
    auto const old = sphere("specular = (0.9,0.6,0.3); reflective = (0,0,0); shininess = 0.5");
    CHECK(number(old, material_of<AshikhminShirleyMaterial>(old).nu) == 256);
    CHECK(contains(notes(old), "share of 128"));
    auto const dull = sphere("specular = (0.9,0.6,0.3); reflective = (0,0,0)");
    CHECK(rgb(dull, material_of<AshikhminShirleyMaterial>(dull).specular) == Vec3{0.9f, 0.6f, 0.3f});
}

TEST_CASE("reflective: a mirror's share, which is that of specular where nothing is said") {
    auto const check = [](std::string const& text, float share) {
        auto const scene = sphere(text);
        auto const& mix = material_of<MixMaterial>(scene);
        CHECK(number(scene, mix.amount) == doctest::Approx(share));
        auto const& metal = kind<ConductorMaterial>(scene, mix.b);
        // Whatever the parts' shares, what they contribute is what the file says.
        Vec3 const mirrored = rgb(scene, metal.reflectance) * number(scene, mix.amount);
        CHECK(mirrored.x == doctest::Approx(0.4));
        CHECK(mirrored.y == doctest::Approx(0.2));
        CHECK(contains(notes(scene), "t.ray:2: reflective: a smooth metal"));
        return scene;
    };
    auto const scene = check("diffuse = (0.4,0.2,0.1); reflective = (0.4,0.2,0.1)", 0.5f);
    auto const& mix = material_of<MixMaterial>(scene);
    CHECK(rgb(scene, kind<DiffuseMaterial>(scene, mix.a).reflectance).y * (1 - number(scene, mix.amount)) ==
          doctest::Approx(0.2));
    check("diffuse = (0.4,0.2,0.1); specular = (0.4,0.2,0.1); shininess = 1000", 0.5f);
    check("reflective = (0.4,0.2,0.1); diffuse = (0.4,0.2,0.1); specular = (0.1,0.1,0.1); shininess = 1000",
          0.5f);
    auto const alone = sphere("reflective = (0.4,0.2,0.1)");
    CHECK(rgb(alone, material_of<ConductorMaterial>(alone).reflectance).x == doctest::Approx(0.4f));
}

TEST_CASE("transmissive: glass of the index, tinted, or what light passes straight") {
    auto const glass = sphere("transmissive = (1,1,1); index = 1.5; reflective = (0.5,0.5,0.5)");
    CHECK(as<ConstantSpd>(material_of<DielectricMaterial>(glass).eta).value == 1.5f);
    CHECK(contains(notes(glass), "t.ray:2: transmissive: a smooth dielectric"));
    auto const tinted = sphere("transmissive = (1,0.5,0.2); index = 1.5");
    auto const& t = material_of<MetallicRoughnessMaterial>(tinted);
    CHECK(rgb(tinted, t.base_color) == Vec3{1, 0.5f, 0.2f});
    CHECK(t.index.ior == 1.5f);
    CHECK_FALSE(t.transmission.thin);
    auto const straight = sphere("transmissive = (0.8,0.5,0.2)");
    auto const& s = material_of<MetallicRoughnessMaterial>(straight);
    CHECK(s.transmission.thin);
    CHECK(number(straight, s.specular.factor) == 0);
    CHECK(number(straight, s.roughness) == 0);
    CHECK(contains(notes(sphere("transmissive = (0.8,0.5,0.2); index = 0.8")), "an index below 1"));
    // All three kinds at once still are one material.
    auto const all =
        sphere("diffuse = (0.2,0.2,0.2); reflective = (0.2,0.2,0.2); transmissive = (0.4,0.4,0.4)");
    auto const& outer = material_of<MixMaterial>(all);
    CHECK(number(all, outer.amount) == doctest::Approx(0.5));
    CHECK(number(all, kind<MixMaterial>(all, outer.a).amount) == doctest::Approx(0.5));
}

TEST_CASE("emissive: an area light, on both sides where the shape is open") {
    auto const scene =
        valid_ray("material = { emissive = (3, 2, 1) } sphere {} square {} cylinder { capped = false }");
    for (auto const& o : scene.world().objects) {
        REQUIRE(o.light);
        CHECK(as<RgbIlluminantSpd>(o.light->radiance).rgb == Vec3{3, 2, 1});
    }
    CHECK_FALSE(scene.world().objects[0].light->two_sided);
    CHECK(scene.world().objects[1].light->two_sided);
    CHECK(scene.world().objects[2].light->two_sided);
}

TEST_CASE("a shape's second material begins as the default in force, not as its first") {
    auto const at = [](Scene const& scene, std::size_t object) {
        return rgb(scene, kind<DiffuseMaterial>(scene, scene.world().objects[object].material).reflectance);
    };
    std::string const twice = " material = { diffuse = (0,1,0) } material = { emissive = (1,1,1) } ";
    auto const scene = valid_ray("sphere {" + twice + "} cone {" + twice +
                                 "}\nmaterial = { diffuse = (0,0,1) } sphere {" + twice + "}");
    CHECK(at(scene, 0) == Vec3{0});
    CHECK(at(scene, 1) == Vec3{0});
    CHECK(at(scene, 2) == Vec3{0, 0, 1});
    CHECK(contains(notes(scene), "t.ray:2: sphere: \"material\" is given twice: the last one counts"));
    // Materials of points, whatever the order.
    std::string const one = " material = { diffuse = (0,1,0) } ";
    std::string const all = " materials = ({ emissive = (1,1,1) }, {}, {}) ";
    std::string const mesh = "polymesh { points = ((0,0,0),(1,0,0),(0,1,0)) faces = ((0,1,2)) ";
    auto const meshes =
        valid_ray("material = { diffuse = (0,0,1) }\n" + mesh + one + all + "}" + mesh + all + one + "}");
    CHECK(at(meshes, 0) == Vec3{0, 0, 1});
    CHECK(at(meshes, 1) == Vec3{0, 0, 1});
}

TEST_CASE("materials: defaults, what they pass on, names") {
    auto const scene = valid_ray(
        "material { name = gray; diffuse = (0.5,0.5,0.5) }\nsphere {}\nmaterial = { name = red; diffuse = "
        "(0.9,0,0) }\n"
        "sphere {} sphere { material = gray } sphere { material = { emissive = (1,1,1) } }\n"
        "{ material = gray; sphere {} { material = \"red\" sphere {} } sphere {} } sphere {}");
    auto const colour = [&](std::size_t i) {
        return rgb(scene, material_of<DiffuseMaterial>(scene, i).reflectance).x;
    };
    CHECK(colour(0) == 0);  // a name alone sets nothing
    CHECK(colour(1) == 0.9f);
    CHECK(colour(2) == 0.5f);
    CHECK(colour(3) == 0.9f);  // begins as the default
    CHECK(scene.world().objects[3].light);
    CHECK(colour(4) == 0.5f);
    CHECK(colour(5) == 0.9f);
    CHECK(colour(6) == 0.5f);
    CHECK(colour(7) == 0.9f);  // groups keep theirs to themselves
    // The same terms are one material.
    CHECK(scene.world().objects[1].material == scene.world().objects[7].material);
}

TEST_CASE("maps are pictures, beside the file, scaled where the sum asks for it") {
    Folder const folder;
    auto const scene = read_scene(folder.write(
        "t.ray",
        "SBT-raytracer 1.1\nsphere { material = { diffuse = map(\"tex\\wood.bmp\"); reflective = (1,1,1);\n"
        "shininess = map(\"x.bmp\") } }"));
    REQUIRE(scene.images.size() == 1);
    CHECK(scene.images[0].path == (folder.path() / "tex/wood.bmp").string());
    auto const& mix = material_of<MixMaterial>(scene);
    auto const& picture = texture_of<ImageTexture>(scene, kind<DiffuseMaterial>(scene, mix.a).reflectance);
    CHECK(picture.scale * (1 - number(scene, mix.amount)) == doctest::Approx(0.5));
    CHECK(contains(notes(scene), "t.ray:3: shininess cannot vary over a surface: its map is not used"));
}

TEST_CASE("lights: intensities") {
    auto const scene = valid_ray(
        "translate(0, 0, -5, scale(2, box {}))\n"
        "point_light { position = (0,0,5); color = (1,0.5,0.25) }\n"
        "point_light { position = (0,0,5); colour = (1,1,1); quadratic_attenuation_coeff = 0.25 }\n"
        "point_light { position = (0,0,5); color = (1,1,1); constant_attenuation_coeff = 2;\n"
        "  linear_attenuation_coeff = 0.1; quadratic_attenuation_coeff = 0 }\n"
        "directional_light { direction = (0,-2,0); color = (1,2,3) }\nambient_light { color = (0.1,0.2,0.3) "
        "}");
    REQUIRE(scene.lights.size() == 5);
    auto const& sun = as<DistantLight>(scene.lights[0].kind);
    CHECK(sun.scale == doctest::Approx(double{kPi}));
    CHECK(sun.to - sun.from == Vec3{0, -2, 0});
    auto const& sky = as<InfiniteLight>(scene.lights[1].kind);
    CHECK(as<RgbIlluminantSpd>(sky.radiance).rgb == Vec3{0.1f, 0.2f, 0.3f});
    CHECK(sky.scale == 1);
    auto const scale = [&](std::size_t i) { return as<PointLight>(scene.lights[i].kind).scale; };
    CHECK(scale(2) == doctest::Approx(double{kPi}));
    CHECK(scale(3) == doctest::Approx(4 * double{kPi}));
    // 10 from the centre, attenuated by 2 + 0.1 * 10 = 3.
    CHECK(scale(4) == doctest::Approx(double{kPi} * 100 / 3));
    auto const text = notes(scene);
    CHECK(contains(text, "t.ray:5: light falls off with the square of the distance here"));
    CHECK_FALSE(contains(text, "t.ray:4: light falls off"));
    // Those programs let no light be brighter than its colour.
    auto const bright = valid_ray(
        "sphere {} point_light { position = (0,0,2); color = (1,1,1); "
        "constant_attenuation_coeff = 0.25; quadratic_attenuation_coeff = 0 }");
    CHECK(as<PointLight>(bright.lights[0].kind).scale == doctest::Approx(double{kPi} * 4));
    // Also where the quadratic coefficient is the only one, at distances at which it would make them so.
    auto const quadratic = [](std::string const& coefficient) {
        return valid_ray("sphere {} point_light { position = (0,0,4); color = (1,1,1); " + coefficient +
                         " }");
    };
    auto const near = quadratic("quadratic_attenuation_coeff = 0.001");
    CHECK(as<PointLight>(near.lights[0].kind).scale == doctest::Approx(double{kPi} * 16));
    CHECK(contains(notes(near), "t.ray:2: light falls off with the square of the distance here"));
    auto const far = quadratic("quadratic_attenuation_coeff = 0.0625");
    CHECK(as<PointLight>(far.lights[0].kind).scale == doctest::Approx(double{kPi} * 16));
    CHECK_FALSE(contains(notes(far), "light falls off"));
    // Black is no sky; and what differs from it in colour is said.
    CHECK(valid_ray("ambient_light { color = (0,0,0) }").lights.empty());
    std::string const odd = "sphere { material = { diffuse = (1,1,1) } }";
    CHECK(contains(notes(read_ray(odd + "ambient_light { color = (1,1,1) }")), "t.ray:2: ambient differs"));
    CHECK_FALSE(contains(notes(read_ray(odd)), "ambient differs"));
}

TEST_CASE("area lights: a ball as bright as the point light, and a parallelogram") {
    auto const scene = valid_ray(
        "area_light { position = (1,2,3); color = (1,1,1); light_radius = 0.5; quadratic_attenuation_coeff = "
        "2 }\n"
        "area_light { position = (1,2,3); colour = (4,5,6); u = (1,0,0); v = (0,0,1) }");
    REQUIRE(scene.world().objects.size() == 2);
    auto const& quad = shape_of<Quad>(scene, 0);
    CHECK(quad.origin == Vec3{1, 2, 3});
    CHECK(cross(quad.edge_u, quad.edge_v) == Vec3{0, -1, 0});
    auto const& flat = scene.world().objects[0].light;
    REQUIRE(flat);
    CHECK(as<RgbIlluminantSpd>(flat->radiance).rgb == Vec3{4, 5, 6});
    CHECK_FALSE(flat->two_sided);
    CHECK(shape_of<Sphere>(scene, 1).radius == 0.5f);
    auto const& ball = scene.world().objects[1].light;
    REQUIRE(ball);
    // Its intensity pi r^2 L is the point light's, pi / 2.
    CHECK(ball->scale * 0.25f == doctest::Approx(0.5));
}
