// Spheres, disks and cylinders as a receiver sees them: points drawn by solid angle, in the shape's own space. A caller whose shape
// is placed by a map takes the receiver into this space and multiplies the density by the map's Jacobian of directions.
//
// seen(shape, from, sides) is made once for a receiver. It is nothing where the caller does better by area (far disks), where that
// is the only way (shapes that are cut), where the receiver is on the shape, and where it cannot see an emitting side at all.
#pragma once

#include "math/frame.h"
#include "sampling/tabulated.h"
#include "scene/shape.h"

#include <cstdint>
#include <optional>

namespace nephroid {

/// Which sides emit, relative to the shape's own normal.
enum class EmittingSides : std::uint8_t { Front, Back, Both };

/// A point drawn on a surface that a receiver sees.
struct SeenSample {
    Vec3 p{0, 0, 0};
    Vec3 p_error{0, 0, 0};  // |computed - exact| per coordinate, at most
    Vec3 n{0, 0, 1};  // the shape's own normal, outwards for spheres and cylinders, whichever side is seen
    Vec2 uv{0, 0};
    float pdf = 0;  // by solid angle at the receiver
};

// Each of them has:
//   sample(u, s)   fills `s`; false where u leads to nothing
//   pdf(p)         the density of directions at a point of the surface; 0 where it is never drawn
//   invert(p)      the u that sample() makes p of

/// Closer than this, in radii, a receiver may be a rounded point of the surface.
inline constexpr double kOnSurface = 1e-5;

/// From outside, the cone around the sphere, uniformly (Shirley, Wang and Zimmerman 1996); from inside, all directions.
class SphereSeen {
  public:
    SphereSeen(float radius, Vec3 from);
    bool sample(Vec2 u, SeenSample& s) const;
    [[nodiscard]] float pdf(Vec3 p) const;
    [[nodiscard]] std::optional<Vec2> invert(Vec3 p) const;

  private:
    [[nodiscard]] bool faces(Vec3 local) const;

    Frame frame_;  // z towards the receiver
    Vec3 from_;
    float pdf_;
    bool inside_;
    double r_, d_;          // radius, the receiver's distance from the centre
    double square_;         // (d - r)(d + r)
    double one_minus_cos_;  // of the cone's half-angle
};
std::optional<SphereSeen> seen(Sphere const& shape, Vec3 from, EmittingSides sides);

/// A disk is seen as a spherical ellipse (Guillen et al. 2017, "Area-Preserving Parameterizations for Spherical Ellipses"). Its
/// sectors about the ellipse's centre are drawn by a tabulated density, exact to a hundredth, and the cosine within a sector
/// uniformly.
class DiskSeen {
  public:
    DiskSeen(Disk const& shape, Vec3 from);
    bool sample(Vec2 u, SeenSample& s) const;
    [[nodiscard]] float pdf(Vec3 p) const;
    [[nodiscard]] std::optional<Vec2> invert(Vec3 p) const;

  private:
    static constexpr int kNodes = 8;  // cells a quarter turn
    struct Place;
    [[nodiscard]] Place place(Vec3 p) const;
    [[nodiscard]] double pdf_at(float quarter, double cos_edge) const;

    float height_, radius_;
    double h_, rho_;        // the receiver's distances from the disk's plane and axis
    double side_;           // +1 where the receiver is on the normal's side
    double ex_, ey_;        // unit vector in the plane from the receiver's foot to the disk's centre
    double zx_, zh_;        // the cone's axis: along (ex, ey) and towards the plane
    double sin_a_, sin_b_;  // the ellipse's half-axes, in the plane of both axes and across it
    double cos2_a_, cos2_b_;
    TabulatedDensity<kNodes> quarter_;
};
/// Nothing from twenty radii on: docs/decisions/0005-disks-by-solid-angle.md.
std::optional<DiskSeen> seen(Disk const& shape, Vec3 from, EmittingSides sides);

/// An open tube. Along z the density is exact given the azimuth; the azimuth's own is tabulated. Of the far wall, seen through the
/// ends from outside, what the near wall hides is left out.
class CylinderSeen {
  public:
    CylinderSeen(Cylinder const& shape, Vec3 from, EmittingSides sides);
    bool sample(Vec2 u, SeenSample& s) const;
    [[nodiscard]] float pdf(Vec3 p) const;
    [[nodiscard]] std::optional<Vec2> invert(Vec3 p) const;
    /// Can nothing be drawn?
    [[nodiscard]] bool empty() const { return !(share_[0] + share_[1] > 0); }

  private:
    static constexpr int kNodes = 12;  // cells on either side of the plane through the axis and the receiver
    enum class Wall : std::uint8_t { Near, Far, Around };
    struct Column;
    struct Place;
    template <Wall kWall>
    [[nodiscard]] Column column(double sine, double cosine) const;
    [[nodiscard]] Column column(Wall wall, double sine, double cosine) const;
    [[nodiscard]] Place place(Vec3 p) const;
    template <Wall kWall>
    double tabulate(std::size_t piece);
    [[nodiscard]] double pdf_at(std::size_t piece, float x, Column const& c) const;

    float radius_, z_min_, z_max_, from_z_;
    double r_, rho_, square_;  // radius, the receiver's distance from the axis, |rho^2 - r^2|
    double lo_, hi_;           // the tube's ends, relative to the receiver's z
    double ex_, ey_;           // unit vector from the axis towards the receiver
    Wall wall_[2] = {Wall::Near, Wall::Far};
    double share_[2] = {0, 0};
    TabulatedDensity<kNodes> table_[2];
};
std::optional<CylinderSeen> seen(Cylinder const& shape, Vec3 from, EmittingSides sides);

}  // namespace nephroid
