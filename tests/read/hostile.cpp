// Files made to hurt: each is read, or refused with an error that names it.
#include "helpers.h"

#include <sstream>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// The error of reading and validating, "" for none. Anything but an Error fails the test by leaving it.
std::string try_read(std::filesystem::path const& path) {
    auto const message = error_of([&] {
        if (path.extension() != ".spd") return validate(read_scene(path));
        read_pbrt_string(
            "WorldBegin LightSource \"point\" \"spectrum I\" \"" + path.filename().string() + "\"", "t.pbrt",
            path.parent_path());
    });
    return message == "no error" ? "" : message;
}

}  // namespace

TEST_CASE("made files are accepted and refused as their manifest says") {
    auto const data = shared_data();
    if (data.empty()) return;
    auto const folder = data / "malformed" / "made";
    std::ifstream manifest(folder / "MANIFEST.tsv");
    REQUIRE(manifest);
    int read_files = 0;
    for (std::string line; std::getline(manifest, line);) {
        std::istringstream fields(line);
        std::string file, expected, what;
        std::getline(fields, file, '\t'), std::getline(fields, expected, '\t'), std::getline(fields, what);
        auto const kind = file.substr(0, file.find('/'));
        if (kind != "pbrt" && kind != "ply" && kind != "obj" && kind != "spd") continue;
        CAPTURE(line);
        auto const message = try_read(folder / file);
        CAPTURE(message);
        ++read_files;
        if (expected == "accept") CHECK(message.empty());
        // These two are no errors in pbrt, which goes on without the excess; here each is a note.
        bool const forgiven = file == "pbrt/attr_unbalanced.pbrt" || file == "pbrt/mesh_notmult.pbrt";
        if (expected == "reject") CHECK(message.empty() == forgiven);
        // Every message says where.
        if (!message.empty()) CHECK(message.find(": ") != std::string::npos);
    }
    CHECK(read_files > 150);
}

TEST_CASE("another loader's test files, and what fuzzing it found") {
    auto const data = shared_data();
    if (data.empty()) return;
    Folder const folder;
    int read_files = 0;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(data / "malformed" / "mesh" /
                                                                           "tinyobjloader-models")) {
        if (!entry.is_regular_file()) continue;
        bool const fuzzed = entry.path().filename().string().starts_with("id:");
        if (entry.path().extension() != ".obj" && !fuzzed) continue;
        CAPTURE(entry.path().string());
        std::ifstream in(entry.path(), std::ios::binary);
        auto const path = folder.write("m.obj", {std::istreambuf_iterator<char>(in), {}});
        auto const message = try_read(path);
        // Numbers of vertices alone decide.
        if (entry.path().filename() == "cornell_box.obj") CHECK(message.empty());
        ++read_files;
    }
    CHECK(read_files > 50);
}
