// Names of files, files beside the scene, and what is left when it cannot be written.
#include "everything.h"
#include "support.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// A grid of n x n points.
TriangleMesh grid(int n) {
    TriangleMesh m;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            auto const fx = static_cast<float>(x) / 3, fy = static_cast<float>(y) / 7;
            m.p.emplace_back(fx, fy, std::sin(fx * fy));
            m.n.emplace_back(normalize(Vec3{fx, fy, 1}));
            m.uv.emplace_back(fx, fy);
        }
    for (int y = 0; y + 1 < n; ++y)
        for (int x = 0; x + 1 < n; ++x) {
            int const a = y * n + x;
            m.triangles.emplace_back(a, a + 1, a + n);
            m.triangles.emplace_back(a + 1, a + n + 1, a + n);
        }
    return m;
}

Scene of_meshes(std::vector<TriangleMesh> meshes) {
    Scene s;
    MaterialId const gray =
        s.add(Material{DiffuseMaterial{s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.3f}}})}});
    for (auto& m : meshes) s.world().objects.push_back({.shape = std::move(m), .material = gray});
    return s;
}

std::size_t files_in(std::filesystem::path const& folder) {
    if (!std::filesystem::exists(folder)) return 0;
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace

TEST_CASE("large meshes lie beside the scene, each once, with all that they have") {
    Folder const folder;
    TriangleMesh bare = grid(20);
    bare.n.clear();
    TriangleMesh plain = bare;
    plain.uv.clear();
    Scene const s = of_meshes({grid(20), grid(20), bare, plain, grid(3), grid(21)});
    Scene const back = there_and_back(s, folder / "out.pbrt");
    CHECK(hash(back) == hash(s));
    CHECK(files_in(folder / "out_files") == 4);
    CHECK(contents(folder / "out.pbrt").size() < 4000);
}

TEST_CASE("a million triangles are written and hashed in seconds") {
    Folder const folder;
    Scene const s = of_meshes({grid(720)});
    Scene const back = there_and_back(s, folder / "out.pbrt");
    CHECK(hash(back) == hash(s));
}

TEST_CASE("names of files are relative in the scene's own tree, and stay good when that is moved") {
    Folder const folder;
    std::filesystem::create_directories(folder / "here/pictures");
    std::filesystem::create_directories(folder / "there");
    Scene s = of_meshes({grid(2)});
    std::string const odd = (folder / "here/pictures/a \"b\" \\ c\td.png").string();
    s.add(Light{InfiniteLight{.image = s.add(ImageFile{odd, ""})}});
    s.add(Light{InfiniteLight{.image = s.add(ImageFile{"/elsewhere/sky.exr", ""})}});
    CHECK(hash(there_and_back(s, folder / "here/out.pbrt")) == hash(s));
    auto const text = contents(folder / "here/out.pbrt");
    CHECK(text.find("\"string filename\" \"pictures/a \\\"b\\\" \\\\ c\\td.png\"") != std::string::npos);
    CHECK(text.find("\"/elsewhere/sky.exr\"") != std::string::npos);
    Scene const back = there_and_back(s, folder / "there/out.pbrt");
    CHECK(hash(back) == hash(s));
    CHECK(contents(folder / "there/out.pbrt").find("\"../here/pictures/") != std::string::npos);
    // A folder that is a link: ".." would lead elsewhere.
    std::filesystem::create_directory_symlink(folder / "here/pictures", folder / "link");
    CHECK(hash(there_and_back(s, folder / "link/out.pbrt")) == hash(s));
}

TEST_CASE("what cannot be written leaves nothing, and what was there before stays") {
    Folder const folder;
    Scene const s = of_meshes({grid(20)});
    write_pbrt(of_meshes({grid(2)}), folder / "out.pbrt");
    auto const before = contents(folder / "out.pbrt");
    std::ofstream(folder / "out_files") << "no folder";
    CHECK_THROWS_AS(write_pbrt(s, folder / "out.pbrt"), Error);
    CHECK(contents(folder / "out.pbrt") == before);
    CHECK_THROWS_AS(write_pbrt(s, folder / "no/such/out.pbrt"), Error);
    CHECK_FALSE(std::filesystem::exists(folder / "no"));
    // The scene's own place is taken: its parts are not put into theirs.
    std::filesystem::create_directory(folder / "taken.pbrt");
    CHECK_THROWS_AS(write_pbrt(s, folder / "taken.pbrt"), Error);
    CHECK_FALSE(std::filesystem::exists(folder / "taken_files"));
    // A part that was there before stays; those that came with the attempt go.
    write_pbrt(s, folder / "part.pbrt");
    std::filesystem::rename(folder / "part_files", folder / "taken_files");
    CHECK_THROWS_AS(write_pbrt(of_meshes({grid(20), grid(21), grid(22)}), folder / "taken.pbrt"), Error);
    CHECK(files_in(folder / "taken_files") == 1);
}

TEST_CASE("meshes without a face are left out with a word, and the scene is the one that is rendered") {
    Folder const folder;
    TriangleMesh many_points = grid(20);
    many_points.triangles.clear();
    Scene s = of_meshes({TriangleMesh{}, grid(3), many_points});
    s.world().objects.push_back({.shape = BilinearMesh{}, .material = s.world().objects[0].material});
    s.world().objects.push_back({.shape = LoopSubdivision{}, .material = s.world().objects[0].material});
    auto const notes = write_pbrt(s, folder / "out.pbrt");
    CHECK(notes.size() == 4);
    drop_degenerate(s);
    CHECK(hash(read_scene(folder / "out.pbrt")) == hash(s));
}

TEST_CASE("a link's folder is left by \"..\" as the system leaves it") {
    Folder const folder;
    std::filesystem::create_directories(folder / "far/deep");
    std::filesystem::create_directories(folder / "near");
    std::filesystem::create_directory_symlink(folder / "far/deep", folder / "near/link");
    for (char const* place : {"far", "near"}) std::ofstream(folder / place / "sky.exr") << place;
    Scene s = of_meshes({grid(20)});
    for (char const* name : {"near/link/../sky.exr", "near/sky.exr"})
        s.add(Light{InfiniteLight{.image = s.add(ImageFile{(folder / name).string(), ""})}});
    for (char const* name : {"near/link/../out.pbrt", "near/out.pbrt", "far/out.pbrt"})
        CHECK(hash(there_and_back(s, folder / name)) == hash(s));
}

TEST_CASE("broken scenes and what has no form are refused, with their places") {
    Folder const folder;
    auto const error = [&](auto const& spoil) {
        Scene s = Everything().s;
        spoil(s);
        try {
            write_pbrt(s, folder / "out.pbrt");
        } catch (Error const& e) {
            CHECK(e.kind() == ErrorKind::Input);
            return std::string(e.what());
        }
        return std::string("no error");
    };
    CHECK(error([](Scene&) {}) == "no error");
    std::filesystem::remove(folder / "out.pbrt");
    auto const says = [](std::string const& text, std::string const& part) {
        CAPTURE(text);
        CHECK(text.find(part) != std::string::npos);
    };
    says(error([](Scene& s) { std::get<Quad>(s.world().objects[7].shape).edge_u.x = kInfinity; }),
         "not finite");
    says(error([](Scene& s) { s.world().objects[0].material = MaterialId{99}; }), "there are only");
    says(error([](Scene& s) { s.world().objects[0].material = {}; }), "without a material has no form");
    says(error([](Scene& s) { s.camera.exposure_time = 0; }), "a shutter that is never open has no form");
    says(error([](Scene& s) { std::get<PointLight>(s.lights[0].kind).power = 0; }), "a light of power 0");
    says(error([](Scene& s) { std::get<ImageTexture>(s.textures[0].kind).role = SpectrumRole::Unbounded; }),
         "another role");
    CHECK_FALSE(std::filesystem::exists(folder / "out.pbrt"));
}
