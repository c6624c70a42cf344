// A patch of light with a closed form, and an edge: what a small plane mirror throws on the floor of a point light. Seen in the
// mirror, the light stands at its image; the patch is where the line from there to the floor crosses the mirror.
#pragma once

#include "runs.h"

namespace nephroid::experiment {

/// The mirror stands in the plane x = 1, over [y0, y1] x [z0, z1]; the light, of intensity 1, at (0, 0, 1).
struct Patch {
    double y0, y1, z0, z1;
    /// Radiance of the floor at (x, y, 0) in the mirrored light alone.
    [[nodiscard]] double radiance(double x, double y) const;
};
constexpr Patch kSmallMirror{-0.35, 0.35, 0.3, 0.7};
/// So large that no edge of the patch is seen.
constexpr Patch kLargeMirror{-6, 6, 0.01, 0.99};

/// The floor straight from above, n x n points of [-0.3, 0.9] x [-0.6, 0.6].
Setup patch_setup(Patch const& patch, int n);
Reference patch_reference(Patch const& patch, Setup const& setup);

}  // namespace nephroid::experiment
