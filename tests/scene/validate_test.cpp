#include "sample_scene.h"

#include <doctest/doctest.h>

#include <functional>
#include <limits>

using namespace nephroid;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Fault {
    char const* message;  // that it must hold, after file:line
    std::function<void(Scene&)> spoil;
    ErrorKind kind = ErrorKind::Input;
};

void refused(Scene const& scene, std::string const& message, ErrorKind kind = ErrorKind::Input) {
    try {
        validate(scene);
        FAIL_CHECK("accepted: " << message);
    } catch (Error const& e) {
        std::string const what = e.what();
        CAPTURE(what);
        CHECK(what.find(message) != std::string::npos);
        CHECK(e.kind() == kind);
    }
}

void all_refused(std::vector<Fault> const& faults) {
    for (Fault const& fault : faults) {
        Scene scene = sample_scene();
        fault.spoil(scene);
        refused(scene, fault.message, fault.kind);
    }
}

TriangleMesh& mesh(Scene& s) { return std::get<TriangleMesh>(s.groups[1].objects[0].shape); }
Fault shape_fault(char const* message, Shape shape) {
    return {message, [shape](Scene& s) { s.world().objects[0].shape = shape; }};
}

/// Makes texture 3, which stands in line 6 and is the reflectance of a material, something else.
auto texture(TextureKind kind) {
    return [kind](Scene& s) { s.textures[3].kind = kind; };
}

}  // namespace

TEST_CASE("good scenes pass") {
    validate(sample_scene());
    validate(Scene{});
    Scene s = sample_scene();
    s.settings.film.max_component = kInfinity;
    std::get<SpotLight>(s.lights[0].kind).scale = 0;
    validate(s);
}

TEST_CASE("places are named by file and line") {
    Scene const s = sample_scene();
    CHECK(s.locate({0, 12}) == "scene.pbrt:12");
    CHECK(s.locate({0, 0}) == "scene.pbrt");
    CHECK(s.locate({}) == "scene");
    CHECK_THROWS_WITH_AS(s.fail({0, 3}, "wrong: do right"), "scene.pbrt:3: wrong: do right", Error);
}

TEST_CASE("a picture named twice is one entry; another encoding is another") {
    Scene s;
    CHECK(s.add(ImageFile{"a.png", "", {}}) == ImageId{0});
    CHECK(s.add(ImageFile{"b.png", "", {}}) == ImageId{1});
    CHECK(s.add(ImageFile{"a.png", "", {0, 7}}) == ImageId{0});
    CHECK(s.add(ImageFile{"a.png", "linear", {}}) == ImageId{2});
    // Whoever shortens the list need not tell.
    s.images.resize(1);
    CHECK(s.add(ImageFile{"b.png", "linear", {}}) == ImageId{1});
    CHECK(s.add(ImageFile{"b.png", "", {}}) == ImageId{2});
    CHECK(s.add(ImageFile{"a.png", "", {}}) == ImageId{0});
    CHECK(s.images.size() == 3);
}

TEST_CASE("a hundred thousand pictures do not take forever") {
    Scene s;
    for (int i = 0; i < 100'000; ++i) s.add(ImageFile{std::to_string(i) + ".png", "", {}});
    CHECK(s.images.size() == 100'000);
}

TEST_CASE("ids out of range are refused with their place") {
    all_refused({
        {"scene.pbrt:6: the texture names texture 99, but there are only 4",
         [](Scene& s) { std::get<MixTexture>(s.textures[3].kind).amount = TextureId{99}; }},
        {"scene.pbrt:5: the texture names image 1",
         [](Scene& s) { std::get<ImageTexture>(s.textures[2].kind).image = ImageId{1}; }},
        {"scene.pbrt:5: the image texture names no picture",
         [](Scene& s) { std::get<ImageTexture>(s.textures[2].kind).image = {}; }},
        {"scene.pbrt:6: the texture is made of others",
         [](Scene& s) { std::get<MixTexture>(s.textures[3].kind).tex2 = {}; }},
        {"scene.pbrt:9: the material names material 3",
         [](Scene& s) { std::get<MixMaterial>(s.materials[2].kind).b = MaterialId{3}; }},
        {"scene.pbrt:9: the mix names fewer",
         [](Scene& s) { std::get<MixMaterial>(s.materials[2].kind).b = {}; }},
        {"scene.pbrt:11: the light names image 5",
         [](Scene& s) { std::get<InfiniteLight>(s.lights[1].kind).image = ImageId{5}; }},
        {"scene.pbrt:13: the object names material 3",
         [](Scene& s) { s.groups[1].objects[0].material = MaterialId{3}; }},
        {"scene.pbrt:14: the object's alpha names texture",
         [](Scene& s) { s.world().objects[0].alpha = TextureId{4}; }},
        {"scene.pbrt:15: the light names image",
         [](Scene& s) { s.world().objects[0].light->image = ImageId{1}; }},
        {"scene.pbrt:16: the instance names group 2",
         [](Scene& s) { s.world().instances[0].group = GroupId{2}; }},
        {"scene.pbrt:16: the instance names no group", [](Scene& s) { s.world().instances[0].group = {}; }},
        {"there is no world", [](Scene& s) { s.groups.clear(); }},
    });
}

TEST_CASE("shapes out of range are refused") {
    all_refused({
        {"scene.pbrt:13: the mesh's face 0 names vertex 3, but there are 3",
         [](Scene& s) { mesh(s).triangles[0].z = 3; }},
        {"names vertex -1", [](Scene& s) { mesh(s).triangles[0].x = -1; }},
        {"scene.pbrt:13: the shape holds a number that is not finite",
         [](Scene& s) { mesh(s).p[2].y = kNan; }},
        {"not finite", [](Scene& s) { mesh(s).p[2].y = kInfinity; }},
        {"as many normals", [](Scene& s) { mesh(s).n.resize(2); }},
        {"as many texture coordinates", [](Scene& s) { mesh(s).uv.resize(4); }},
        shape_fault("names vertex 4", BilinearMesh{.p = std::vector<Vec3>(4), .patches = {{0, 1, 2, 4}}}),
        shape_fault("names vertex 9", LoopSubdivision{.p = std::vector<Vec3>(3), .triangles = {{0, 1, 9}}}),
        shape_fault("levels must not be negative", LoopSubdivision{.levels = -1}),
        {"levels of subdivision",
         [](Scene& s) { s.world().objects[0].shape = LoopSubdivision{.levels = 13}; }, ErrorKind::Limit},
        shape_fault("scene.pbrt:14: the sphere's radius", Sphere{.radius = 0}),
        shape_fault("the sphere's radius", Sphere{.radius = -1}),
        shape_fault("not finite", Sphere{.radius = kNan}),
        shape_fault("zmin and zmax leave nothing", Sphere{.z_min = 0.5f, .z_max = 0.5f}),
        shape_fault("zmin and zmax leave nothing", Sphere{.z_min = 1, .z_max = 2}),
        shape_fault("phimax", Sphere{.phi_max = 7}),
        shape_fault("the cylinder's radius", Cylinder{.radius = 0}),
        shape_fault("the cylinder's zmin", Cylinder{.z_min = 1, .z_max = 0}),
        shape_fault("phimax", Cylinder{.phi_max = 0}),
        shape_fault("the disk's radius", Disk{.radius = 0}),
        shape_fault("inner radius", Disk{.inner_radius = 1}),
        shape_fault("inner radius", Disk{.inner_radius = -0.5f}),
        shape_fault("lower corner", Box{{1, 0, 0}, {0, 1, 1}}),
        shape_fault("the quad has no area", Quad{.edge_u = {0, 4, 0}}),
    });
}

TEST_CASE("spectra, textures and materials out of range are refused") {
    auto const eta = [](Spd spd) {
        return [spd](Scene& s) { s.materials[1].kind = DielectricMaterial{spd}; };
    };
    all_refused({
        {"scene.pbrt:8: the index of refraction must be above 0", eta(ConstantSpd{0})},
        {"the index of refraction must be above 0", eta(ConstantSpd{-1})},
        {"must be between 0.001 and 1000", eta(ConstantSpd{1e20f})},
        {"must be between 0.001 and 1000", eta(ConstantSpd{1e-20f})},
        {"the index of refraction holds a number that is not finite", eta(ConstantSpd{kInfinity})},
        {"must increase", eta(TabulatedSpd{{400, 400}, {1, 1}})},
        {"must increase", eta(TabulatedSpd{{500, 400}, {1, 1}})},
        {"not finite", eta(TabulatedSpd{{400, 500}, {1, kNan}})},
        {"as many values", eta(TabulatedSpd{{400, 500}, {1}})},
        {"is empty", eta(TabulatedSpd{})},
        {"temperature", eta(BlackbodySpd{0})},
        {"name is empty", eta(NamedSpd{})},
        {"scene.pbrt:4: the texture holds",
         [](Scene& s) { s.textures[1].kind = ConstantFloatTexture{kNan}; }},
        {"the texture's scale holds",
         [](Scene& s) { std::get<ImageTexture>(s.textures[2].kind).scale = kNan; }},
        {"scene.pbrt:5: the texture's transform cannot be inverted",
         [](Scene& s) {
             std::get<ImageTexture>(s.textures[2].kind).mapping = SphericalMapping{scale(0, 1, 1)};
         }},
        {"2 or 3 dimensions",
         [](Scene& s) {
             s.textures[3].kind =
                 CheckerboardTexture{.dimension = 1, .tex1 = TextureId{0}, .tex2 = TextureId{0}};
         }},
        {"maxanisotropy must be at least 1",
         [](Scene& s) { std::get<ImageTexture>(s.textures[2].kind).max_anisotropy = kNan; }},
        {"scene.pbrt:6: the texture's octaves must be 0 to 64", texture(FbmTexture{.octaves = 65})},
        {"octaves must be 0 to 64", texture(WrinkledTexture{.octaves = -1})},
        {"the texture holds a number that is not finite", texture(MarbleTexture{.variation = kNan})},
        {"the texture's transform cannot be inverted", texture(WindyTexture{scale(1, 0, 1)})},
        {"direction has no length", texture(DirectionMixTexture{TextureId{0}, TextureId{0}, Vec3{0}})},
        {"direction holds", texture(DirectionMixTexture{TextureId{0}, TextureId{0}, Vec3{kNan}})},
        {"is made of others but names none", texture(BilerpTexture{.v00 = TextureId{0}})},
        {"is made of others but names none", texture(DotsTexture{.inside = TextureId{0}})},
    });
}

TEST_CASE("textures are of the kind that is needed, and there where they are needed") {
    TextureId const grey{0}, half{1};  // a spectrum, a float
    auto const material = [](MaterialKind kind) { return [kind](Scene& s) { s.materials[1].kind = kind; }; };
    all_refused({
        {"scene.pbrt:8: the diffuse material names no reflectance", material(DiffuseMaterial{})},
        {"the conductor needs", material(ConductorMaterial{.eta = grey})},
        {"the mix names no amount", material(MixMaterial{.a = MaterialId{0}, .b = MaterialId{0}})},
        {"scene.pbrt:8: the reflectance needs a spectrum", material(DiffuseMaterial{half})},
        {"the reflectance needs a spectrum", material(ConductorMaterial{.reflectance = half})},
        {"the index eta needs a spectrum", material(ConductorMaterial{.eta = half, .k = grey})},
        {"the absorption k needs a spectrum", material(ConductorMaterial{.eta = grey, .k = half})},
        {"the mix's amount needs a float", material(MixMaterial{MaterialId{0}, MaterialId{0}, grey})},
        {"scene.pbrt:6: the mix's second texture needs a spectrum", texture(MixTexture{grey, half, half})},
        {"the mix's amount needs a float", texture(MixTexture{grey, grey, grey})},
        {"the texture's scale needs a float", texture(ScaleTexture{grey, grey})},
        {"the mix's second texture needs a spectrum", texture(DirectionMixTexture{grey, half})},
        {"each corner of the bilerp needs a float", texture(BilerpTexture{{}, half, half, grey, half})},
        {"each corner of the bilerp needs a float", texture(BilerpTexture{{}, half, half, half, grey})},
        {"the pattern of dots's second texture needs a spectrum", texture(DotsTexture{{}, half, grey})},
        {"scene.pbrt:7: the reflectance needs a spectrum", texture(FbmTexture{})},
        {"the reflectance needs a spectrum", texture(WindyTexture{})},
        {"the reflectance needs a spectrum", texture(WrinkledTexture{})},
        {"the mix's amount needs a float", [](Scene& s) { s.textures[1].kind = MarbleTexture{}; }},
        {"the checkerboard's second texture needs a float",
         texture(CheckerboardTexture{.tex1 = half, .tex2 = grey})},
        {"scene.pbrt:7: the reflectance needs a spectrum", texture(ScaleTexture{half, half})},
        {"scene.pbrt:14: the object's alpha needs a float",
         [&](Scene& s) { s.world().objects[0].alpha = grey; }},
    });
}

TEST_CASE("transforms must be finite, affine and invertible") {
    all_refused({
        {"scene.pbrt:14: the object's transform cannot be inverted",
         [](Scene& s) { s.world().objects[0].to_group = scale(1, 0, 1); }},
        {"scene.pbrt:14: the object's transform holds",
         [](Scene& s) { s.world().objects[0].to_group = translate(0, std::nan(""), 0); }},
        {"overflows", [](Scene& s) { s.world().objects[0].to_group = scale(1e300, 1, 1); }},
        {"is projective", [](Scene& s) { s.world().objects[0].to_group = perspective(60, 1, 10); }},
        {"scene.pbrt:16: the instance's transform",
         [](Scene& s) { s.world().instances[0].to_parent[1][1] = 0; }},
        {"scene.pbrt:10: the light's transform", [](Scene& s) { s.lights[0].to_world = scale(0, 0, 0); }},
        {"scene.pbrt:1: the camera's transform", [](Scene& s) { s.camera.to_world = scale(0, 1, 1); }},
    });
}

TEST_CASE("lights out of range are refused") {
    auto const spot = [](auto change) {
        return [change](Scene& s) { change(std::get<SpotLight>(s.lights[0].kind)); };
    };
    auto const day = [](auto change) {
        return [change](Scene& s) { change(s.lights[1].kind.emplace<SunSkyLight>()); };
    };
    all_refused({
        {"scene.pbrt:10: the light's scale", spot([](SpotLight& l) { l.scale = -1; })},
        {"the light's scale", spot([](SpotLight& l) { l.scale = kNan; })},
        {"the light's power", spot([](SpotLight& l) { l.power = kNan; })},
        {"give it a direction", spot([](SpotLight& l) { l.to = l.from; })},
        {"must be finite", spot([](SpotLight& l) { l.to.x = kNan; })},
        {"cone must be", spot([](SpotLight& l) { l.cone_angle = 0; })},
        {"conedeltaangle", spot([](SpotLight& l) { l.cone_delta = 2; })},
        {"the light's spectrum", spot([](SpotLight& l) {
             l.intensity = RgbIlluminantSpd{{1, kNan, 1}};
         })},
        {"scene.pbrt:11: the light's scale",
         [](Scene& s) { std::get<InfiniteLight>(s.lights[1].kind).scale = -1; }},
        {"scene.pbrt:11: the sky's turbidity", day([](SunSkyLight& l) { l.turbidity = 1.5f; })},
        {"scene.pbrt:11: the sky's turbidity", day([](SunSkyLight& l) { l.turbidity = kNan; })},
        {"direction of the sun", day([](SunSkyLight& l) {
             l.sun_direction = {0, 0, 0};
         })},
        {"direction of the sun", day([](SunSkyLight& l) { l.sun_direction.x = kNan; })},
        {"below the horizon", day([](SunSkyLight& l) { l.sun_direction.z = -0.1f; })},
        {"half of the sun's angle", day([](SunSkyLight& l) { l.sun_radius = 0; })},
        {"neither sun nor sky", day([](SunSkyLight& l) { l.sun = l.sky = false; })},
        {"scene.pbrt:15: the light's scale", [](Scene& s) { s.world().objects[0].light->scale = -1; }},
    });
}

TEST_CASE("cameras and settings out of range are refused") {
    auto const camera = [](auto change) {
        return [change](Scene& s) { change(std::get<PerspectiveCamera>(s.camera.kind)); };
    };
    all_refused({
        {"scene.pbrt:1: the camera's fov", camera([](auto& c) { c.fov = 0; })},
        {"the camera's fov", camera([](auto& c) { c.fov = 3.1415927f; })},
        {"not finite", camera([](auto& c) { c.fov = kNan; })},
        {"lens radius", camera([](auto& c) { c.lens_radius = -1; })},
        {"focal distance", camera([](auto& c) { c.focal_distance = 0; })},
        {"screen window",
         [](Scene& s) {
             s.camera.screen_window = std::array<float, 4>{1, -1, -1, 1};
         }},
        {"aspect ratio", [](Scene& s) { s.camera.frame_aspect_ratio = 0.0f; }},
        {"shutter", [](Scene& s) { s.camera.exposure_time = -1; }},
        {"at least 1 pixel",
         [](Scene& s) {
             s.settings.film.resolution = {0, 10};
         }},
        {"at most 65536",
         [](Scene& s) {
             s.settings.film.resolution = {65537, 1};
         },
         ErrorKind::Limit},
        {"2^28",
         [](Scene& s) {
             s.settings.film.resolution = {16385, 16384};
         },
         ErrorKind::Limit},
        {"crop window",
         [](Scene& s) {
             s.settings.film.crop = std::array<int, 4>{0, 65, 0, 48};
         }},
        {"crop window",
         [](Scene& s) {
             s.settings.film.crop = std::array<int, 4>{-1, 3, 0, 48};
         }},
        {"crop window",
         [](Scene& s) {
             s.settings.film.crop = std::array<int, 4>{0, 10, 5, 5};
         }},
        {"ISO", [](Scene& s) { s.settings.film.iso = 0; }},
        {"white balance", [](Scene& s) { s.settings.film.white_balance = -1; }},
        {"largest component", [](Scene& s) { s.settings.film.max_component = 0; }},
        {"largest component", [](Scene& s) { s.settings.film.max_component = kNan; }},
        {"filter's radii",
         [](Scene& s) {
             s.settings.filter = BoxFilter{{0.5f, 0}};
         }},
        {"sigma", [](Scene& s) { s.settings.filter = GaussianFilter{.sigma = 0}; }},
        {"tau", [](Scene& s) { s.settings.filter = LanczosSincFilter{.tau = 0}; }},
        {"the pixel filter holds", [](Scene& s) { s.settings.filter = MitchellFilter{.b = kNan}; }},
        {"one stratum", [](Scene& s) { s.settings.sampler = StratifiedSampler{.x_strata = 0}; }},
        {"2^28 strata",
         [](Scene& s) {
             s.settings.sampler = StratifiedSampler{65536, 65536};
         },
         ErrorKind::Limit},
        {"1 sample a pixel", [](Scene& s) { s.settings.spp = 0; }},
        {"maxdepth", [](Scene& s) { s.settings.integrator = WhittedIntegrator{-1}; }},
        {"roulette", [](Scene& s) { s.settings.integrator = PathIntegrator{.roulette = {.alpha = 0}}; }},
        {"roulette", [](Scene& s) { s.settings.integrator = PathIntegrator{.roulette = {.alpha = 1.5f}}; }},
    });
}

TEST_CASE("cycles are refused") {
    all_refused({
        {"scene.pbrt:6: the texture contains itself",
         [](Scene& s) { std::get<MixTexture>(s.textures[3].kind).tex1 = TextureId{3}; }},
        {"the texture contains itself",
         [](Scene& s) {
             s.textures[0].kind = ScaleTexture{TextureId{1}, TextureId{3}};
         }},
        {"scene.pbrt:9: the material contains itself",
         [](Scene& s) { std::get<MixMaterial>(s.materials[2].kind).a = MaterialId{2}; }},
        {"the group contains itself",
         [](Scene& s) { s.groups[1].instances.push_back({.group = GroupId{0}}); }},
        {"scene.pbrt:12: the group contains itself",
         [](Scene& s) { s.groups[1].instances.push_back({.group = GroupId{1}}); }},
    });
}

TEST_CASE("chains of a million references end in a message, not in a stack overflow") {
    auto const chain = [](std::uint32_t length) {
        Scene s;
        s.add(Texture{ConstantFloatTexture{}, {}});
        for (std::uint32_t i = 1; i < length; ++i)
            s.add(Texture{ScaleTexture{TextureId{i - 1}, TextureId{0}}, {}});
        return s;
    };
    validate(chain(512));
    refused(chain(513), "nests more than 512 deep", ErrorKind::Limit);
    Scene s = chain(1'000'000);
    refused(s, "nests more than", ErrorKind::Limit);
    s.textures[1].kind = ScaleTexture{TextureId{999'999}, TextureId{0}};
    refused(s, "contains itself");
}

TEST_CASE("instances are multiplied out in 64 bits before anything is built") {
    auto const bomb = [](int levels, bool shining) {
        Scene s;
        Object ball{.shape = Sphere{}};
        if (shining) ball.light = AreaLight{};
        GroupId below = s.add(Group{.objects = {ball}});
        for (int i = 0; i < levels; ++i)
            below = s.add(Group{.instances = std::vector<Instance>(1000, Instance{.group = below})});
        s.world().instances.push_back({.group = below});
        return s;
    };
    validate(bomb(2, false));
    refused(bomb(4, false), "2^31 objects once", ErrorKind::Limit);
    refused(bomb(30, true), "2^31 objects once", ErrorKind::Limit);  // 10^90 saturates
    Scene s;
    TriangleMesh many{.p = std::vector<Vec3>(3), .triangles = std::vector<Vec3i>(1000, Vec3i{0, 1, 2})};
    s.add(Group{.objects = {{.shape = many, .light = AreaLight{}}}});
    s.world().instances.assign(3'000'000, Instance{.group = GroupId{1}});
    refused(s, "2^31 shining primitives", ErrorKind::Limit);
    s.groups[1].objects[0].light.reset();
    validate(s);
    LoopSubdivision const loop{
        .p = std::vector<Vec3>(3), .triangles = std::vector<Vec3i>(200, Vec3i{0, 1, 2}), .levels = 12};
    s.world().objects.push_back({.shape = loop});
    refused(s, "2^31 primitives", ErrorKind::Limit);
}

TEST_CASE("too many instances are refused at the instance with which they are") {
    Scene s = sample_scene();
    for (std::uint32_t level = 0; level < 4; ++level) {
        GroupId const g = s.add(Group{.where = {0, 30 + level}});
        s.groups[g.value].instances.assign(1000,
                                           Instance{.group = GroupId{g.value - 1}, .where = {0, 40 + level}});
    }
    s.world().instances.push_back({.group = GroupId{2}, .where = {0, 50}});
    s.world().instances.push_back({.group = GroupId{5}, .where = {0, 51}});
    s.world().instances.push_back({.group = GroupId{2}, .where = {0, 52}});
    refused(s, "scene.pbrt:51: the scene has more than 2^31 objects", ErrorKind::Limit);
}

TEST_CASE("what has no extent is dropped with a note, and the rest is the scene without it") {
    Scene s = sample_scene();
    std::string const before = hash(s);
    drop_degenerate(s);
    CHECK(s.notes.empty());
    auto const add = [&s](Shape shape, Mat4 m, std::uint32_t line) {
        s.world().objects.push_back({.shape = shape, .to_group = m, .where = {0, line}});
    };
    add(Sphere{}, scale(0, 1, 1), 20);
    add(Sphere{.radius = 0}, Mat4{}, 21);
    add(Cylinder{.z_min = 1, .z_max = 1}, Mat4{}, 22);
    add(Disk{.inner_radius = 1}, Mat4{}, 23);
    add(Quad{.edge_u = {0, 0, 0}}, Mat4{}, 24);
    add(Box{{0, 0, 0}, {1, 0, 0}}, Mat4{}, 25);
    add(TriangleMesh{}, Mat4{}, 26);
    s.world().instances.push_back({.group = GroupId{1}, .where = {0, 27}});
    s.world().instances.back().to_parent = {};
    drop_degenerate(s);
    REQUIRE(s.notes.size() == 8);
    CHECK(s.locate(s.notes[0].where) == "scene.pbrt:20");
    CHECK(s.locate(s.notes[7].where) == "scene.pbrt:27");
    CHECK(hash(s) == before);
    validate(s);
    // Other faults stay for validate() to name.
    add(Sphere{.radius = -1}, Mat4{}, 30);
    add(Sphere{}, translate(std::nan(""), 0, 0), 31);
    drop_degenerate(s);
    CHECK(s.world().objects.size() == 3);
}
