#include "records.h"

#include "scene/match.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// Shape space to the group's: the identity for what was baked.
AffineMap const& place_of(ObjectRecord const& r) {
    static AffineMap const identity;
    return r.place ? r.place->shape_to_group : identity;
}

void turn(SurfacePoint& s, bool flip) {
    if (!flip) return;
    s.ng = -s.ng;
    s.ns = -s.ns;
}

/// Bilinear meshes are baked and carry their own side in their normals, where they have any; `flip` is then done already.
bool flips(ObjectRecord const& r) {
    if (auto const* m = std::get_if<BilinearMesh>(&r.object->shape)) return r.flip && m->n.empty();
    return r.flip;
}

}  // namespace

void analytic_surface(ObjectRecord const& r, ShapeHit const& hit, Vec3 local, bool coordinates,
                      SurfacePoint& s) {
    match(
        r.object->shape, [](TriangleMesh const&) {}, [](LoopSubdivision const&) {},
        [&](auto const& shape) {
            if constexpr (std::is_same_v<decltype(shape), Sphere const&>)
                s = coordinates ? surface(shape, hit, local) : bare_surface(shape, local);
            else
                s = surface(shape, hit, local);
            turn(s, flips(r));
            if (r.place) s = transformed(r.place->shape_to_group, s);
        });
}

ShapeSample sample_part(ObjectRecord const& r, InstanceRecord const* instance, std::uint32_t part, Vec2 u) {
    ShapeSample s = match(
        r.object->shape, [&](TriangleMesh const& m) { return sample_triangle(m, part, r.flip, u); },
        [](LoopSubdivision const&) { return ShapeSample{}; },
        [&](auto const& shape) {
            ShapeSample local = sample(shape, part, u);
            if (flips(r)) local.n = -local.n;
            return r.place ? transformed(r.place->shape_to_group, local) : local;
        });
    if (instance) s = transformed(instance->to_world, s);
    return s;
}

float part_pdf(ObjectRecord const& r, InstanceRecord const* instance, std::uint32_t part, Vec2 hit_uv,
               Vec3 ng_world) {
    // A uniform density divides by the stretch of the surface element: |cofactor(M) n_local|. The local normal from the
    // world's: n_local ~ M^T n_world.
    auto const unstretch = [](AffineMap const& map, Vec3& n) {
        Vec3 const local = normalize(Vec3{map.m[0][0] * n.x + map.m[1][0] * n.y + map.m[2][0] * n.z,
                                          map.m[0][1] * n.x + map.m[1][1] * n.y + map.m[2][1] * n.z,
                                          map.m[0][2] * n.x + map.m[1][2] * n.y + map.m[2][2] * n.z});
        n = local;
        return length(map.area_vector(local));
    };
    Vec3 n = ng_world;
    float stretch = instance ? unstretch(instance->to_world, n) : 1.0f;
    if (r.place) stretch *= unstretch(place_of(r), n);
    float const local = match(
        r.object->shape, [&](TriangleMesh const& m) { return 1.0f / triangle_area(m, part); },
        [](LoopSubdivision const&) { return 0.0f; },
        [&](auto const& shape) { return sample_pdf(shape, part, hit_uv); });
    return local / stretch;
}

std::uint32_t part_count(ObjectRecord const& r) {
    return match(
        r.object->shape, [](TriangleMesh const& m) { return static_cast<std::uint32_t>(m.triangles.size()); },
        [](LoopSubdivision const&) { return 0u; }, [](auto const& shape) { return part_count(shape); });
}

float part_area(ObjectRecord const& r, InstanceRecord const* instance, std::uint32_t part) {
    // The area is the mean of 1/pdf over the square. That is the same everywhere for triangles and under similarities, where
    // three by three points show it (two by two would fall for an ellipsoid's symmetry); else a midpoint rule is refined until
    // it stands still.
    auto const mean = [&](int n, bool& constant) {
        double sum = 0;
        double least = HUGE_VAL;
        double greatest = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                float const pdf = sample_part(r, instance, part,
                                              {(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
                                               (static_cast<float>(j) + 0.5f) / static_cast<float>(n)})
                                      .pdf_area;
                if (!(pdf > 0.0f) || !std::isfinite(pdf)) continue;
                double const area = 1.0 / static_cast<double>(pdf);
                sum += area;
                least = std::min(least, area);
                greatest = std::max(greatest, area);
            }
        constant = greatest - least <= 1e-5 * greatest;
        return sum / (n * n);
    };
    bool constant = false;
    if (std::holds_alternative<TriangleMesh>(r.object->shape)) return static_cast<float>(mean(1, constant));
    double area = mean(3, constant);
    for (int n = 8; n <= 512 && !constant; n *= 2) {
        bool same = false;
        double const finer = mean(n, same);
        constant = same || std::abs(finer - area) <= 1e-5 * finer;
        area = finer;
    }
    return static_cast<float>(area);
}

}  // namespace nephroid
