// The body of a PLY file.
#include "mesh_file.h"
#include "ply_source.h"
#include "shown.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nephroid {

namespace {

using DVec3 = glm::vec<3, double>;

/// Where the properties that a mesh has are among those of the vertex element; -1: nowhere.
struct VertexLayout {
    // x y z nx ny nz u v
    std::array<int, 8> at;
    [[nodiscard]] bool has_points() const { return at[0] >= 0 && at[1] >= 0 && at[2] >= 0; }
    [[nodiscard]] bool has_normals() const { return at[3] >= 0 && at[4] >= 0 && at[5] >= 0; }
    [[nodiscard]] bool has_uv() const { return at[6] >= 0 && at[7] >= 0; }
};

VertexLayout layout_of(PlyElement const& e) {
    constexpr std::array<std::pair<std::string_view, int>, 16> kNames{{{"x", 0},
                                                                       {"y", 1},
                                                                       {"z", 2},
                                                                       {"nx", 3},
                                                                       {"ny", 4},
                                                                       {"nz", 5},
                                                                       {"u", 6},
                                                                       {"v", 7},
                                                                       {"s", 6},
                                                                       {"t", 7},
                                                                       {"texture_u", 6},
                                                                       {"texture_v", 7},
                                                                       {"texture_s", 6},
                                                                       {"texture_t", 7},
                                                                       {"uv1", 6},
                                                                       {"uv2", 7}}};
    VertexLayout layout;
    layout.at.fill(-1);
    for (std::size_t i = 0; i < e.properties.size(); ++i)
        for (auto const& [name, slot] : kNames)
            if (e.properties[i].name == name && !e.properties[i].is_list)
                layout.at[static_cast<std::size_t>(slot)] = static_cast<int>(i);
    return layout;
}

template <class Source>
class BodyReader {
  public:
    BodyReader(Source source, PlyHeader const& header, std::string const& name)
        : source_(std::move(source)), header_(header), name_(name) {}

    MeshFile read() {
        bool has_vertices = false;
        for (auto const& e : header_.elements) {
            if (e.name == "vertex") {
                if (has_vertices) fail(e, "a second vertex element");
                has_vertices = true;
                vertices(e);
            } else if (e.name == "face") {
                faces(e);
            } else {
                skip(e);
            }
        }
        if (!has_vertices) throw Error(ErrorKind::Input, name_ + ": no \"vertex\" element: not a mesh");
        if (mesh_.triangles.empty()) throw Error(ErrorKind::Input, name_ + ": no faces: not a mesh");
        check_indices();
        auto const bent = bent_quads();
        MeshFile file{std::move(mesh_), {}};
        if (bent > 0)
            file.notes.push_back(
                name_ + ": " + std::to_string(bent) +
                " quads are not flat: two triangles stand in for each (pbrt: a bilinear patch)");
        if (small_faces_ > 0)
            file.notes.push_back(name_ + ": " + std::to_string(small_faces_) +
                                 " faces of fewer than three vertices were left out");
        return file;
    }

  private:
    [[noreturn]] void fail(PlyElement const& e, std::string const& message) const {
        throw Error(ErrorKind::Input, name_ + ":" + std::to_string(e.line) + ": " + message);
    }

    std::uint64_t list_length(PlyProperty const& p) {
        double const n = source_.read(p.count_type);
        if (n < 0) source_.fail("a list of negative length");
        auto const length = static_cast<std::uint64_t>(n);
        if (length > source_.most_values(p.type))
            source_.fail("a list of " + std::to_string(length) + " runs off the end of the file");
        return length;
    }
    void skip(PlyProperty const& p) { source_.skip(p.type, p.is_list ? list_length(p) : 1); }
    void skip(PlyElement const& e) {
        if (e.properties.empty()) return;  // nothing in the file, however many
        for (std::uint64_t i = 0; i < e.count; ++i) {
            source_.begin(e, i);
            for (auto const& p : e.properties) skip(p);
        }
    }

    void vertices(PlyElement const& e) {
        auto const layout = layout_of(e);
        if (!layout.has_points()) fail(e, "vertices need the properties x, y and z");
        bool const normals = layout.has_normals(), uv = layout.has_uv();
        mesh_.p.reserve(e.count);
        if (normals) mesh_.n.reserve(e.count);
        if (uv) mesh_.uv.reserve(e.count);
        // For each property the slot of its value, or 8 for those that are not wanted.
        std::vector<std::size_t> slots(e.properties.size(), 8);
        for (std::size_t s = 0; s < layout.at.size(); ++s)
            if (layout.at[s] >= 0) slots[static_cast<std::size_t>(layout.at[s])] = s;
        std::array<float, 9> v{};
        for (std::uint64_t i = 0; i < e.count; ++i) {
            source_.begin(e, i);
            for (std::size_t k = 0; k < slots.size(); ++k) {
                auto const& p = e.properties[k];
                if (slots[k] == 8) {
                    skip(p);
                    continue;
                }
                v[slots[k]] = static_cast<float>(source_.read(p.type));
                if (!std::isfinite(v[slots[k]]))
                    source_.fail("property \"" + shown(p.name) + "\" is not a finite number");
            }
            mesh_.p.emplace_back(v[0], v[1], v[2]);
            if (normals) mesh_.n.emplace_back(v[3], v[4], v[5]);
            if (uv) mesh_.uv.emplace_back(v[6], v[7]);
        }
    }

    void faces(PlyElement const& e) {
        auto const wanted = [](PlyProperty const& p) {
            return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
        };
        auto const found = std::find_if(e.properties.begin(), e.properties.end(), wanted);
        if (found == e.properties.end()) fail(e, "faces need a list property vertex_indices");
        if (!is_integer(found->type)) fail(e, "vertex_indices must have an integer type");
        mesh_.triangles.reserve(mesh_.triangles.size() + e.count);
        for (std::uint64_t i = 0; i < e.count; ++i) {
            source_.begin(e, i);
            for (auto const& p : e.properties) {
                if (&p == &*found)
                    fan(p);
                else
                    skip(p);
            }
        }
    }

    void fan(PlyProperty const& p) {
        auto const n = list_length(p);
        if (n < 3) {
            ++small_faces_;
            return source_.skip(p.type, n);
        }
        if (n == 4) quads_.push_back(mesh_.triangles.size());
        int const first = index(p.type);
        int previous = index(p.type);
        for (std::uint64_t i = 2; i < n; ++i) {
            int const next = index(p.type);
            mesh_.triangles.emplace_back(first, previous, next);
            previous = next;
        }
    }

    /// How many quads have a corner that lies off the plane of the others, by more than the rounding of their numbers.
    [[nodiscard]] std::size_t bent_quads() const {
        auto const bent = [&](std::size_t triangle) {
            auto const& p = mesh_.p;
            auto const t = mesh_.triangles[triangle];
            DVec3 const a(p[static_cast<std::size_t>(t.x)]);
            DVec3 const ab = DVec3(p[static_cast<std::size_t>(t.y)]) - a;
            DVec3 const ac = DVec3(p[static_cast<std::size_t>(t.z)]) - a;
            DVec3 const ad = DVec3(p[static_cast<std::size_t>(mesh_.triangles[triangle + 1].z)]) - a;
            double const size = std::max({glm::length(ab), glm::length(ac), glm::length(ad)});
            return std::abs(glm::dot(glm::cross(ab, ac), ad)) > 1e-3 * size * size * size;
        };
        return static_cast<std::size_t>(std::count_if(quads_.begin(), quads_.end(), bent));
    }

    int index(PlyType type) {
        double const v = source_.read(type);
        if (!(v >= 0 && v <= 2147483647.0)) source_.fail("a vertex index is out of range");
        // Faces may stand before the vertices, so the other limit waits for check_indices().
        return static_cast<int>(v);
    }

    void check_indices() const {
        auto const count = static_cast<int>(mesh_.p.size());
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
            for (int k = 0; k < 3; ++k)
                if (mesh_.triangles[i][k] >= count)
                    throw Error(ErrorKind::Input,
                                name_ + ": triangle " + std::to_string(i) + ": vertex index " +
                                    std::to_string(mesh_.triangles[i][k]) + " is out of range; there are " +
                                    std::to_string(count) + " vertices");
    }

    Source source_;
    PlyHeader const& header_;
    std::string const& name_;
    TriangleMesh mesh_;
    std::uint64_t small_faces_ = 0;
    std::vector<std::size_t> quads_;  // the first triangle of each
};

}  // namespace

MeshFile parse_ply(std::string_view bytes, std::string const& name) {
    auto const header = parse_ply_header(bytes, name);
    if (header.format == PlyFormat::Ascii)
        return BodyReader(AsciiSource(bytes, header, name), header, name).read();
    return BodyReader(BinarySource(bytes, header, name), header, name).read();
}

}  // namespace nephroid
