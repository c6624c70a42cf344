// Files: Include and Import, gzip, things that are no files, bare meshes, and every scene at hand.
#include "helpers.h"

#include <sys/stat.h>
#include <zlib.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

void write_gz(std::filesystem::path const& path, std::string const& text) {
    gzFile const f = gzopen(path.c_str(), "wb");
    gzwrite(f, text.data(), static_cast<unsigned>(text.size()));
    gzclose(f);
}

constexpr char const* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

}  // namespace

TEST_CASE("Include goes on in the middle of the state; names are relative to the file that says them") {
    Folder const folder;
    folder.write("a/b/tri.ply", kPly);
    folder.write("a/more.pbrt", "Translate 1 0 0\nShape \"plymesh\" \"string filename\" \"b/tri.ply\"");
    // As in pbrt, names may also start from the first file's folder.
    folder.write("a/root.pbrt", "Shape \"plymesh\" \"string filename\" \"a/b/tri.ply\"");
    auto const path = folder.write("main.pbrt",
                                   "WorldBegin Include \"a/more.pbrt\" Include \"a/root.pbrt\" Shape "
                                   "\"sphere\" Include \"a/more.pbrt\"");
    auto const scene = read_scene(path);
    REQUIRE(scene.world().objects.size() == 4);
    CHECK(scene.world().objects[2].to_group.m[0][3] == 1);
    CHECK(scene.world().objects[3].to_group.m[0][3] == 2);
    CHECK(scene.locate(scene.world().objects[0].where) == (folder.path() / "a/more.pbrt:2").string());
}

TEST_CASE("a link's folder is left by \"..\" as the system leaves it, and other detours are not shown") {
    Folder const folder;
    folder.write("away/deep/none.ply", "");
    folder.write("away/tri.pbrt", "Shape \"disk\"");
    folder.write("tri.pbrt", "Shape \"sphere\"");
    std::filesystem::create_directory_symlink("away/deep", folder.path() / "link");
    auto const scene = read_scene(folder.write(
        "main.pbrt", "WorldBegin Include \"link/../tri.pbrt\" Include \"away/../no/../tri.pbrt\""));
    shape_of<Disk>(scene, 0);
    shape_of<Sphere>(scene, 1);
    auto const file = [&](std::size_t object) { return scene.locate(scene.world().objects[object].where); };
    CHECK(file(0) == (std::filesystem::canonical(folder.path()) / "away/tri.pbrt:1").string());
    CHECK(file(1) == (folder.path() / "tri.pbrt:1").string());
}

TEST_CASE("Import gives nothing of its state back") {
    Folder const folder;
    folder.write("i.pbrt",
                 "Translate 1 0 0 Shape \"sphere\" MakeNamedMaterial \"m\" \"string type\" \"dielectric\"");
    auto const scene = read_scene(
        folder.write("main.pbrt", "WorldBegin Import \"i.pbrt\" NamedMaterial \"m\" Shape \"sphere\""));
    CHECK(scene.world().objects.at(0).to_group.m[0][3] == 1);
    CHECK(scene.world().objects.at(1).to_group.m[0][3] == 0);
    material_of<DielectricMaterial>(scene, 1);
    folder.write("open.pbrt", "\nAttributeBegin");
    folder.write("close.pbrt", "\nAttributeEnd");
    CHECK(contains(error_of([&] { read_scene(folder.write("m2.pbrt", "WorldBegin Import \"open.pbrt\"")); }),
                   "open.pbrt:2: this block is not closed"));
    // It closes no block of the file that imports it.
    CHECK(contains(notes(read_scene(folder.write(
                       "m3.pbrt", "WorldBegin AttributeBegin Import \"close.pbrt\" AttributeEnd"))),
                   "close.pbrt:2: AttributeEnd without its Begin"));
    // Nor an object: what follows in it still belongs to the object.
    folder.write("end.pbrt", "ObjectEnd Shape \"disk\"");
    auto const object = read_scene(folder.write(
        "m4.pbrt", "WorldBegin ObjectBegin \"o\" Import \"end.pbrt\" ObjectEnd Shape \"sphere\""));
    CHECK(object.world().objects.size() == 1);
    CHECK(object.groups.at(1).objects.size() == 1);
}

TEST_CASE("the first file's folder comes before that of the file which names another") {
    Folder const folder;
    folder.write("s.pbrt", "Shape \"sphere\"");
    folder.write("a/s.pbrt", "Shape \"disk\"");
    folder.write("a/only.pbrt", "Shape \"disk\"");
    folder.write("a/more.pbrt", "Include \"s.pbrt\" Include \"only.pbrt\"");
    auto const scene = read_scene(folder.write("main.pbrt", "WorldBegin Include \"a/more.pbrt\""));
    shape_of<Sphere>(scene, 0);
    shape_of<Disk>(scene, 1);
}

namespace {
/// The kind of error that reading throws; its message is in `message`.
std::optional<ErrorKind> kind_of_error(std::filesystem::path const& path, std::string& message) {
    try {
        read_scene(path);
    } catch (Error const& e) {
        message = e.what();
        return e.kind();
    }
    return std::nullopt;
}
}  // namespace

TEST_CASE("files that include files that include files") {
    Folder const folder;
    std::string ten;
    for (int i = 0; i < 10; ++i) ten += "Include \"NEXT\"\n";
    for (int level = 0; level < 20; ++level) {
        auto text = ten;
        auto const next = "f" + std::to_string(level + 1) + ".pbrt";
        for (std::size_t at; (at = text.find("NEXT")) != std::string::npos;) text.replace(at, 4, next);
        folder.write("f" + std::to_string(level) + ".pbrt", text);
    }
    folder.write("f20.pbrt", "");
    std::string message;
    CHECK(kind_of_error(folder.write("main.pbrt", "\nInclude \"f0.pbrt\""), message) == ErrorKind::Limit);
    CAPTURE(message);
    CHECK(contains(message, ".pbrt:"));
    CHECK(contains(message, "more than 10000 files in all"));
}

TEST_CASE("gigabytes of included text") {
    if (!std::getenv("NEPHROID_FULL")) return;
    Folder const folder;
    folder.write("big.pbrt", std::string(std::size_t{256} << 20, ' '));
    std::string text;
    for (int i = 0; i < 17; ++i) text += "Include \"big.pbrt\"\n";
    std::string message;
    CHECK(kind_of_error(folder.write("main.pbrt", text), message) == ErrorKind::Limit);
    CHECK(contains(message, "main.pbrt:17: Include \"big.pbrt\": more than 4 GiB"));
}

TEST_CASE("files of the system are not read") {
    if (!std::filesystem::exists("/proc/self/status")) return;
    for (char const* path : {"/proc/self/status", "/proc/kmsg", "/sys/kernel/notes", "/dev/null"}) {
        CAPTURE(path);
        if (!std::filesystem::exists(path)) continue;
        auto const message = error_in("\nInclude \"" + std::string(path) + "\"");
        CAPTURE(message);
        CHECK(contains(message, "t.pbrt:2: Include \"" + std::string(path) + "\" "));
    }
    CHECK(contains(error_in("Include \"/proc/self/status\""), "is not a regular file"));
}

TEST_CASE("a mesh whose name says nothing is told by its first word") {
    Folder const folder;
    folder.write("mesh.bin", kPly);
    write_gz(folder.path() / "packed", kPly);
    auto const scene = read_scene(folder.write(
        "main.pbrt",
        "WorldBegin Shape \"plymesh\" \"string filename\" \"mesh.bin\" Shape \"plymesh\" \"string filename\" "
        "\"packed\""));
    CHECK(shape_of<TriangleMesh>(scene, 1).triangles.size() == 1);
}

TEST_CASE("Include cycles, chains, and what is missing") {
    Folder const folder;
    CHECK(contains(error_of([&] { read_scene(folder.write("self.pbrt", "\nInclude \"self.pbrt\"")); }),
                   "self.pbrt:2: Include \"self.pbrt\": the file includes itself"));
    folder.write("b.pbrt", "\n\nInclude \"./a.pbrt\"");
    CHECK(contains(error_of([&] { read_scene(folder.write("a.pbrt", "Include \"b.pbrt\"")); }),
                   "b.pbrt:3: Include \"./a.pbrt\": the file includes itself"));
    for (int i = 0; i < 40; ++i)
        folder.write("c" + std::to_string(i) + ".pbrt", "Include \"c" + std::to_string(i + 1) + ".pbrt\"");
    CHECK(contains(error_of([&] { read_scene(folder.path() / "c0.pbrt"); }),
                   "c31.pbrt:1: Include \"c32.pbrt\": files are nested more than 32 deep"));
    CHECK(contains(error_of([&] { read_scene(folder.write("m.pbrt", "\nInclude \"nope.pbrt\"")); }),
                   "nope.pbrt\" does not exist"));
    CHECK(contains(error_of([&] { read_scene(folder.write("m.pbrt", "\nInclude \".\"")); }),
                   "is not a regular file"));
    CHECK(contains(error_of([&] { read_scene(folder.write("m.pbrt", "\nInclude \"/dev/zero\"")); }),
                   "m.pbrt:2: Include \"/dev/zero\" is not a regular file"));
    REQUIRE(mkfifo((folder.path() / "fifo").c_str(), 0600) == 0);
    CHECK(contains(error_of([&] {
                       read_scene(folder.write(
                           "m.pbrt",
                           "WorldBegin Shape \"plymesh\" \"string filename\" \"x.ply\" Include \"fifo\""));
                   }),
                   "x.ply\" does not exist"));
    CHECK(contains(error_of([&] { read_scene(folder.write("m.pbrt", "Include \"fifo\"")); }),
                   "is not a regular file"));
    CHECK(contains(error_of([&] { read_scene(folder.path() / "nope.pbrt"); }), "nope.pbrt: does not exist"));
    CHECK(contains(error_of([&] { read_scene(folder.write("m.xml", "")); }), "unknown kind of scene"));
}

TEST_CASE("gzip, by its magic bytes") {
    Folder const folder;
    write_gz(folder.path() / "a.pbrt.gz",
             "WorldBegin Include \"b.pbrt\" Shape \"plymesh\" \"string filename\" \"c.ply.gz\"");
    write_gz(folder.path() / "b.pbrt", "Shape \"sphere\"");
    write_gz(folder.path() / "c.ply.gz", kPly);
    CHECK(read_scene(folder.path() / "a.pbrt.gz").world().objects.size() == 2);
    CHECK(read_scene(folder.path() / "c.ply.gz").world().objects.size() == 1);
    folder.write("plain.pbrt.gz", "WorldBegin");
    CHECK(read_scene(folder.path() / "plain.pbrt.gz").world().objects.empty());
    std::string bytes;
    {
        std::ifstream in(folder.path() / "a.pbrt.gz", std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    folder.write("cut.pbrt.gz", bytes.substr(0, bytes.size() / 2));
    CHECK(contains(error_of([&] { read_scene(folder.path() / "cut.pbrt.gz"); }),
                   "has a broken or truncated gzip stream"));
    write_gz(folder.path() / "two.pbrt.gz", "WorldBegin\n");
    std::ofstream(folder.path() / "two.pbrt.gz", std::ios::binary | std::ios::app) << bytes;
    CHECK(contains(error_of([&] { read_scene(folder.path() / "two.pbrt.gz"); }),
                   "two.pbrt.gz:2: a second WorldBegin"));
}

TEST_CASE("a bare mesh becomes a scene that shows it") {
    Folder const folder;
    auto const scene = read_scene(folder.write("t.ply", kPly));
    CHECK(shape_of<TriangleMesh>(scene).triangles.size() == 1);
    material_of<DiffuseMaterial>(scene);
    as<InfiniteLight>(scene.lights.at(0).kind);
    validate(scene);
    // The middle of the mesh is straight ahead of the camera, and no corner is outside of the picture.
    auto const to_camera = inverse(scene.camera.to_world);
    REQUIRE(to_camera.has_value());
    float const slope = std::tan(as<PerspectiveCamera>(scene.camera.kind).fov / 2);
    for (auto const& p : shape_of<TriangleMesh>(scene).p) {
        std::array<double, 3> c{};
        for (std::size_t i = 0; i < 3; ++i)
            c[i] = to_camera->m[i][0] * p.x + to_camera->m[i][1] * p.y + to_camera->m[i][2] * p.z +
                   to_camera->m[i][3];
        CHECK(c[2] > 0);
        CHECK(std::abs(c[0]) < slope * c[2]);
        CHECK(std::abs(c[1]) < slope * c[2]);
    }
    // Right-handed world, left-handed camera: one mirror.
    CHECK(swaps_handedness(scene.camera.to_world));
}

TEST_CASE("every scene at hand is read") {
    std::vector<std::filesystem::path> folders{std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes"};
    if (auto const data = shared_data(); !data.empty()) {
        folders.push_back(data / "pbrt4-minus");
        folders.push_back(data / "references" / "pbrt-v4");
    }
    for (auto const& folder : folders) {
        if (!std::filesystem::is_directory(folder)) continue;
        for (auto const& entry : std::filesystem::recursive_directory_iterator(folder)) {
            // Parts of scenes are no scenes.
            if (entry.path().extension() != ".pbrt" || contains(entry.path().string(), "geometry") ||
                contains(entry.path().string(), "/include/"))
                continue;
            CAPTURE(entry.path().string());
            CHECK(error_of([&] { validate(read_scene(entry.path())); }) == "no error");
        }
    }
}
