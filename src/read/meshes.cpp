// Meshes written in the scene file, and those in files of their own.
#include "shapes.h"

#include "mesh_file.h"

namespace nephroid {

namespace {

std::vector<Vec3> points(Params& p) {
    auto out = p.points3("P");
    if (out.empty()) p.fail("needs \"point3 P\"");
    return out;
}

/// Per-vertex data that does not match the points is dropped, as in pbrt.
template <class T>
std::vector<T> per_point(Params const& p, std::vector<T> values, char const* name, std::size_t count) {
    if (values.empty() || values.size() == count) return values;
    p.note("\"" + std::string(name) + "\" has " + std::to_string(values.size()) + " entries for " +
           std::to_string(count) + " points, and is dropped");
    return {};
}

/// The indices in groups of `n`; 0, 1, … where none are given and there are just `n` points.
std::vector<int> indices(Params& p, std::size_t n, std::size_t point_count) {
    auto out = p.integers("indices");
    if (out.empty()) {
        if (point_count != n)
            p.fail("needs \"integer indices\" unless it has just " + std::to_string(n) + " points");
        for (std::size_t i = 0; i < n; ++i) out.push_back(static_cast<int>(i));
    }
    auto const where = p.find("indices") ? p.find("indices")->where : p.where();
    auto const fail = [&](std::string const& text) {
        p.context().fail(where, p.what() + ": \"indices\": " + text);
    };
    if (out.size() % n != 0) {
        p.context().note(where, p.what() + ": \"indices\": " + std::to_string(out.size()) +
                                    " entries are not a multiple of " + std::to_string(n) +
                                    ": the last ones are dropped");
        out.resize(out.size() - out.size() % n);
    }
    for (int const i : out)
        if (i < 0 || static_cast<std::size_t>(i) >= point_count)
            fail(std::to_string(i) + " is not a point; there are " + std::to_string(point_count));
    return out;
}

std::vector<Vec3i> triangles(std::vector<int> const& i) {
    std::vector<Vec3i> out;
    out.reserve(i.size() / 3);
    for (std::size_t k = 0; k + 2 < i.size(); k += 3) out.emplace_back(i[k], i[k + 1], i[k + 2]);
    return out;
}

std::vector<Vec2> texture_coordinates(Params& p, std::size_t count) {
    return per_point(p, p.points2("uv"), "uv", count);
}

}  // namespace

TriangleMesh triangle_mesh(Params& p) {
    TriangleMesh m;
    m.p = points(p);
    m.n = per_point(p, p.normals("N"), "N", m.p.size());
    m.uv = texture_coordinates(p, m.p.size());
    m.triangles = triangles(indices(p, 3, m.p.size()));
    if (p.find("S", {ParamType::Vector3})) p.note("shading tangents \"S\" are not used yet");
    p.find("faceIndices");
    return m;
}

BilinearMesh bilinear_mesh(Params& p) {
    BilinearMesh m;
    m.p = points(p);
    m.n = per_point(p, p.normals("N"), "N", m.p.size());
    m.uv = texture_coordinates(p, m.p.size());
    auto const i = indices(p, 4, m.p.size());
    for (std::size_t k = 0; k + 3 < i.size(); k += 4)
        m.patches.push_back({i[k], i[k + 1], i[k + 2], i[k + 3]});
    p.find("faceIndices");
    if (p.find("emissionfilename", {ParamType::String})) p.note("\"emissionfilename\" is not used yet");
    return m;
}

LoopSubdivision loop_subdivision(Params& p) {
    LoopSubdivision s;
    s.p = points(p);
    s.triangles = triangles(indices(p, 3, s.p.size()));
    s.levels = p.integer("levels", 3);
    if (s.levels < 0 || s.levels > 10) p.fail("\"levels\" must be from 0 to 10");
    p.find("scheme");
    return s;
}

TriangleMesh mesh_from_file(Params& p) {
    auto const name = p.string("filename", "");
    if (name.empty()) p.fail("needs a \"string filename\"");
    auto const where = p.find("filename")->where;
    auto file = read_mesh(p.context(), where, p.context().resolve(where, name));
    for (auto const& text : file.notes) p.context().note(where, text);
    if (p.find("displacement", {ParamType::Float, ParamType::Texture}))
        p.note("displacement is not rendered yet");
    p.find("edgelength");
    return std::move(file.mesh);
}

}  // namespace nephroid
