// Flat emitters as a receiver sees them: uniform over the solid angle of a triangle, a rectangle or a parallelogram.
#pragma once

#include "light_table.h"

namespace nephroid {

/// How a flat emitter is worth sampling from a receiver (docs/decisions/0005): by solid angle where it is large or much of it lies
/// along the line of sight; by area, with a density that is bilinear between what its corners send, where that is little; and by area
/// alone where it is next to nothing.
enum class FlatView : std::uint8_t { Near, Between, Far };
inline FlatView view_of(LightEntry const& e, Receiver const& to) {
    Vec3 const v = e.centroid - to.p;
    float const d2 = dot(v, v);
    float const along = abs_dot(e.edge1, v) + abs_dot(e.edge2, v);
    if (!(e.size2 > 0.3f * d2 || along > 0.35f * d2)) return FlatView::Far;
    return e.size2 > d2 || along > 0.5f * d2 ? FlatView::Near : FlatView::Between;
}

/// (s, t) of a point of the plane: corner + s edge1 + t edge2.
Vec2 coordinates(LightEntry const& e, Vec3 p);

/// Draws (s, t); false where the emitter is seen from its own plane. pdf by solid angle.
bool sample_near_flat(LightEntry const& e, Receiver const& to, Vec2 u, Vec2& st, float& pdf);
/// The density with which it draws p.
float near_flat_pdf(LightEntry const& e, Receiver const& to, Vec3 p);

/// The square that the area sampler wants, bent towards the corners that send most; `pdf` over the square.
Vec2 bend_square(LightEntry const& e, Receiver const& to, Vec2 u, float& pdf);
float bent_square_pdf(LightEntry const& e, Receiver const& to, Vec2 square);

/// A parallelogram, its corner relative to the receiver: steradians, and (s, t) uniform over them.
float seen_solid_angle(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled);
Vec2 sample_seen(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled, Vec2 u);

}  // namespace nephroid
