// A disk as a receiver sees it: a spherical ellipse.
#include "model/solid_angle.h"
#include "sampling/arc.h"

namespace nephroid {

namespace {

/// The cosine of a constant within a quarter turn, by its series: for tables that are made by the compiler.
constexpr double constant_cosine(double x) {
    double term = 1;
    double sum = 1;
    for (int k = 1; k <= 12; ++k) sum += term *= -x * x / ((2 * k - 1) * (2 * k));
    return sum;
}
template <std::size_t N>
constexpr std::array<double, N> squared_cosines() {
    std::array<double, N> r{};
    for (std::size_t i = 0; i < N; ++i) {
        double const c = constant_cosine(kPiDouble / 2 * static_cast<double>(i) / (N - 1));
        r[i] = c * c;
    }
    return r;
}

}  // namespace

std::optional<DiskSeen> seen(Disk const& shape, Vec3 from, EmittingSides sides) {
    std::optional<DiskSeen> r;
    float const h = from.z - shape.height;
    bool const full = shape.inner_radius == 0.0f && shape.phi_max >= kTwoPi;
    bool const visible = h > 0.0f ? sides != EmittingSides::Back : h < 0.0f && sides != EmittingSides::Front;
    if (!full || !visible) return r;
    // From twenty radii on, points by area are as good: they add less than a hundredth to the variance (decision 5).
    double const x = from.x;
    double const y = from.y;
    double const z = h;
    double const radius = shape.radius;
    if (x * x + y * y + z * z > 400 * radius * radius) return r;
    r.emplace(shape, from);
    return r;
}

// In the plane through the disk's axis and the receiver the disk reaches from rho - R to rho + R, at the depth h. With l1, l2 the
// distances of these two points, m = rho^2 + h^2 - R^2 and G = l1 l2 + m, the cone around the disk is elliptic with
//   cos^2 a = G / (2 l1 l2), sin^2 a = 2 R^2 h^2 / (l1 l2 G)   its half-angle in that plane (half the angle between l1 and l2),
//   sin b = 2 R / (l1 + l2), cos^2 b = 2 G / (l1 + l2)^2       and across it (the chord through the foot of the bisector);
// the bisector meets the disk's plane at rho cos^2 b. As (l1 l2)^2 - m^2 = 4 R^2 h^2, G has a form without cancellation for m < 0.
//
// Seen along its axis the ellipse's edge is (sin a cos y, sin b sin y), at the angle theta from the axis with
// cos^2 theta = cos^2 a cos^2 y + cos^2 b sin^2 y. A sector dy has the solid angle sin a sin b / (1 + cos theta) dy: within a
// factor of two of a constant, and the same in all four quarters.
DiskSeen::DiskSeen(Disk const& shape, Vec3 from) : height_(shape.height), radius_(shape.radius) {
    double const radius = shape.radius;
    double const x = from.x;
    double const y = from.y;
    double const dz = static_cast<double>(from.z) - static_cast<double>(shape.height);
    side_ = dz < 0 ? -1 : 1;
    h_ = std::abs(dz);
    rho_ = std::sqrt(x * x + y * y);
    ex_ = rho_ > 0 ? -x / rho_ : 1;
    ey_ = rho_ > 0 ? -y / rho_ : 0;
    double const hh = h_ * h_;
    double const l1 = std::sqrt((rho_ - radius) * (rho_ - radius) + hh);
    double const l2 = std::sqrt((rho_ + radius) * (rho_ + radius) + hh);
    double const l12 = l1 * l2;
    double const m = (rho_ - radius) * (rho_ + radius) + hh;
    double const g = m >= 0 ? l12 + m : 4 * radius * radius * hh / (l12 - m);
    double const inv_sum = 1 / (l1 + l2);
    sin_a_ = radius * h_ * std::sqrt(2 / (l12 * g));
    cos2_a_ = 0.5 * g / l12;
    sin_b_ = 2 * radius * inv_sum;
    cos2_b_ = 2 * g * inv_sum * inv_sum;
    double const axis_x = rho_ * cos2_b_;
    double const inv_axis = 1 / std::sqrt(axis_x * axis_x + hh);
    zx_ = axis_x * inv_axis;
    zh_ = h_ * inv_axis;
    static constexpr auto kCos2 = squared_cosines<kNodes + 1>();
    std::array<float, kNodes + 1> nodes;
    for (std::size_t i = 0; i <= kNodes; ++i)
        nodes[i] = static_cast<float>(1 / (1 + std::sqrt(cos2_a_ * kCos2[i] + cos2_b_ * (1 - kCos2[i]))));
    quarter_ = TabulatedDensity<kNodes>(nodes);
}

/// `quarter`: the sector's y in quarter turns.
double DiskSeen::pdf_at(float quarter, double cos_edge) const {
    return static_cast<double>(quarter_.pdf(quarter)) * (1 + cos_edge) / (2 * kPiDouble * sin_a_ * sin_b_);
}

bool DiskSeen::sample(Vec2 u, SeenSample& s) const {
    // Quarters run forth and back, so that y goes on across their borders.
    float const four = 4.0f * u.x;
    int const q = static_cast<int>(four);
    float const within = four - static_cast<float>(q);
    float const quarter = quarter_.sample(q % 2 ? min(1.0f - within, kOneMinusEpsilon) : within);
    SinCos const sc = sin_cos_half_turn(kPiDouble / 2 * static_cast<double>(quarter));
    double const c = q == 1 || q == 2 ? -sc.cos : sc.cos;
    double const sn = q >= 2 ? -sc.sin : sc.sin;
    double const x_edge = sin_a_ * c;
    double const y_edge = sin_b_ * sn;
    double const sin2_edge = x_edge * x_edge + y_edge * y_edge;
    double const cos_edge = std::sqrt(cos2_a_ * c * c + cos2_b_ * sn * sn);
    double const o = static_cast<double>(u.y) * sin2_edge / (1 + cos_edge);  // 1 - cos
    double const shrink = std::sqrt(o * (2 - o) / sin2_edge);
    double const wx = x_edge * shrink;
    double const wz = 1 - o;
    // From the cone's axes to the disk's, and along the ray to its plane.
    double const down = wz * zh_ - wx * zx_;
    double const t = h_ / (down > 1e-12 ? down : 1e-12);
    double x = (wx * zh_ + wz * zx_) * t - rho_;
    double y = y_edge * shrink * t;
    double const rr = x * x + y * y;
    double const r = radius_;
    double const back = rr > r * r ? r / std::sqrt(rr) : 1;
    x *= back;
    y *= back;
    s.p = {static_cast<float>(x * ex_ - y * ey_), static_cast<float>(x * ey_ + y * ex_), height_};
    s.p_error = {0, 0, 0};
    s.n = {0, 0, 1};
    s.uv = {static_cast<float>(turns_of(static_cast<double>(s.p.y), static_cast<double>(s.p.x))),
            static_cast<float>(1 - back * std::sqrt(rr) / r)};
    s.pdf = static_cast<float>(pdf_at(quarter, cos_edge));
    return true;
}

struct DiskSeen::Place {
    float quarter;
    double x, y;  // signs of the quarter
    double cos_edge;
    double share;  // 1 - cos, as a share of the edge's
};

DiskSeen::Place DiskSeen::place(Vec3 p) const {
    double const px = p.x;
    double const py = p.y;
    double const x = rho_ + px * ex_ + py * ey_;
    double const y = py * ex_ - px * ey_;
    double const inv = 1 / std::sqrt(x * x + y * y + h_ * h_);
    double const wx = (x * zh_ - h_ * zx_) * inv;
    double const wz = (x * zx_ + h_ * zh_) * inv;
    double const wy = y * inv;
    double const c = wx / sin_a_;
    double const sn = wy / sin_b_;
    double const cc = c * c + sn * sn;
    double const c2 = cc > 0 ? c * c / cc : 1;
    double const cos_edge = std::sqrt(cos2_a_ * c2 + cos2_b_ * (1 - c2));
    double const sin2_edge = sin_a_ * sin_a_ * c2 + sin_b_ * sin_b_ * (1 - c2);
    double const one_minus_cos = (wx * wx + wy * wy) / (1 + (wz > 0 ? wz : 0));
    return {static_cast<float>(upper_angle(std::abs(sn), std::abs(c)) / (kPiDouble / 2)), c, sn, cos_edge,
            one_minus_cos * (1 + cos_edge) / sin2_edge};
}

float DiskSeen::pdf(Vec3 p) const {
    Place const at = place(p);
    return static_cast<float>(pdf_at(at.quarter, at.cos_edge));
}

std::optional<Vec2> DiskSeen::invert(Vec3 p) const {
    std::optional<Vec2> u;
    Place const at = place(p);
    double const within = quarter_.invert(at.quarter);
    double const four = at.y >= 0 ? (at.x >= 0 ? within : 2 - within) : (at.x < 0 ? 2 + within : 4 - within);
    u.emplace(below_one(0.25 * four), below_one(at.share));
    return u;
}

}  // namespace nephroid
