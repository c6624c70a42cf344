// Points of a rectangle drawn uniformly by the solid angle under which a receiver sees it, from either side.
// Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles": their map, with the inverse of the
// strip's solid angle written without angles, so that far and grazing rectangles lose no precision (see below).
#pragma once

#include "sampling/arc.h"

#include <cmath>

namespace nephroid {

/// What is known of the rectangle before there is a receiver: unit vectors along its edges and across them, and the edges' lengths.
struct RectangleAxes {
    Vec3 x, y, n;
    float width, height;
};
/// The edges are at right angles to each other.
RectangleAxes rectangle_axes(Vec3 edge_x, Vec3 edge_y);

/// Neither finding the solid angle nor drawing branches, so that lanes may do it.
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

namespace detail {

inline double distance(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }
/// A product of three coordinates' differences; floats convert exactly.
inline double dot_in_double(Vec3 a, Vec3 b) {
    return static_cast<double>(a.x) * static_cast<double>(b.x) +
           static_cast<double>(a.y) * static_cast<double>(b.y) +
           static_cast<double>(a.z) * static_cast<double>(b.z);
}
inline float unit_interval(double x) {
    float const f = static_cast<float>(x);
    return f > 0.0f ? (f < 1.0f ? f : 1.0f) : 0.0f;
}

/// Of [x0, x1] x [y0, y1] at the distance z, r the distances of its corners. Two triangles, each by tan(angle / 2) = V / D (Van
/// Oosterom and Strackee 1983). V, six times the volume, is the same for both and has no cancellation, however small it is. The
/// half-angles are added as complex numbers, (D1 + iV)(D2 + iV), so that there is one arc tangent.
inline double rectangle_solid_angle(double x0, double x1, double y0, double y1, double z, double r00,
                                    double r10, double r01, double r11) {
    double const zz = z * z;
    double const v = (x1 - x0) * (y1 - y0) * z;
    double const xx = x0 * x1 + zz;
    double const yy = y0 * y1;
    double const across = xx + yy;  // (x0, y0, z) . (x1, y1, z)
    double const d1 = r00 * r10 * r11 + (xx + y0 * y0) * r11 + (x1 * x1 + yy + zz) * r00 + across * r10;
    double const d2 = r00 * r01 * r11 + across * r01 + (xx + y1 * y1) * r00 + (x0 * x0 + yy + zz) * r11;
    double const im = v * (d1 + d2);
    return 2 * upper_angle(im > 0 ? im : 0, d1 * d2 - v * v);
}

}  // namespace detail

inline SphericalRectangle::SphericalRectangle(RectangleAxes const& axes, Vec3 corner) {
    x0_ = detail::dot_in_double(corner, axes.x);
    y0_ = detail::dot_in_double(corner, axes.y);
    z_ = std::abs(detail::dot_in_double(corner, axes.n));
    x1_ = x0_ + static_cast<double>(axes.width);
    y1_ = y0_ + static_cast<double>(axes.height);
    r00_ = detail::distance(x0_, y0_, z_);
    r01_ = detail::distance(x0_, y1_, z_);
    solid_angle_ =
        z_ > 0 ? detail::rectangle_solid_angle(x0_, x1_, y0_, y1_, z_, r00_, detail::distance(x1_, y0_, z_),
                                               r01_, detail::distance(x1_, y1_, z_))
               : 0;
}

inline Vec2 SphericalRectangle::sample(Vec2 u) const {
    // The strip [x0, x] x [y0, y1] has the solid angle T(x) - T(x0) with T(x) = asin(q p1) - asin(q p0), q = x / |(x, z)|,
    // p_j = y_j / |(y_j, z)|. Let M = |(y0, z)| |(y1, z)|. Then M e^{iT(x)} is algebraic in x, here Re + i Im at x0; turning it
    // by the angle u S makes C + i Sg, and solving that for x gives x^2 / z^2 = Sg^2 / ((C - y0 y1)^2 - z^4). What is small where
    // the rectangle is far, narrow or at a grazing angle is written as a quotient instead of a difference.
    double const zz = z_ * z_;
    double const xx0 = x0_ * x0_ + zz;
    double const yy = y0_ * y1_;
    double const rr = r00_ * r01_;
    double const height = y1_ - y0_;
    double const re = (zz * rr + x0_ * x0_ * yy) / xx0;
    double const im =
        x0_ * z_ *
        (yy > 0 ? height * (y1_ + y0_) / (y1_ * r00_ + y0_ * r01_) : (y1_ * r00_ - y0_ * r01_) / xx0);
    double const sum = xx0 + yy;
    // Re - y0 y1 - z^2 = z^2 (r00 r01 - y0 y1 - xx0) / xx0
    double const h0 = zz * (sum > 0 ? height * height / (rr + sum) : (rr - sum) / xx0);
    SinCos const half = sin_cos_half_turn(0.5 * static_cast<double>(u.x) * solid_angle_);
    double const sine = 2 * half.sin * half.cos;
    double const versine = 2 * half.sin * half.sin;  // 1 - cosine
    double const h = h0 - re * versine - im * sine;
    double const sg = im - im * versine + re * sine;
    double const square = h * (h + 2 * zz);
    double x = square > 0 ? z_ * sg / std::sqrt(square) : (sg > 0 ? x1_ : x0_);
    x = x < x1_ ? x : x1_;
    x = x > x0_ ? x : x0_;
    // Along y the sine of the elevation over the plane y = 0 is uniform between its ends.
    double const dd = x * x + zz;
    double const e0 = y0_ / std::sqrt(dd + y0_ * y0_);
    double const e1 = y1_ / std::sqrt(dd + y1_ * y1_);
    double const e = e0 + static_cast<double>(u.y) * (e1 - e0);
    double const rest = (1 - e) * (1 + e);
    double const y = rest > 0 ? e * std::sqrt(dd / rest) : (e > 0 ? y1_ : y0_);
    return {detail::unit_interval((x - x0_) / (x1_ - x0_)), detail::unit_interval((y - y0_) / height)};
}

}  // namespace nephroid
