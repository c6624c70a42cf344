#include "sampling/spherical_triangle.h"

#include "sampling/arc.h"

#include <glm/ext/vector_double3.hpp>

namespace nephroid {

namespace {

using Vec3d = glm::dvec3;

double length_of(Vec3d v) { return std::sqrt(glm::dot(v, v)); }
/// a . (b x c) by the edges at a: exact to the last bits however small and far the triangle is.
double volume_of(Vec3d a, Vec3d b, Vec3d c) { return std::abs(glm::dot(a, glm::cross(b - a, c - a))); }

/// tan(angle / 2) = volume / D (Van Oosterom and Strackee 1983).
double solid_angle_of(double volume, double la, double lb, double lc, double ab, double bc, double ca) {
    return 2 * upper_angle(volume, la * lb * lc + ab * lc + bc * la + ca * lb);
}

/// On the arc between the directions of p and q, which includes the angle g, a point at the angle f from p, with
/// ratio = tan(f/2) / tan(g/2) = 1 - rest: the share t of q in p (1 - t) + q t, the point of the straight segment in that direction.
/// The weights of the unit vectors are sin(g - f) and sin f (slerp), and
/// sin f / sin(g - f) = ratio (1 + G^2) / ((1 - ratio)(1 + ratio G^2)), G = tan(g/2), G^2 = (lp lq - pq) / (lp lq + pq).
double share_on_segment(double ratio, double rest, double lp, double lq, double pq) {
    double const n = lp * lq;
    double const to_q = ratio * 2 * n * lp;
    double const to_p = rest * ((n + pq) + (n - pq) * ratio) * lq;
    double const sum = to_q + to_p;
    return sum > 0 ? to_q / sum : 0;
}

/// |p x q|^2 / (|p||q| (|p||q| + p.q)), which is 1 - cos of the angle between them, without cancellation for small angles.
double one_minus_cos(Vec3d p, Vec3d q) {
    double const n = length_of(p) * length_of(q);
    double const d = glm::dot(p, q);
    if (d < 0) return (n - d) / n;
    Vec3d const x = glm::cross(p, q - p);
    return glm::dot(x, x) / (n * (n + d));
}

}  // namespace

SphericalTriangle::SphericalTriangle(Vec3 a, Vec3 b, Vec3 c) : a_(a), b_(b), c_(c) {
    Vec3d const ad(a);
    Vec3d const bd(b);
    Vec3d const cd(c);
    la_ = length_of(ad);
    lb_ = length_of(bd);
    lc_ = length_of(cd);
    volume_ = volume_of(ad, bd, cd);
    solid_angle_ = volume_ > 0 ? solid_angle_of(volume_, la_, lb_, lc_, glm::dot(ad, bd), glm::dot(bd, cd),
                                                glm::dot(cd, ad))
                               : 0;
}

Vec2 SphericalTriangle::sample(Vec2 u) const {
    Vec3d const a(a_);
    Vec3d const b(b_);
    Vec3d const c(c_);
    // First a point c' on the edge from a to c, so that (a, b, c') has the share u.x of the solid angle. With unit vectors, k the
    // tangent of the arc at a and c' = a cos f + k sin f, Van Oosterom and Strackee's formula is linear in tan(f/2):
    // tan(angle / 2) = tan(f/2) a.(b x k) / (1 + a.b + tan(f/2) b.k). The ratio to tan(g/2), g the whole arc, needs no k.
    SinCos const half = sin_cos_half_turn(0.5 * static_cast<double>(u.x) * solid_angle_);
    double const ab = glm::dot(a, b);
    double const ac = glm::dot(a, c);
    double const top = half.sin * (la_ * lb_ + ab) * (la_ * lc_ + ac);
    double const bottom = half.cos * volume_ * la_ - half.sin * (glm::dot(b, c) * la_ * la_ - ab * ac);
    double ratio = bottom > top ? top / bottom : 1;
    ratio = ratio > 0 ? ratio : 0;
    double const t = share_on_segment(ratio, 1 - ratio, la_, lc_, ac);
    // Then a point on the arc from b to c': the cosine of its angle from b is uniform.
    Vec3d const p = a + t * (c - a);
    double const lp = length_of(p);
    double const bp = glm::dot(b, p);
    double const n = lb_ * lp;
    double const near = n + bp > 1e-18 * n ? n + bp : 1e-18 * n;
    double const v = u.y;
    double const w = 1 - v;
    double const denominator = near + w * (n - bp);
    double const ratio2 = std::sqrt(v * near / denominator);
    double const rest2 = w * 2 * n / (denominator * (1 + ratio2));  // 1 - ratio2^2 over 1 + ratio2
    double const s = share_on_segment(ratio2, rest2, lb_, lp, bp);
    float const b1 = static_cast<float>(1 - s);
    return {b1, min(static_cast<float>(s * t), 1.0f - b1)};
}

Vec2 SphericalTriangle::invert(Vec2 bc) const {
    Vec3d const a(a_);
    Vec3d const b(b_);
    Vec3d const c(c_);
    double const wb = bc.x > 0 ? bc.x : 0;
    double const wc = bc.y > 0 ? bc.y : 0;
    double const wa = 1 - wb - wc > 0 ? 1 - wb - wc : 0;
    double const t = wa + wc > 0 ? wc / (wa + wc) : 0;
    Vec3d const p = a + t * (c - a);
    double const part =
        solid_angle_of(volume_ * t, la_, lb_, length_of(p), glm::dot(a, b), glm::dot(b, p), glm::dot(p, a));
    double const whole = one_minus_cos(b, p);
    double const share = wa + wc < 1 ? wa + wc : 1;
    return {below_one(part / solid_angle_),
            whole > 0 ? below_one(one_minus_cos(b, b + share * (p - b)) / whole) : 0};
}

std::optional<Vec2> SphericalTriangle::invert(Vec3 w) const {
    std::optional<Vec2> r;
    Vec3d const a(a_);
    Vec3d const b(b_);
    Vec3d const c(c_);
    Vec3d const d(w);
    // w = wa a + wb b + wc c up to a factor, by Cramer's rule; the sign of the volume says which side it is seen from.
    double const side = glm::dot(a, glm::cross(b - a, c - a)) < 0 ? -1 : 1;
    double const wa = side * glm::dot(d, glm::cross(b, c - b));
    double const wb = side * glm::dot(d, glm::cross(c, a - c));
    double const wc = side * glm::dot(d, glm::cross(a, b - a));
    double const sum = wa + wb + wc;
    double const slack = -1e-6 * (std::abs(wa) + std::abs(wb) + std::abs(wc));
    if (!(sum > 0) || wa < slack || wb < slack || wc < slack) return r;
    r.emplace(invert(Vec2{static_cast<float>(wb / sum), static_cast<float>(wc / sum)}));
    return r;
}

}  // namespace nephroid
