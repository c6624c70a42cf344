// Shapes of ours as meshes of pbrt-v4's, and the power of meshes, which pbrt-v4 gives to each of their faces.
#include "portable.h"

#include "scene/match.h"

namespace nephroid {

namespace {

/// Six patches with their normals outwards.
BilinearMesh mesh_of(Box const& b) {
    BilinearMesh m;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            int const u = (axis + 1) % 3, v = (axis + 2) % 3;
            // A box without height has two faces, one on the other; without width, no such face.
            if (b.lo[u] == b.hi[u] || b.lo[v] == b.hi[v]) continue;
            int const first = static_cast<int>(m.p.size());
            for (int k = 0; k < 4; ++k) {
                Vec3 p;
                p[axis] = side ? b.hi[axis] : b.lo[axis];
                // u x v is along the axis; on the lower side the two change places.
                int const a = side ? u : v, c = side ? v : u;
                p[a] = k % 2 ? b.hi[a] : b.lo[a];
                p[c] = k / 2 ? b.hi[c] : b.lo[c];
                m.p.push_back(p);
            }
            m.patches.push_back({first, first + 1, first + 2, first + 3});
        }
    return m;
}

BilinearMesh mesh_of(Quad const& q) {
    BilinearMesh m;
    m.p = {q.origin, q.origin + q.edge_u, q.origin + q.edge_v, q.origin + q.edge_u + q.edge_v};
    m.patches = {{0, 1, 2, 3}};
    return m;
}

using DVec3 = std::array<double, 3>;
DVec3 transformed(Mat4 const& m, Vec3 p) {
    DVec3 out{};
    for (std::size_t r = 0; r < 3; ++r)
        out[r] = m.m[r][0] * static_cast<double>(p.x) + m.m[r][1] * static_cast<double>(p.y) +
                 m.m[r][2] * static_cast<double>(p.z) + m.m[r][3];
    return out;
}
double triangle_area(DVec3 const& a, DVec3 const& b, DVec3 const& c) {
    DVec3 u{}, v{};
    for (std::size_t i = 0; i < 3; ++i) u[i] = b[i] - a[i], v[i] = c[i] - a[i];
    double const x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return 0.5 * std::sqrt(x * x + y * y + z * z);
}

/// Of meshes of more than one face, in the world; nothing for other shapes. Patches count as flat.
std::optional<double> area_of_many(Shape const& shape, Mat4 const& to_world) {
    auto const sum = [&](auto const& m, auto const& faces, auto const& corners) -> std::optional<double> {
        std::optional<double> none;
        if (faces.size() < 2) return none;
        double area = 0;
        for (auto const& f : faces)
            for (std::array<int, 3> const& t : corners(f)) {
                auto const at = [&](std::size_t k) {
                    return transformed(to_world, m.p[static_cast<std::size_t>(t[k])]);
                };
                area += triangle_area(at(0), at(1), at(2));
            }
        return area;
    };
    using Triangles = std::vector<std::array<int, 3>>;
    return match(
        shape,
        [&](TriangleMesh const& m) {
            return sum(m, m.triangles, [](Vec3i t) { return Triangles{{t.x, t.y, t.z}}; });
        },
        [&](BilinearMesh const& m) {
            return sum(m, m.patches, [](std::array<int, 4> const& q) {
                return Triangles{{q[0], q[1], q[3]}, {q[0], q[3], q[2]}};
            });
        },
        [](auto const&) { return std::optional<double>(); });
}

void make_light_portable(Scene& scene, Object& o) {
    AreaLight& l = *o.light;
    if (l.texture.valid()) {
        auto const* picture = std::get_if<ImageTexture>(&scene[l.texture].kind);
        auto const* constant = std::get_if<ConstantSpectrumTexture>(&scene[l.texture].kind);
        if (picture && scene[picture->image].encoding.empty()) {
            l.image = picture->image;
            l.scale *= picture->scale;
            scene.note(o.where, "the light's texture is replaced by its picture, over the whole shape");
        } else if (constant && std::holds_alternative<TabulatedSpd>(constant->value)) {
            l.radiance = constant->value;
            scene.note(o.where, "the light's texture is replaced by its spectrum");
        } else {
            scene.note(o.where, "the light's texture is replaced by white");
        }
        l.texture = {};
    }
    if (!(l.power > 0)) return;
    if (auto const area = area_of_many(o.shape, o.to_group); area && *area > 0) {
        // Both normalise the spectrum's luminance; what is left of the power is the radiance that a face needs.
        double const sides = l.two_sided ? 2 : 1;
        l.scale *= static_cast<float>(static_cast<double>(l.power) / (kPiDouble * *area * sides));
        l.power = -1;
    } else if (std::holds_alternative<LoopSubdivision>(o.shape)) {
        scene.note(o.where,
                   "the power of a subdivided mesh is left out, as pbrt-v4 would give it to each face");
        l.power = -1;
    }
}

}  // namespace

void make_objects_portable(Scene& scene) {
    for (Group& g : scene.groups)
        for (Object& o : g.objects) {
            match(
                o.shape,
                [&](Box const& b) {
                    scene.note(o.where, "\"box\" is replaced by six bilinear patches");
                    o.shape = Shape{mesh_of(Box(b))};
                },
                [&](Quad const& q) {
                    scene.note(o.where, "\"quad\" is replaced by a bilinear patch");
                    o.shape = Shape{mesh_of(Quad(q))};
                },
                [](auto const&) {});
            if (o.light && std::holds_alternative<InterfaceMaterial>(scene[o.material].kind)) o.light.reset();
            if (o.light) make_light_portable(scene, o);
        }
}

}  // namespace nephroid
