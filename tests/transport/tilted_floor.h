// A floor whose shading normals lean, in light from straight above: what a camera above it sees is rho E cos 30 / pi.
#pragma once

#include "scenes.h"

namespace nephroid::test {

/// A square of this half side, with normals tilted by 30 degrees towards +x.
inline TriangleMesh tilted_floor(float half) {
    TriangleMesh m = rectangle({-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0});
    m.n.assign(4, Vec3{0.5f, 0, std::sqrt(0.75f)});
    return m;
}
/// Reflectance .6, and a distant light that brings 1 to a facing surface.
inline Scene tilted_floor_lit_from_above() {
    Scene s;
    add(s, tilted_floor(1), diffuse(s, 0.6f));
    DistantLight d;
    d.from = {0, 0, 1};
    d.to = {0, 0, 0};
    s.add(Light{d, {}, {}});
    look_parallel(s, {0, 0, 2}, {0, 0, -1}, 0.5f);
    return s;
}

}  // namespace nephroid::test
