// Points of a rectangle drawn uniformly by the solid angle under which a receiver sees it, from either side.
// Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles": their map, with the inverse of the
// strip's solid angle written without angles, so that far and grazing rectangles lose no precision (see the .cpp).
#pragma once

#include "math/vec.h"

namespace nephroid {

/// What is known of the rectangle before there is a receiver: unit vectors along its edges and across them, and the edges' lengths.
struct RectangleAxes {
    Vec3 x, y, n;
    float width, height;
};
/// The edges are at right angles to each other.
RectangleAxes rectangle_axes(Vec3 edge_x, Vec3 edge_y);

class SphericalRectangle {
  public:
    /// `corner`: where both edges start, relative to the receiver; any unit of length.
    SphericalRectangle(RectangleAxes const& axes, Vec3 corner);

    /// Steradians, at most 2 pi; 0 where the rectangle is seen from its own plane, and then nothing can be drawn.
    [[nodiscard]] float solid_angle() const { return static_cast<float>(solid_angle_); }
    /// Where along the edges, in [0,1]^2. Density by solid angle: 1 / solid_angle(). u.x moves the point along x, and u.y along y:
    /// the corners of the square are the corners of the rectangle.
    [[nodiscard]] Vec2 sample(Vec2 u) const;
    /// The u that sample() makes `st` of.
    [[nodiscard]] Vec2 invert(Vec2 st) const;

  private:
    // The rectangle is [x0, x1] x [y0, y1] at the distance z > 0.
    double x0_, x1_, y0_, y1_, z_, solid_angle_;
    double r00_, r01_;  // distances of the corners (x0, y0) and (x0, y1)
};

}  // namespace nephroid
