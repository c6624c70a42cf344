// PLY: formats, property orders and types, polygons, and what is refused.
#include "helpers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

using namespace nephroid;
using namespace nephroid::test;

namespace {

TriangleMesh ply_mesh(std::string const& bytes) {
    Folder const folder;
    return shape_of<TriangleMesh>(read_scene(folder.write("m.ply", bytes)));
}
/// The message, from the mesh file's name on.
std::string ply_error(std::string const& bytes) {
    auto const message = error_of([&] { ply_mesh(bytes); });
    auto const at = message.rfind("m.ply");
    return at == std::string::npos ? message : message.substr(at);
}

template <class T>
void append(std::string& out, T value, bool big_endian) {
    std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (big_endian) std::reverse(raw.begin(), raw.end());
    out.append(raw.data(), raw.size());
}

std::string ascii(std::string const& vertex_lines, std::string const& face_lines, int vertices, int faces) {
    return "ply\nformat ascii 1.0\ncomment x\nobj_info y\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\nend_header\n" + vertex_lines + face_lines;
}

constexpr char const* kSquarePoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

}  // namespace

TEST_CASE("ascii, polygons become fans") {
    auto const m = ply_mesh(ascii(kSquarePoints, "4 0 1 2 3\n3 0 1 2\n", 4, 2));
    CHECK(m.p == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(m.triangles == std::vector<Vec3i>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    CHECK(m.n.empty());
    CHECK(m.uv.empty());
    std::string crlf;
    for (char const c : ascii(kSquarePoints, "4 0 1 2 3\n", 4, 1))
        crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(ply_mesh(crlf).triangles.size() == 2);
}

TEST_CASE("binary of both byte orders, any order and type of properties, extra elements") {
    for (bool const big : {false, true}) {
        CAPTURE(big);
        std::string bytes =
            std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
            " 1.0\nelement extra 2\nproperty list ushort double junk\nproperty char c\n"
            "element face 1\nproperty uchar flags\nproperty list int ushort vertex_index\nproperty list "
            "uchar float tex\n"
            "element vertex 3\nproperty double z\nproperty uchar red\nproperty float32 x\nproperty short y\n"
            "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float "
            "t\nend_header\n";
        for (int i = 0; i < 2; ++i) {
            append<std::uint16_t>(bytes, 2, big);
            append<double>(bytes, 1, big);
            append<double>(bytes, 2, big);
            append<std::int8_t>(bytes, -1, big);
        }
        append<std::uint8_t>(bytes, 9, big);
        append<std::int32_t>(bytes, 3, big);
        for (std::uint16_t const i : {2, 1, 0}) append<std::uint16_t>(bytes, i, big);
        append<std::uint8_t>(bytes, 1, big);
        append<float>(bytes, 0.5f, big);
        for (int i = 0; i < 3; ++i) {
            append<double>(bytes, i + 0.5, big);
            append<std::uint8_t>(bytes, 255, big);
            append<float>(bytes, static_cast<float>(i), big);
            append<std::int16_t>(bytes, static_cast<std::int16_t>(-i), big);
            for (float const n : {0.0f, 0.0f, 1.0f}) append<float>(bytes, n, big);
            append<float>(bytes, 0.25f, big);
            append<float>(bytes, 0.75f, big);
        }
        auto const m = ply_mesh(bytes);
        CHECK(m.p == std::vector<Vec3>{{0, 0, 0.5f}, {1, -1, 1.5f}, {2, -2, 2.5f}});
        CHECK(m.n == std::vector<Vec3>(3, Vec3{0, 0, 1}));
        CHECK(m.uv == std::vector<Vec2>(3, Vec2{0.25f, 0.75f}));
        CHECK(m.triangles == std::vector<Vec3i>{{2, 1, 0}});
        CHECK(ply_error(bytes.substr(0, bytes.size() - 1)) ==
              "m.ply: vertex 2: the file ends before its elements do");
    }
}

TEST_CASE("small faces are left out and noted") {
    Folder const folder;
    auto const scene = read_scene(folder.write("m.ply", ascii(kSquarePoints, "2 0 1\n0\n3 0 1 2\n", 4, 3)));
    CHECK(shape_of<TriangleMesh>(scene).triangles.size() == 1);
    CHECK(contains(notes(scene), "2 faces of fewer than three vertices were left out"));
}

TEST_CASE("what is no PLY") {
    CHECK(ply_error("") == "m.ply:1: the file ends before \"end_header\"");
    CHECK(ply_error("plyx\n") == "m.ply:1: the file does not begin with \"ply\"");
    CHECK(ply_error("ply\nend_header\n") == "m.ply:2: the header has no \"format\" line");
    CHECK(ply_error("ply\nformat ascii 2.0\n") == "m.ply:2: only version 1.0 of PLY is known");
    CHECK(contains(ply_error("ply\nformat text 1.0\n"), "m.ply:2: format \"text\""));
    CHECK(contains(ply_error("ply\nformat ascii 1.0\nelement vertex -1\n"),
                   "m.ply:3: an element needs a name and a count"));
    CHECK(contains(ply_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"),
                   "m.ply:4: unknown property type \"real\""));
    CHECK(contains(ply_error("ply\nformat ascii 1.0\nproperty float x\n"),
                   "m.ply:3: a property before any element"));
    CHECK(contains(ply_error("ply\nformat ascii 1.0\nhello\n"), "m.ply:3: unknown keyword \"hello\""));
    CHECK(contains(
        ply_error(
            "ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n"),
        "no \"vertex\" element"));
    CHECK(contains(ply_error(ascii(kSquarePoints, "", 4, 0)), "no faces"));
}

TEST_CASE("counts and indices are not believed") {
    CHECK(contains(ply_error(ascii(kSquarePoints, "3 0 1 2\n", 1000000000, 1)),
                   "m.ply:5: 1000000000 elements \"vertex\" do not fit"));
    CHECK(contains(ply_error(ascii(kSquarePoints, "3 0 1 2\n", 4, 1000000000)),
                   "m.ply:9: 1000000000 elements \"face\" do not fit"));
    CHECK(ply_error(ascii(kSquarePoints, "3 0 1 4\n", 4, 1)) ==
          "m.ply: triangle 0: vertex index 4 is out of range; there are 4 vertices");
    CHECK(ply_error(ascii(kSquarePoints, "3 0 1 -1\n", 4, 1)) == "m.ply:16: a vertex index is out of range");
    CHECK(ply_error(ascii(kSquarePoints, "3 0 1 99999999999\n", 4, 1)) ==
          "m.ply:16: a vertex index is out of range");
    CHECK(ply_error(ascii(kSquarePoints, "3 0 1 2.5\n", 4, 1)) == "m.ply:16: \"2.5\" is not an integer");
    CHECK(ply_error(ascii(kSquarePoints, "255 0 1 2\n", 4, 1)) ==
          "m.ply:16: a list of 255 runs off the end of the file");
    CHECK(ply_error(ascii("0 0 0\n1 nan 0\n1 1 0\n", "3 0 1 2\n", 3, 1)) ==
          "m.ply:13: \"nan\" is not a finite number");
    CHECK(ply_error(ascii("0 0 0\n1 1e39 0\n1 1 0\n", "3 0 1 2\n", 3, 1)) ==
          "m.ply:13: property \"y\" is not a finite number");
    CHECK(contains(ply_error(ascii("0 0 0\n1 1 0\n1.000000 0", "", 3, 0)),
                   "the file ends before its elements do"));
}

TEST_CASE("quads that are not flat are noted, once a mesh") {
    auto const notes_of = [](std::string const& points) {
        Folder const folder;
        auto const mesh = ascii(points, "4 0 1 2 3\n4 3 2 1 0\n", 4, 2);
        return notes(read_scene(folder.write("m.ply", mesh)));
    };
    CHECK(notes_of("0 0 0\n1 0 0\n1 1 0\n0 1 0.00001\n").empty());
    auto const bent = notes_of("0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n");
    CAPTURE(bent);
    CHECK(contains(bent, "m.ply: 2 quads are not flat"));
    CHECK(std::count(bent.begin(), bent.end(), '\n') == 1);
}

TEST_CASE("the scene says who named a mesh that is not there") {
    CHECK(contains(error_in_world("\nShape \"plymesh\" \"string filename\" \"nope.ply\""),
                   "t.pbrt:3: mesh file \"nope.ply\" does not exist"));
    CHECK(contains(error_in_world("Shape \"plymesh\""), "needs a \"string filename\""));
    CHECK(contains(error_in_world("Shape \"plymesh\" \"string filename\" \"a.stl\""),
                   "a.stl\" does not exist"));
}
