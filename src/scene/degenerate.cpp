// Objects that cannot be seen because they have no extent: scaled by 0, of radius 0, without a face.
#include "scene/affine_rows.h"
#include "scene/match.h"

#include <cmath>
#include <limits>
#include <vector>

namespace nephroid {

namespace {

constexpr double kFloatMax = static_cast<double>(std::numeric_limits<float>::max());

/// Within float's range, affine, and nevertheless without an inverse. Other faults are for validate() to report.
bool is_flat(Mat4 const& m) {
    for (auto const& row : m.m)
        for (double const x : row)
            if (!(std::abs(x) <= kFloatMax)) return false;
    return is_affine(m) && !make_transform(m) && std::isfinite(determinant3(m));
}

bool has_no_area(Shape const& shape) {
    return match(
        shape, [](TriangleMesh const& m) { return m.triangles.empty(); },
        [](BilinearMesh const& m) { return m.patches.empty(); },
        [](LoopSubdivision const& m) { return m.triangles.empty(); },
        [](Sphere const& s) { return s.radius == 0 || s.z_min == s.z_max || s.phi_max == 0; },
        [](Cylinder const& s) { return s.radius == 0 || s.z_min == s.z_max || s.phi_max == 0; },
        [](Disk const& s) { return s.radius == s.inner_radius || s.phi_max == 0; },
        [](Box const& s) {
            Vec3 const d = s.hi - s.lo;
            return int{d.x == 0} + int{d.y == 0} + int{d.z == 0} >= 2;
        },
        [](Quad const& s) { return cross_accurate(s.edge_u, s.edge_v) == Vec3(0); });
}

}  // namespace

void drop_degenerate(Scene& scene) {
    for (Group& group : scene.groups) {
        std::erase_if(group.objects, [&](Object const& object) {
            bool const flat = is_flat(object.to_group);
            if (!flat && !has_no_area(object.shape)) return false;
            scene.note(object.where, flat ? "the object's transform leaves nothing of it: object skipped"
                                          : "the object has no area: object skipped");
            return true;
        });
        std::erase_if(group.instances, [&](Instance const& instance) {
            if (!is_flat(matrix_of(instance.to_parent))) return false;
            scene.note(instance.where, "the instance's transform leaves nothing of it: instance skipped");
            return true;
        });
    }
}

}  // namespace nephroid
