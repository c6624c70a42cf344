// Flat emitters as a receiver sees them: uniform over the solid angle of a triangle, a rectangle or a parallelogram.
#pragma once

#include "light_table.h"
#include "sampling/warp.h"

#include <array>

namespace nephroid {

/// How a flat emitter is worth sampling from a receiver (docs/decisions/0005): by solid angle where it is large or much of it lies
/// along the line of sight; by area, with a density that is bilinear between what its corners send, where that is little; and by area
/// alone where it is next to nothing.
enum class FlatView : std::uint32_t { Near, Between, Far };
inline FlatView view_of(LightEntry const& e, Receiver const& to) {
    Vec3 const v = e.centroid - to.p;
    float const d2 = dot(v, v);
    float const along = abs_dot(e.edge1, v) + abs_dot(e.edge2, v);
    bool const near = (e.size2 > d2) | (along > 0.5f * d2);
    bool const between = (e.size2 > 0.3f * d2) | (along > 0.35f * d2);
    return near ? FlatView::Near : between ? FlatView::Between : FlatView::Far;
}

/// Where a number of the square is by area, in (s, t), and the point there. Without a branch, so that lanes may use it.
inline Vec2 area_coordinates(LightEntry const& e, Vec2 square) {
    Vec2 const half = square_to_triangle(square);
    bool const triangle = e.shape == LightShape::Triangle;
    return {triangle ? half.x : square.x, triangle ? half.y : square.y};
}
inline Vec3 flat_point(LightEntry const& e, Vec2 st) { return e.corner + st.x * e.edge1 + st.y * e.edge2; }
inline Vec3 area_point(LightEntry const& e, Vec2 square) {
    return flat_point(e, area_coordinates(e, square));
}

/// (s, t) of a point of the plane: corner + s edge1 + t edge2.
Vec2 coordinates(LightEntry const& e, Vec3 p);

/// The square that a map by solid angle wants, bent by the receiver's cosine; pdf over the square. Without a branch, so that lanes may
/// use it. `corners` as cosine_weights wants them.
struct BentByCosine {
    Vec2 u;
    float pdf;

    BentByCosine(std::array<Vec3, 4> const& corners, Receiver const& to, Vec2 square) {
        auto const weights = cosine_weights(corners, to.n, to.both_sides);
        Vec2 const bent = sample_bilinear(square, weights.data());
        float const bent_pdf = bilinear_pdf(bent, weights.data());
        bool const anywhere = (to.n.x == 0.0f) & (to.n.y == 0.0f) & (to.n.z == 0.0f);
        u = {anywhere ? square.x : bent.x, anywhere ? square.y : bent.y};
        pdf = anywhere ? 1.0f : bent_pdf;
    }
};
/// Of a rectangle or a parallelogram, its corner relative to the receiver.
inline std::array<Vec3, 4> square_corners(LightEntry const& e, Vec3 corner) {
    Vec3 const b = corner + e.edge1;
    return {corner, b, corner + e.edge2, b + e.edge2};
}

/// Draws (s, t); false where the emitter is seen from its own plane. pdf by solid angle.
bool sample_near_flat(LightEntry const& e, Receiver const& to, Vec2 u, Vec2& st, float& pdf);
/// The density with which it draws p.
float near_flat_pdf(LightEntry const& e, Receiver const& to, Vec3 p);

/// What corners of the square send to the receiver, (n . v)(n_light . v) / r^4; the height over the light's plane is the same for all. F:
/// a float, or a vector of them for several corners.
template <class F>
struct SeenCorner {
    F r2, cosine;

    SeenCorner(LightEntry const& e, Receiver const& to, F s, F t) {
        Vec3 const c = e.corner - to.p;
        F const x = c.x + s * e.edge1.x + t * e.edge2.x;
        F const y = c.y + s * e.edge1.y + t * e.edge2.y;
        F const z = c.z + s * e.edge1.z + t * e.edge2.z;
        r2 = x * x + y * y + z * z;
        cosine = x * to.n.x + y * to.n.y + z * to.n.z;
        F const behind = to.both_sides ? -cosine : cosine * 0.0f;
        cosine = cosine < 0.0f ? behind : cosine;
    }
    /// `unit`: 1 / the squared distance of the first corner. The fourth powers of distances would leave the range of floats.
    [[nodiscard]] F weight(Receiver const& to, float unit) const {
        F const q = r2 * unit;
        F const w = 1.0f / (q * q);
        return (to.n.x != 0.0f) | (to.n.y != 0.0f) | (to.n.z != 0.0f) ? w * cosine : w;
    }
};
/// Of the triangle's square the corner (1,1) is the middle of the edge (sampling/warp.h, square_to_triangle).
inline float last_corner(LightEntry const& e) { return e.shape == LightShape::Triangle ? 0.5f : 1.0f; }
/// Bilinear weights; what rounding hides stays possible.
inline std::array<float, 4> with_floor(float a, float b, float c, float d) {
    float const least = 1e-3f * (a + b + c + d);
    return {a + least, b + least, c + least, d + least};
}

/// The square that the area sampler wants, bent towards the corners that send most; `pdf` over the square.
Vec2 bend_square(LightEntry const& e, Receiver const& to, Vec2 u, float& pdf);
float bent_square_pdf(LightEntry const& e, Receiver const& to, Vec2 square);

/// A parallelogram, its corner relative to the receiver: steradians, and (s, t) uniform over them.
float seen_solid_angle(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled);
Vec2 sample_seen(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled, Vec2 u);

}  // namespace nephroid
