// Points of a triangle drawn uniformly by the solid angle under which a receiver sees it, from either side. The map is Arvo's
// (1995, "Stratified Sampling of Spherical Triangles"), written with tangents of half-angles (see the .cpp): one arc tangent to
// make it, one sine and cosine to draw.
#pragma once

#include "math/vec.h"

#include <optional>

namespace nephroid {

class SphericalTriangle {
  public:
    /// Corners relative to the receiver; any unit of length.
    SphericalTriangle(Vec3 a, Vec3 b, Vec3 c);

    /// Steradians, below 2 pi; 0 where the triangle is seen from its own plane, and then nothing can be drawn.
    [[nodiscard]] float solid_angle() const { return static_cast<float>(solid_angle_); }
    /// Barycentric coordinates (of b and c). Density by solid angle: 1 / solid_angle(). The corners of the square: u = (0,0) and
    /// (1,0) are b, (0,1) is a and (1,1) is c.
    [[nodiscard]] Vec2 sample(Vec2 u) const;
    /// The point that barycentric coordinates stand for, relative to the receiver, not of unit length.
    [[nodiscard]] Vec3 point(Vec2 bc) const { return (1.0f - bc.x - bc.y) * a_ + bc.x * b_ + bc.y * c_; }
    /// The u that sample() makes `bc` of. What lies outside by rounding is put back on the edge.
    [[nodiscard]] Vec2 invert(Vec2 bc) const;
    /// The same of a direction (any length); nothing where it misses the triangle. For a small triangle a direction in float says
    /// less about the point than its barycentric coordinates do.
    [[nodiscard]] std::optional<Vec2> invert(Vec3 w) const;

  private:
    Vec3 a_, b_, c_;
    double la_, lb_, lc_;  // lengths
    double volume_;        // |a . (b x c)|
    double solid_angle_;
};

}  // namespace nephroid
