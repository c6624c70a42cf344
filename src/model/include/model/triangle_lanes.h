// Points on eight triangles at once, each with the bits that triangle_surface() (shape.h) gives it.
#pragma once

#include "math/lanes.h"
#include "scene/shape.h"

namespace nephroid {

/// What a SurfacePoint says first.
struct SurfaceLanes {
    Vec3Lanes p, p_error, ng, ns;
};

class TriangleLanes {
  public:
    /// The point of `uv`, the intersector's coordinates. A lane is set once.
    void set(std::size_t lane, TriangleMesh const& mesh, std::uint32_t triangle, Vec2 uv, bool flip);
    /// Lanes that were not set mean nothing.
    void surfaces(SurfaceLanes& s) const;

  private:
    std::array<Vec3Lanes, 3> p_, n_;  // of the corners; n 0: the mesh has none
    Vec2Lanes uv_;
    std::array<std::uint32_t, kLanes> flip_{};
    bool shaded_ = false;
};

}  // namespace nephroid
