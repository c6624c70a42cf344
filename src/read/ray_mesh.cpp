// Polymeshes: points, and faces that are cut into fans of triangles.
#include "ray_shapes.h"

#include <algorithm>

namespace nephroid {

namespace {

/// As in the file.
struct Polymesh {
    std::vector<Vec3> points, normals;
    std::vector<Vec3i> triangles;
    std::vector<SharedPhong> materials;
    bool generate_normals = false;
};

void read_faces(RayInput& in, std::vector<Vec3i>& triangles) {
    constexpr double kMost = 2147483647;
    in.list([&] {
        auto const where = in.here();
        int first = 0, last = 0, count = 0;
        in.list([&] {
            auto const at = in.here();
            double const number = in.number();
            if (!(number >= 0 && number <= kMost) || number != std::floor(number))
                in.context().fail(at, "the corner of a face must be the number of a point, from 0");
            int const corner = static_cast<int>(number);
            if (count == 0) first = corner;
            if (count >= 2) triangles.emplace_back(first, last, corner);
            last = corner;
            ++count;
        });
        if (count < 3) in.context().fail(where, "a face needs at least three corners");
    });
}

/// The mean of the faces' unit normals around each point.
std::vector<Vec3> smooth_normals(Polymesh const& m) {
    std::vector<Vec3> out(m.points.size(), Vec3{0});
    std::vector<Vec3> any(m.points.size(), Vec3{0, 0, 1});  // where the faces cancel: one of them
    for (auto const& t : m.triangles) {
        auto const at = [&](int k) { return m.points[static_cast<std::size_t>(t[k])]; };
        Vec3 const n = cross(at(1) - at(0), at(2) - at(0));
        float const size = length(n);
        if (!(size > 0) || !std::isfinite(size)) continue;
        for (int k = 0; k < 3; ++k) {
            out[static_cast<std::size_t>(t[k])] += n / size;
            any[static_cast<std::size_t>(t[k])] = n / size;
        }
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        float const size = length(out[i]);
        out[i] = size > 1e-4f ? out[i] / size : any[i];
    }
    return out;
}

void check(Context const& context, std::string const& what, SourceLocation where, Polymesh const& m) {
    auto const per_point = [&](std::size_t count, char const* name) {
        if (count > 0 && count != m.points.size())
            context.fail(where, what + ": " + std::to_string(count) + " " + name + " for " +
                                    std::to_string(m.points.size()) + " points; give one for each");
    };
    if (m.points.empty()) context.fail(where, what + " needs \"points\"");
    if (m.triangles.empty()) context.fail(where, what + " needs \"faces\"");
    per_point(m.normals.size(), "normals");
    per_point(m.materials.size(), "materials");
    for (auto const& t : m.triangles)
        for (int k = 0; k < 3; ++k)
            if (static_cast<std::size_t>(t[k]) >= m.points.size())
                context.fail(where, what + ": a face names point " + std::to_string(t[k]) +
                                        ", but there are " + std::to_string(m.points.size()) +
                                        ", counted from 0");
}

/// A mesh for each material; each has those points only that it uses.
std::vector<RayPiece> by_material(Polymesh const& m) {
    std::map<Phong const*, std::size_t> index;
    std::vector<RayPiece> pieces;
    std::vector<std::vector<Vec3i>> triangles;
    for (auto const& t : m.triangles) {
        auto const& phong = m.materials[static_cast<std::size_t>(t.x)];
        auto const [it, is_new] = index.try_emplace(phong.get(), pieces.size());
        if (is_new) {
            pieces.push_back({TriangleMesh{}, phong, true});
            triangles.emplace_back();
        }
        triangles[it->second].push_back(t);
    }
    std::vector<int> place(m.points.size(), -1);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        auto& mesh = std::get<TriangleMesh>(pieces[i].shape);
        for (auto t : triangles[i]) {
            for (int k = 0; k < 3; ++k) {
                auto const p = static_cast<std::size_t>(t[k]);
                if (place[p] < 0) {
                    place[p] = static_cast<int>(mesh.p.size());
                    mesh.p.push_back(m.points[p]);
                    if (!m.normals.empty()) mesh.n.push_back(m.normals[p]);
                }
                t[k] = place[p];
            }
            mesh.triangles.push_back(t);
        }
        for (auto const& t : triangles[i])
            for (int k = 0; k < 3; ++k) place[static_cast<std::size_t>(t[k])] = -1;
    }
    return pieces;
}

}  // namespace

std::vector<RayPiece> RayShapes::mesh(std::string_view name, SharedPhong phong, SourceLocation where) {
    Polymesh m;
    auto const parent = phong;
    auto const triples = [this](std::vector<Vec3>& out) {
        return [this, &out] {
            out.clear();
            in_.need('=');
            in_.list([&] { out.push_back(in_.triple()); });
        };
    };
    in_.block(name, {material(phong),
                     name_attribute(),
                     {"points", {}, triples(m.points)},
                     {"normals", {}, triples(m.normals)},
                     {"faces",
                      {},
                      [&] {
                          m.triangles.clear();
                          in_.need('=');
                          read_faces(in_, m.triangles);
                      }},
                     {"materials",
                      {},
                      [&] {
                          m.materials.clear();
                          in_.need('=');
                          in_.list([&] { m.materials.push_back(materials_.read(in_, parent)); });
                      }},
                     {"gennormals", {}, [&] {  // alone, or "= true"
                          m.generate_normals = !in_.take_if('=') || in_.boolean();
                      }}});
    auto& context = in_.context();
    check(context, std::string(name), where, m);
    if (m.generate_normals && !m.normals.empty())
        context.note(where, std::string(name) + ": \"normals\" are given, so \"gennormals\" does nothing");
    if (m.generate_normals && m.normals.empty()) m.normals = smooth_normals(m);
    if (!m.materials.empty()) {
        context.note(where,
                     "materials of points are not blended over a face: it has that of its first corner");
        return by_material(m);
    }
    return {
        {TriangleMesh{std::move(m.points), std::move(m.normals), {}, std::move(m.triangles)}, phong, true}};
}

}  // namespace nephroid
