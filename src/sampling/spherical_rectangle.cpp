#include "sampling/spherical_rectangle.h"

#include "sampling/arc.h"

namespace nephroid {

RectangleAxes rectangle_axes(Vec3 edge_x, Vec3 edge_y) {
    float const width = length(edge_x);
    float const height = length(edge_y);
    Vec3 const x = edge_x / width;
    Vec3 const y = edge_y / height;
    return {x, y, cross(x, y), width, height};
}

Vec2 SphericalRectangle::invert(Vec2 st) const {
    double const x = x0_ + static_cast<double>(st.x) * (x1_ - x0_);
    double const y = y0_ + static_cast<double>(st.y) * (y1_ - y0_);
    double const r0 = detail::distance(x, y0_, z_);
    double const r1 = detail::distance(x, y1_, z_);
    double const strip = detail::rectangle_solid_angle(x0_, x, y0_, y1_, z_, r00_, r0, r01_, r1);
    double const e0 = y0_ / r0;
    return {below_one(strip / solid_angle_),
            below_one((y / detail::distance(x, y, z_) - e0) / (y1_ / r1 - e0))};
}

}  // namespace nephroid
