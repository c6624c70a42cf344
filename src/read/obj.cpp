// OBJ files. tinyobjloader cuts polygons into triangles (by clipping ears, so concave ones come out right); it is given
// checked positions and faces only, because it trusts indices, tags and sizes as they stand.
#include "mesh_file.h"
#include "obj_lines.h"

#include "math/error.h"

#include <tiny_obj_loader.h>
#include <sstream>
#include <unordered_map>
#include <utility>

namespace nephroid {

namespace {

struct CornerHash {
    std::size_t operator()(ObjCorner const& c) const {
        std::uint64_t h = c[0];
        for (std::size_t i = 1; i < 3; ++i) h = (h ^ (h >> 29)) * 0x9E3779B97F4A7C15u + c[i];
        return static_cast<std::size_t>(h ^ (h >> 32));
    }
};

using Triangle = std::array<ObjCorner, 3>;

/// Clipping ears is quadratic in the corners: beyond this a fan must do.
constexpr std::uint32_t kMaxClipped = 1024;

class Cutter {
  public:
    Cutter(ObjLines const& lines, std::string const& name) : lines_(lines), name_(name) {}

    std::vector<Triangle> cut() {
        std::vector<Triangle> out;
        std::string polygons;  // those with more than three corners, as OBJ text
        std::size_t expected = 0;
        std::size_t at = 0;
        for (auto const size : lines_.face_sizes) {
            auto const* c = &lines_.corners[at];
            at += size;
            if (size == 3 || size > kMaxClipped) {
                for (std::uint32_t i = 2; i < size; ++i) out.push_back({c[0], c[i - 1], c[i]});
                if (size > 3) ++fans_;
            } else {
                append_face(polygons, c, size);
                expected += size - 2;
            }
        }
        if (polygons.empty()) return out;
        auto const before = out.size();
        clip(polygons, out);
        lost_ = expected - std::min(expected, out.size() - before);
        return out;
    }
    [[nodiscard]] std::size_t fans() const { return fans_; }
    [[nodiscard]] std::size_t lost() const { return lost_; }

  private:
    static void append_face(std::string& text, ObjCorner const* c, std::uint32_t size) {
        text += 'f';
        for (std::uint32_t i = 0; i < size; ++i) {
            text += ' ' + std::to_string(c[i][0]);
            if (c[i][1] > 0 || c[i][2] > 0) text += '/';
            if (c[i][1] > 0) text += std::to_string(c[i][1]);
            if (c[i][2] > 0) text += '/' + std::to_string(c[i][2]);
        }
        text += '\n';
    }

    void clip(std::string const& polygons, std::vector<Triangle>& out) const {
        std::ostringstream positions;
        positions.precision(9);
        for (auto const& p : lines_.p) positions << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
        std::istringstream in(std::move(positions).str() + polygons);
        tinyobj::attrib_t attrib;
        std::vector<tinyobj::shape_t> shapes;
        std::vector<tinyobj::material_t> materials;
        std::string warning, error;
        if (!tinyobj::LoadObj(&attrib, &shapes, &materials, &warning, &error, &in, nullptr, true, false))
            throw Error(ErrorKind::Input, name_ + ": " + error);
        for (auto const& shape : shapes) {
            auto const& indices = shape.mesh.indices;
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
                out.push_back({corner(indices[i]), corner(indices[i + 1]), corner(indices[i + 2])});
        }
    }

    /// Back to 1-based, 0 for none.
    static ObjCorner corner(tinyobj::index_t const& i) {
        auto const one = [](int index) { return static_cast<std::uint32_t>(index + 1); };
        return {one(i.vertex_index), one(i.texcoord_index), one(i.normal_index)};
    }

    ObjLines const& lines_;
    std::string const& name_;
    std::size_t fans_ = 0, lost_ = 0;
};

/// One vertex for each (position, texture coordinates, normal) that occurs.
TriangleMesh build(ObjLines const& lines, std::vector<Triangle> const& triangles,
                   std::vector<std::string>& notes, std::string const& name) {
    bool any_uv = false, all_uv = true, any_n = false, all_n = true;
    for (auto const& t : triangles)
        for (auto const& c : t) {
            any_uv = any_uv || c[1] > 0, all_uv = all_uv && c[1] > 0;
            any_n = any_n || c[2] > 0, all_n = all_n && c[2] > 0;
        }
    if (any_uv && !all_uv)
        notes.push_back(name + ": some corners have no texture coordinates: (0, 0) stands in");
    if (any_n && !all_n) notes.push_back(name + ": some corners have no normal: all normals are dropped");

    TriangleMesh mesh;
    std::unordered_map<ObjCorner, int, CornerHash> vertices;
    vertices.reserve(lines.p.size());
    mesh.triangles.reserve(triangles.size());
    for (auto const& t : triangles) {
        Vec3i triangle;
        for (int k = 0; k < 3; ++k) {
            ObjCorner c = t[static_cast<std::size_t>(k)];
            if (!all_n) c[2] = 0;
            auto const [it, is_new] = vertices.try_emplace(c, static_cast<int>(mesh.p.size()));
            if (is_new) {
                mesh.p.push_back(lines.p[c[0] - 1]);
                if (any_uv) mesh.uv.push_back(c[1] > 0 ? lines.uv[c[1] - 1] : Vec2{0, 0});
                if (all_n) mesh.n.push_back(lines.n[c[2] - 1]);
            }
            triangle[k] = it->second;
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

}  // namespace

MeshFile parse_obj(std::string_view text, std::string const& name, std::filesystem::path const& folder) {
    auto const lines = parse_obj_lines(text, name, folder);
    Cutter cutter(lines, name);
    auto const triangles = cutter.cut();
    if (triangles.empty()) throw Error(ErrorKind::Input, name + ": no faces: not a mesh");
    MeshFile file;
    file.mesh = build(lines, triangles, file.notes, name);
    auto const note = [&](std::size_t count, char const* what) {
        if (count > 0) file.notes.push_back(name + ": " + std::to_string(count) + " " + what);
    };
    note(lines.small_faces, "faces of fewer than three vertices were left out");
    note(cutter.fans(), "faces of more than 1024 vertices were cut into fans");
    note(cutter.lost(), "triangles of degenerate faces were left out");
    if (lines.has_materials)
        file.notes.push_back(name + ": materials are not read: the scene's own one is used");
    return file;
}

}  // namespace nephroid
