// A rectangle in a wall that the light of an environment comes through (Bitterli, Novak, Jarosz 2015; PBRT 4th ed., 12.5.3).
// Internal to model.
//
// Directions into the half space behind the portal are a square: the angles that they make with its normal along its two
// sides. Seen from any point, the portal is a rectangle of that square, so that one table of the sky serves all receivers.
// In double: from far away the rectangle is small.
#pragma once

#include "math/vec.h"
#include "sampling/windowed_distribution.h"

#include <array>
#include <functional>
#include <optional>

namespace nephroid {

struct Portal {
    using Vec = std::array<double, 3>;

    Vec corner{};       // world
    Vec x{}, y{}, z{};  // unit: along the sides corners 0 -> 3 and 0 -> 1, and x cross y, towards the light
    double width = 0, height = 0;       // along x and y
    WindowedDistribution distribution;  // radiance times solid angle over the square
    double flux = 0;                    // integral of radiance * cos over area and solid angle

    [[nodiscard]] double area() const { return width * height; }
};

/// Corners in order around it. Nothing unless they are a rectangle: opposite sides within pbrt-v4's tolerance of 0.001 (in
/// cosine) parallel, neighbours as close to perpendicular, and an area.
std::optional<Portal> make_portal(std::array<Vec3, 4> const& corners);
/// Makes the table, of n x n cells, each of `points` x `points` values of the radiance along a direction of the world. Where
/// any is above 0, no direction has density 0.
void tabulate(Portal& portal, int n, int points, std::function<double(Vec3)> const& radiance);

/// Where in the square a direction is.
struct PortalDirection {
    double u = 0, v = 0;
    double cosine = 0;       // with the normal
    double solid_angle = 0;  // d(solid angle) / d(square)
};
/// Nothing for directions along the wall or away from the light.
std::optional<PortalDirection> portal_direction(Portal const& portal, Vec3 w);
Vec3 direction_through(Portal const& portal, double u, double v);
/// The part of the square that p sees through the portal. Nothing for what is in the wall's plane or beyond it.
std::optional<SquareWindow> portal_window(Portal const& portal, Vec3 p);
inline bool is_inside(SquareWindow const& w, PortalDirection const& d) {
    return d.u >= w.x0 && d.u <= w.x1 && d.v >= w.y0 && d.v <= w.y1;
}
/// A point of the rectangle, u in [0,1]^2.
Vec3 point_of(Portal const& portal, Vec2 u);
/// Does the line through p along w, which portal_direction knows, pass the rectangle?
bool passes(Portal const& portal, Vec3 p, Vec3 w);

}  // namespace nephroid
