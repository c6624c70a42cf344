// Flat emitters as a receiver sees them: uniform over the solid angle of a triangle, a rectangle or a parallelogram.
#pragma once

#include "light_table.h"

namespace nephroid {

/// Whether solid angle is worth its price there: the emitter is large as seen from the receiver, or one end of it is that much
/// farther away than the other (docs/decisions/0005).
inline bool is_near(LightEntry const& e, Receiver const& to) {
    constexpr float kLarge = 1;       // squared diagonal over squared distance
    constexpr float kUneven = 0.5f;  // extent along the line of sight, over the distance
    float const part = e.shape == LightShape::Triangle ? 1.0f / 3.0f : 0.5f;
    Vec3 const v = e.corner + part * (e.edge1 + e.edge2) - to.p;
    float const d2 = dot(v, v);
    return e.size2 > kLarge * d2 || abs_dot(e.edge1, v) + abs_dot(e.edge2, v) > kUneven * d2;
}

/// (s, t) of a point of the plane: corner + s edge1 + t edge2.
Vec2 coordinates(LightEntry const& e, Vec3 p);

/// Draws (s, t); false where the emitter is seen from its own plane. pdf by solid angle.
bool sample_seen_flat(LightEntry const& e, Receiver const& to, Vec2 u, Vec2& st, float& pdf);
/// The density with which it draws p.
float seen_flat_pdf(LightEntry const& e, Receiver const& to, Vec3 p);

/// A parallelogram, its corner relative to the receiver: steradians, and (s, t) uniform over them.
float seen_solid_angle(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled);
Vec2 sample_seen(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled, Vec2 u);

}  // namespace nephroid
