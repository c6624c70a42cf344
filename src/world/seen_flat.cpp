#include "seen_flat.h"

#include "sampling/spherical_rectangle.h"
#include "sampling/spherical_triangle.h"
#include "sampling/warp.h"
#include "spectrum/spectrum.h"

#include <array>

namespace nephroid {

namespace {

/// Without right angles: two triangles, chosen by solid angle.
struct TwoTriangles {
    SphericalTriangle first, second;  // at the corner, and at the one opposite
    float sum;

    TwoTriangles(Vec3 corner, Vec3 edge1, Vec3 edge2)
        : first(corner, corner + edge1, corner + edge2),
          second(corner + edge1 + edge2, corner + edge2, corner + edge1),
          sum(first.solid_angle() + second.solid_angle()) {}

    [[nodiscard]] Vec2 sample(Vec2 u) const {
        float const a = first.solid_angle();
        float const x = u.x * sum;
        if (x < a) return first.sample({min(x / a, kOneMinusEpsilon), u.y});
        Vec2 const bc = second.sample({min((x - a) / second.solid_angle(), kOneMinusEpsilon), u.y});
        return {1.0f - bc.x, 1.0f - bc.y};
    }
};

SphericalRectangle rectangle(Vec3 corner, Vec3 edge1, Vec3 edge2) {
    return SphericalRectangle(rectangle_axes(edge1, edge2), corner);
}
SphericalTriangle triangle(LightEntry const& e, Vec3 corner) {
    return SphericalTriangle(corner, corner + e.edge1, corner + e.edge2);
}

}  // namespace

Vec2 coordinates(LightEntry const& e, Vec3 p) {
    // By Cramer's rule in the plane.
    Vec3 const w = p - e.corner;
    float const area = dot(cross(e.edge1, e.edge2), e.normal);
    return {clamp(dot(cross(w, e.edge2), e.normal) / area, 0.0f, 1.0f),
            clamp(dot(cross(e.edge1, w), e.normal) / area, 0.0f, 1.0f)};
}

float seen_solid_angle(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled) {
    return right_angled ? rectangle(corner, edge1, edge2).solid_angle()
                        : TwoTriangles(corner, edge1, edge2).sum;
}
Vec2 sample_seen(Vec3 corner, Vec3 edge1, Vec3 edge2, bool right_angled, Vec2 u) {
    return right_angled ? rectangle(corner, edge1, edge2).sample(u)
                        : TwoTriangles(corner, edge1, edge2).sample(u);
}

namespace {

/// A map by solid angle with the receiver's cosine warped into its square; `corners` as cosine_weights wants them.
template <class Map>
bool sample_warped(Map const& map, std::array<Vec3, 4> const& corners, Receiver const& to, Vec2 u, Vec2& st,
                   float& pdf) {
    float const solid_angle = map.solid_angle();
    if (!(solid_angle > 0.0f)) return false;
    BentByCosine const bent(corners, to, u);
    pdf = 1.0f / solid_angle * bent.pdf;
    st = map.sample(bent.u);
    return true;
}
template <class Map>
float warped_pdf(Map const& map, std::array<Vec3, 4> const& corners, Receiver const& to, Vec2 st) {
    float const solid_angle = map.solid_angle();
    if (!(solid_angle > 0.0f)) return 0.0f;
    if (to.n == Vec3(0)) return 1.0f / solid_angle;
    auto const weights = cosine_weights(corners, to.n, to.both_sides);
    return bilinear_pdf(map.invert(st), weights.data()) / solid_angle;
}

/// Of the triangle's square one edge is the corner b.
std::array<Vec3, 4> triangle_corners(LightEntry const& e, Vec3 corner) {
    Vec3 const b = corner + e.edge1;
    return {b, b, corner, corner + e.edge2};
}

}  // namespace

bool sample_near_flat(LightEntry const& e, Receiver const& to, Vec2 u, Vec2& st, float& pdf) {
    Vec3 const corner = e.corner - to.p;
    switch (e.shape) {
        case LightShape::Rectangle:
            return sample_warped(rectangle(corner, e.edge1, e.edge2), square_corners(e, corner), to, u, st,
                                 pdf);
        case LightShape::Triangle:
            return sample_warped(triangle(e, corner), triangle_corners(e, corner), to, u, st, pdf);
        default: {
            TwoTriangles const t(corner, e.edge1, e.edge2);
            if (!(t.sum > 0.0f)) return false;
            pdf = 1.0f / t.sum;
            st = t.sample(u);
            return true;
        }
    }
}

float near_flat_pdf(LightEntry const& e, Receiver const& to, Vec3 p) {
    Vec3 const corner = e.corner - to.p;
    switch (e.shape) {
        case LightShape::Rectangle:
            return warped_pdf(rectangle(corner, e.edge1, e.edge2), square_corners(e, corner), to,
                              coordinates(e, p));
        case LightShape::Triangle:
            return warped_pdf(triangle(e, corner), triangle_corners(e, corner), to, coordinates(e, p));
        default: {
            float const sum = TwoTriangles(corner, e.edge1, e.edge2).sum;
            return sum > 0.0f ? 1.0f / sum : 0.0f;
        }
    }
}

namespace {

/// All four corners at once.
std::array<float, 4> corner_weights(LightEntry const& e, Receiver const& to) {
    using Lanes = Spectrum::Lanes;
    float const last = last_corner(e);
    SeenCorner<Lanes> const corners(e, to, Lanes{0, 1, 0, last}, Lanes{0, 0, 1, last});
    Lanes const w = corners.weight(to, 1.0f / corners.r2[0]);
    return with_floor(w[0], w[1], w[2], w[3]);
}

}  // namespace

Vec2 bend_square(LightEntry const& e, Receiver const& to, Vec2 u, float& pdf) {
    auto const weights = corner_weights(e, to);
    Vec2 const square = sample_bilinear(u, weights.data());
    pdf = bilinear_pdf(square, weights.data());
    return square;
}
float bent_square_pdf(LightEntry const& e, Receiver const& to, Vec2 square) {
    auto const weights = corner_weights(e, to);
    return bilinear_pdf(square, weights.data());
}

}  // namespace nephroid
