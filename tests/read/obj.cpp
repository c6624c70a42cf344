// OBJ: faces of every form, polygons, and what is refused.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

Scene scene_of(std::string const& text) {
    Folder const folder;
    return read_scene(folder.write("m.obj", text));
}
TriangleMesh mesh(std::string const& text) { return shape_of<TriangleMesh>(scene_of(text)); }
std::string error(std::string const& text) {
    auto const message = error_of([&] { mesh(text); });
    auto const at = message.rfind("m.obj");
    return at == std::string::npos ? message : message.substr(at);
}
constexpr char const* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
std::string square(std::string const& more) { return kSquare + more; }

/// Twice the area of all triangles, and whether they all face +z.
std::pair<float, bool> area(TriangleMesh const& m) {
    float sum = 0;
    bool up = true;
    for (auto const& t : m.triangles) {
        Vec3 const c = cross(m.p[static_cast<std::size_t>(t.y)] - m.p[static_cast<std::size_t>(t.x)],
                             m.p[static_cast<std::size_t>(t.z)] - m.p[static_cast<std::size_t>(t.x)]);
        sum += length(c);
        up = up && c.z > 0;
    }
    return {sum, up};
}

}  // namespace

TEST_CASE("triangles, with relative indices, texture coordinates and normals") {
    CHECK(mesh(square("f 1 2 3\nf 1 3 4\n")).p.size() == 4);
    CHECK(mesh(square("f -4 -3 -2")).triangles == std::vector<Vec3i>{{0, 1, 2}});
    auto const m =
        mesh(square("vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/2/1\n"));
    CHECK(m.p.size() == 4);
    CHECK(m.n == std::vector<Vec3>(4, Vec3{0, 0, 1}));
    CHECK(m.uv[3] == Vec2{1, 0});
    // The same point with two normals is two vertices.
    CHECK(mesh(square("vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n")).p.size() == 6);
    CHECK(mesh("\xef\xbb\xbf" + square("f 1 2 \\\n3 # end\r\ns 1\ng a b\nusemtl x\n")).triangles.size() == 1);
}

TEST_CASE("faces may come before their vertices") {
    CHECK(mesh("f 1 2 3\n" + square("")).p[2] == Vec3{1, 1, 0});
}

TEST_CASE("polygons, convex and not") {
    auto const [square_area, square_up] = area(mesh(square("f 1 2 3 4")));
    CHECK(square_area == doctest::Approx(2));
    CHECK(square_up);
    // An L: a fan from its first corner would cover what is outside.
    auto const l = area(mesh("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 3 4 5 6 1 2\n"));
    CHECK(l.first == doctest::Approx(6));
    CHECK(l.second);
    std::string ring, face = "f";
    for (int i = 0; i < 3000; ++i) {
        ring += "v " + std::to_string(std::cos(i * 2e-3)) + " " + std::to_string(std::sin(i * 2e-3)) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    auto const scene = scene_of(ring + face);
    CHECK(shape_of<TriangleMesh>(scene).triangles.size() == 2998);
    CHECK(contains(notes(scene), "1 faces of more than 1024 vertices were cut into fans"));
}

TEST_CASE("numbers keep all their bits") {
    CHECK(mesh("v 0.1 16777217 1e-30\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4").p[0] ==
          Vec3{0.1f, 16777216.0f, 1e-30f});
}

TEST_CASE("notes") {
    auto const scene =
        scene_of("mtllib nope.mtl\n" + square("vn 0 0 1\nvt 0 0\nf 1 2\nf 1/1/1 2/1/1 3/1/1\nf 1 2 3"));
    CHECK(contains(notes(scene), "materials are not read"));
    CHECK(contains(notes(scene), "1 faces of fewer than three vertices"));
    CHECK(contains(notes(scene), "some corners have no normal"));
    CHECK(contains(notes(scene), "some corners have no texture coordinates"));
    CHECK(shape_of<TriangleMesh>(scene).n.empty());
}

TEST_CASE("what is refused") {
    CHECK(error("") == "m.obj: no faces: not a mesh");
    CHECK(error(kSquare) == "m.obj: no faces: not a mesh");
    CHECK(error(square("f 1 2 5")) == "m.obj:5: f: index 5 is out of range; there are 4 lines v");
    CHECK(error(square("f 1/1 2/1 3/1")) == "m.obj:5: f: index 1 is out of range; there are 0 lines vt");
    CHECK(error(square("f 0 1 2")) == "m.obj:5: f: \"0\" is not an index; they count from 1");
    CHECK(error(square("f -5 1 2")) == "m.obj:5: f: index -5 is out of range");
    CHECK(error(square("f 1 2 99999999999")) == "m.obj:5: f: index 99999999999 is out of range");
    CHECK(contains(error(square("f 1/2/3/4 1 2")), "has too many slashes"));
    CHECK(contains(error(square("f 1.5 1 2")), "is not an index"));
    CHECK(error("v 0 nan 0") == "m.obj:1: v: \"nan\" is not a finite number");
    CHECK(error("v 0 0") == "m.obj:1: v: \"\" is not a finite number");
    CHECK(contains(error(std::string("v 0 0 0\nf\0 1", 12)), "m.obj:2: a NUL byte"));
    CHECK(contains(error("\xff\xfev"), "UTF-16"));
    CHECK(contains(error("mtllib /dev/zero\n" + square("f 1 2 3")),
                   "m.obj:1: mtllib \"/dev/zero\" is not a regular file"));
}
