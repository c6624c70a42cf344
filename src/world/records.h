// What the world keeps for each object and instance beside the scene's own structs.
#pragma once

#include "model/shape.h"
#include "model/surface.h"
#include "scene/scene.h"
#include "world/hit.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid {

/// An analytic shape's place in its group, in double for the intersection (model/shape.h) and in float for the rest.
struct AnalyticPlace {
    std::array<std::array<double, 4>, 3> group_to_shape;
    AffineMap shape_to_group;

    /// A ray of the group in the shape's space; t stays what it is. Without a branch, so that lanes may use it.
    static Ray3d in_shape(std::array<std::array<double, 4>, 3> const& m, Ray3d const& r) {
        Ray3d local;
        for (std::size_t k = 0; k < 3; ++k) {
            local.o[k] = m[k][0] * r.o[0] + m[k][1] * r.o[1] + m[k][2] * r.o[2] + m[k][3];
            local.d[k] = m[k][0] * r.d[0] + m[k][1] * r.d[1] + m[k][2] * r.d[2];
        }
        return local;
    }
};

struct ObjectRecord {
    static constexpr std::uint32_t kNoLight = 0xFFFFFFFFu;

    Object const* object = nullptr;
    std::unique_ptr<AnalyticPlace> place;  // analytic shapes only; meshes are baked into their group's space
    std::uint32_t first_light = kNoLight;  // of part 0, relative to the appearance's first light
    std::uint32_t emitter = kNoLight;      // index of its emission
    MaterialId material;
    bool flip = false;      // the surface's side is the other one
    bool textured = false;  // wants uv and tangents
    Passage passage = Passage::Solid;

    /// A ray of its group in the space of an analytic shape.
    [[nodiscard]] Ray3d in_shape(Ray3d const& r) const {
        return place ? AnalyticPlace::in_shape(place->group_to_shape, r) : r;
    }
    [[nodiscard]] bool emits() const { return first_light != kNoLight; }
};

/// One appearance of a group in world space; the flattened end of a chain of nested instances.
struct InstanceRecord {
    AffineMap to_world;
    std::uint32_t first_record = 0;  // of the group's objects
    std::uint32_t first_light = 0;   // of the appearance's emitters
};

/// Geometry of a hit on anything but triangles, in the group's space; `coordinates`: uv and tangents are wanted.
void analytic_surface(ObjectRecord const& record, ShapeHit const& hit, Vec3 local, bool coordinates,
                      SurfacePoint& s);

/// Geometry of a hit, in world space. `local` is the point in the space of an analytic shape, off by rounding.
/// Fills `s` in place.
inline void surface_at(ObjectRecord const& record, InstanceRecord const* instance, ShapeHit const& hit,
                       Vec3 const& local, bool tangents, SurfacePoint& s) {
    if (auto const* mesh = std::get_if<TriangleMesh>(&record.object->shape)) {
        triangle_surface(*mesh, hit.part, {hit.u, hit.v}, record.flip, tangents, s);
    } else {
        // What shines may have a picture.
        analytic_surface(record, hit, local, tangents || record.emits(), s);
    }
    if (instance) s = transformed(instance->to_world, s);
}
/// Uniform by area over one part, in world space.
ShapeSample sample_part(ObjectRecord const& record, InstanceRecord const* instance, std::uint32_t part,
                        Vec2 u);
/// Density by area, in world space, with which sample_part finds that hit.
float part_pdf(ObjectRecord const& record, InstanceRecord const* instance, std::uint32_t part, Vec2 hit_uv,
               Vec3 ng_world);
std::uint32_t part_count(ObjectRecord const& record);
/// World-space area of a part (for an analytic shape under a shear: by quadrature).
float part_area(ObjectRecord const& record, InstanceRecord const* instance, std::uint32_t part);

}  // namespace nephroid
