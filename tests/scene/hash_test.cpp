#include "sample_scene.h"
#include "scene/digest.h"
#include "scene/fields.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include <unistd.h>

using namespace nephroid;

namespace {

std::string digest(std::string const& text) {
    Digest d;
    d.bytes(text.data(), text.size());
    return d.hex();
}

template <class T>
std::size_t count_fields(T const& t) {
    std::size_t n = 0;
    for_each_field(t, [&n](auto const&) { ++n; });
    return n;
}

template <class Thing>
using Mutation = std::function<void(Thing&)>;

/// Each mutation must give a hash that no other gives.
template <class Thing>
void all_differ(Thing const& original, std::vector<Mutation<Thing>> const& mutations) {
    std::set<std::string> seen{hash(original)};
    for (std::size_t i = 0; i < mutations.size(); ++i) {
        CAPTURE(i);
        Thing changed = original;
        mutations[i](changed);
        CHECK(seen.insert(hash(changed)).second);
    }
}

}  // namespace

TEST_CASE("the digest is MurmurHash3 x64 128, however it is fed") {
    // Published values of the reference implementation, seed 0.
    CHECK(digest("") == "00000000000000000000000000000000");
    CHECK(digest("hello") == "cbd8a7b341bd9b025b1e906a48ae1d19");
    CHECK(digest("The quick brown fox jumps over the lazy dog") == "e34bbc7bbc071b6c7a433ca9c49a9347");
    std::string text;
    for (int i = 0; i < 100; ++i) text += static_cast<char>(i * 37);
    for (std::size_t size = 0; size <= text.size(); ++size)
        for (std::size_t const step : {1u, 3u, 7u, 16u, 17u}) {
            Digest d;
            for (std::size_t i = 0; i < size; i += step) d.bytes(text.data() + i, std::min(step, size - i));
            CHECK(d.hex() == digest(text.substr(0, size)));
        }
}

TEST_CASE("fields are counted, arrays and optionals among them") {
    CHECK(count_fields(InterfaceMaterial{}) == 0);
    CHECK(count_fields(DiffuseMaterial{}) == 1);
    CHECK(count_fields(Camera{}) == 6);
    CHECK(count_fields(Instance{}) == 3);
    CHECK(count_fields(ImageTexture{}) == 9);
    CHECK(count_fields(Mat4{}) == 1);
    CHECK(count_fields(Object{}) == 7);
}

TEST_CASE("equal scenes have equal hashes") {
    CHECK(hash(sample_scene()) == hash(sample_scene()));
    CHECK(hash(sample_scene()).size() == 32);
    CHECK(hash(Scene{}) != hash(sample_scene()));
}

TEST_CASE("whatever shapes the picture changes the scene's hash") {
    all_differ<Scene>(
        sample_scene(),
        {
            [](Scene& s) { std::get<PerspectiveCamera>(s.camera.kind).fov = 1.0000001f; },
            [](Scene& s) { s.camera.kind = OrthographicCamera{}; },
            [](Scene& s) { s.camera.to_world = translate(0, 0, 1e-9); },
            [](Scene& s) {
                s.camera.screen_window = std::array<float, 4>{0, 0, 0, 0};
            },
            [](Scene& s) { s.camera.frame_aspect_ratio = 0.0f; },
            [](Scene& s) { s.camera.exposure_time = 2; },
            [](Scene& s) { s.images[0].path = "other.png"; },
            [](Scene& s) { s.images[0].encoding = "linear"; },
            [](Scene& s) { std::get<ConstantFloatTexture>(s.textures[1].kind).value = 0.25f; },
            [](Scene& s) { std::get<ImageTexture>(s.textures[2].kind).wrap = WrapMode::Clamp; },
            [](Scene& s) { std::get<ImageTexture>(s.textures[2].kind).mapping = UvMapping{}; },
            [](Scene& s) { std::get<ImageTexture>(s.textures[2].kind).max_anisotropy = 4; },
            [](Scene& s) { s.textures[3].kind = FbmTexture{}; },
            [](Scene& s) { s.textures[3].kind = WrinkledTexture{}; },
            [](Scene& s) { s.textures[3].kind = WrinkledTexture{.octaves = 7}; },
            [](Scene& s) { s.textures[3].kind = WindyTexture{}; },
            [](Scene& s) { s.textures[3].kind = MarbleTexture{}; },
            [](Scene& s) { s.textures[3].kind = MarbleTexture{.variation = 0.3f}; },
            [](Scene& s) {
                s.textures[3].kind = DirectionMixTexture{TextureId{0}, TextureId{2}};
            },
            [](Scene& s) {
                s.textures[3].kind = DirectionMixTexture{TextureId{0}, TextureId{2}, {1, 0, 0}};
            },
            [](Scene& s) {
                s.textures[3].kind = DotsTexture{{}, TextureId{0}, TextureId{2}};
            },
            [](Scene& s) {
                s.textures[3].kind = DotsTexture{{}, TextureId{2}, TextureId{0}};
            },
            [](Scene& s) { std::get<MixTexture>(s.textures[3].kind).tex1 = TextureId{2}; },
            [](Scene& s) { s.materials[0].kind = InterfaceMaterial{}; },
            [](Scene& s) { std::get<DielectricMaterial>(s.materials[1].kind).eta = NamedSpd{"glass-BK7"}; },
            [](Scene& s) { std::get<DielectricMaterial>(s.materials[1].kind).eta = NamedSpd{"glass-SF11"}; },
            [](Scene& s) {
                std::get<TabulatedSpd>(std::get<DielectricMaterial>(s.materials[1].kind).eta).value[1] = 1;
            },
            [](Scene& s) { s.world().objects[0].material = MaterialId{1}; },
            [](Scene& s) { s.materials[0].displacement = TextureId{1}; },
            [](Scene& s) { s.materials[1].displacement = TextureId{1}; },
            [](Scene& s) { s.materials[0].normal_map.image = ImageId{0}; },
            [](Scene& s) { std::get<MixMaterial>(s.materials[2].kind).amount = {}; },
            [](Scene& s) { std::swap(s.lights[0], s.lights[1]); },
            [](Scene& s) { std::get<SpotLight>(s.lights[0].kind).power = 3; },
            [](Scene& s) { s.lights[0].to_world = scale(1, 1, -1); },
            [](Scene& s) { s.lights.pop_back(); },
            [](Scene& s) { s.world().objects[0].shape = Cylinder{}; },
            [](Scene& s) { s.world().objects[0].light.reset(); },
            [](Scene& s) { s.world().objects[0].light->two_sided = true; },
            [](Scene& s) { s.world().objects[0].alpha = {}; },
            [](Scene& s) { s.world().objects[0].reverse_orientation = true; },
            [](Scene& s) { s.world().instances[0].to_parent[2][3] = 1; },
            [](Scene& s) { s.world().instances.push_back(s.world().instances[0]); },
            [](Scene& s) { std::get<TriangleMesh>(s.groups[1].objects[0].shape).p[1].x = 2; },
            [](Scene& s) {
                std::get<TriangleMesh>(s.groups[1].objects[0].shape).triangles[0] = {1, 2, 0};
            },
            [](Scene& s) { std::get<TriangleMesh>(s.groups[1].objects[0].shape).n.resize(3); },
            [](Scene& s) { s.world().objects.push_back(s.groups[1].objects[0]); },
            [](Scene& s) {
                GroupId const empty = s.add(Group{});
                s.groups[1].instances.push_back({empty});
            },
        });
}

TEST_CASE("how things are numbered, what nothing uses and what is there twice do not enter the hash") {
    Scene s = sample_scene();
    std::string const before = hash(s);
    // Looked up anew each time: adding may move them.
    auto const mix = [&]() -> MixTexture& { return std::get<MixTexture>(s.textures[3].kind); };
    auto const both = [&]() -> MixMaterial& { return std::get<MixMaterial>(s.materials[2].kind); };

    // Twice.
    mix().amount = s.add(Texture(s.textures[1]));
    CHECK(hash(s) == before);
    both().b = s.add(Material(s.materials[1]));
    CHECK(hash(s) == before);
    s.world().instances[0].group = s.add(Group(s.groups[1]));
    CHECK(hash(s) == before);
    s.images.push_back(s.images[0]);
    std::get<InfiniteLight>(s.lights[1].kind).image = ImageId{1};
    CHECK(hash(s) == before);
    // In another order.
    std::swap(s.textures[0], s.textures[2]);
    std::swap(std::get<MixTexture>(s.textures[3].kind).tex1, std::get<MixTexture>(s.textures[3].kind).tex2);
    CHECK(hash(s) == before);
    // But what they are does.
    std::swap(s.textures[0], s.textures[2]);
    CHECK(hash(s) != before);
    std::swap(s.textures[0], s.textures[2]);
    // Unused.
    s.groups.emplace_back();
    s.add(Texture{ConstantFloatTexture{7}});
    s.add(Material{InterfaceMaterial{}});
    s.add(ImageFile{"another.png", ""});
    CHECK(hash(s) == before);
    // Used after all.
    s.world().instances[0].group = GroupId{static_cast<std::uint32_t>(s.groups.size() - 1)};
    CHECK(hash(s) != before);
}

TEST_CASE("names of nothing and of themselves do not keep the hash from coming to an end") {
    Scene s = sample_scene();
    std::string const before = hash(s);
    std::get<MixMaterial>(s.materials[2].kind).a = MaterialId{2};
    std::string const itself = hash(s);
    CHECK(itself != before);
    std::get<MixMaterial>(s.materials[2].kind).a = MaterialId{99};
    CHECK(hash(s) != before);
    CHECK(hash(s) != itself);
    s.groups.clear();
    CHECK(hash(s) != before);
}

TEST_CASE("places, notes, names and the sign of zero do not enter the hash") {
    Scene s = sample_scene();
    std::string const before = hash(s);
    s.files = {"renamed.pbrt", "another"};
    s.note({0, 3}, "a note");
    s.camera.where = {1, 99};
    s.textures[0].where = s.materials[0].where = s.lights[0].where = s.groups[1].where = {1, 98};
    s.world().objects[0].where = s.world().objects[0].light->where = s.world().instances[0].where = {1, 97};
    s.images[0].where = {1, 96};
    s.materials[0].name = "paint";
    s.groups[1].name = "piece";
    s.settings.seed = 7;
    std::get<TriangleMesh>(s.groups[1].objects[0].shape).p[0].x = -0.0f;
    s.camera.to_world.m[0][1] = -0.0;
    CHECK(hash(s) == before);
}

TEST_CASE("a picture enters by what is in the file, not by its name") {
    auto const folder =
        std::filesystem::temp_directory_path() / ("nephroid-hash-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    auto const write = [&](char const* name, std::string const& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
        return (folder / name).string();
    };
    Scene s = sample_scene();
    s.images[0].path = write("a", std::string(3'000'000, 'x'));
    std::string const a = hash(s);
    s.images[0].path = write("b", std::string(3'000'000, 'x'));
    CHECK(hash(s) == a);
    write("b", std::string(2'999'999, 'x') + 'y');
    CHECK(hash(s) != a);
    // Files of the system may be without an end: told by their names, however those are spelled.
    s.images[0].path = "/proc/self/cmdline";
    std::string const system_file = hash(s);
    s.images[0].path = "/proc/self/./cmdline";
    CHECK(hash(s) == system_file);
    s.images[0].path = "/proc/self/environ";
    CHECK(hash(s) != system_file);
    s.images[0].path = folder.string();  // a folder cannot be read: its name counts
    CHECK(hash(s) != a);
    std::filesystem::remove_all(folder);
}

TEST_CASE("the settings' hash changes with all that shapes a pass") {
    all_differ<Settings>(Settings{}, {
                                         [](Settings& s) { s.filter = BoxFilter{}; },
                                         [](Settings& s) { std::get<GaussianFilter>(s.filter).sigma = 1; },
                                         [](Settings& s) { s.sampler = IndependentSampler{}; },
                                         [](Settings& s) { s.sampler = StratifiedSampler{}; },
                                         [](Settings& s) { s.sampler = StratifiedSampler{.jitter = false}; },
                                         [](Settings& s) { s.integrator = DirectIntegrator{}; },
                                         [](Settings& s) { s.integrator = PathIntegrator{.max_depth = 6}; },
                                         [](Settings& s) {
                                             s.film.resolution = {720, 1280};
                                         },
                                         [](Settings& s) {
                                             s.film.crop = std::array<int, 4>{0, 1, 0, 1};
                                         },
                                         [](Settings& s) { s.film.iso = 200; },
                                         [](Settings& s) { s.film.max_component = 10; },
                                         [](Settings& s) { s.film.aovs = true; },
                                         [](Settings& s) { s.color = ColorMode::Rgb; },
                                         [](Settings& s) { s.seed = 1; },
                                     });
    Settings s;
    s.spp = 1024;
    s.film.filename = "out.exr";
    s.film.half_float = false;
    s.film.where = s.filter_where = s.sampler_where = s.integrator_where = {1, 95};
    CHECK(hash(s) == hash(Settings{}));
}
