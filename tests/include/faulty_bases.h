// Bases about a normal that are wrong, each in a way that renderers have had: what tests must reject, and what docs/report shows the
// effect of. Nothing of the renderer may include this.
#pragma once

#include "math/frame.h"

#include <cmath>

namespace nephroid::test {

/// The classical faulty basis: crossed with a fixed axis, and never normalised. Its directions lean towards that axis.
inline Frame unnormalised_basis(Vec3 n) {
    Vec3 const axis = std::abs(n.x) > 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    Vec3 const t = cross(n, axis);
    return {t, cross(n, t), n};
}
/// Another one: one tangent normalised, the other not, so that azimuths crowd about the longer one.
inline Frame half_normalised_basis(Vec3 n) {
    Vec3 const axis = std::abs(n.x) > 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    Vec3 const t = cross(n, axis);
    return {t, cross(n, normalize(t)), n};
}
/// One that takes the helping axis itself for a tangent, though it is not at right angles to the normal: everything leans to one side.
inline Frame skewed_basis(Vec3 n) {
    Vec3 const axis = std::abs(n.x) > 0.9f ? Vec3{0, 0.8f, 0.6f} : Vec3{0.8f, 0, 0.6f};
    return {axis, normalize(cross(n, axis)), n};
}

}  // namespace nephroid::test
