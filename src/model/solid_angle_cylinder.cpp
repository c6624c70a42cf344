// An open cylinder as a receiver sees it.
#include "model/solid_angle.h"
#include "sampling/arc.h"

namespace nephroid {

namespace {

/// Sines and cosines of i / N quarter turns (`around`: half turns), made by the compiler from the series.
template <std::size_t N>
struct Turns {
    std::array<double, N + 1> sine{}, cosine{};
    constexpr explicit Turns(bool around) {
        for (std::size_t i = 0; i <= N; ++i) {
            double const s = small_sine(i);
            double const c = small_sine(N - i);
            sine[i] = around ? 2 * s * c : s;
            cosine[i] = around ? (c - s) * (c + s) : c;
        }
    }
    static constexpr double small_sine(std::size_t i) {
        double const x = kPiDouble / 2 * static_cast<double>(i) / N;
        double term = x;
        double sum = x;
        for (int k = 1; k <= 12; ++k) sum += term *= -x * x / ((2 * k) * (2 * k + 1));
        return sum;
    }
};

/// What a node has at least of its neighbour's density.
constexpr float kLeast = 0.1f;

/// z / sqrt(d^2 + z^2) at hi less that at lo, lo <= hi: what a column at the distance d between these heights takes of the solid
/// angle over its azimuth. `level`: the receiver's own height is between them; else the difference would cancel, and is a quotient.
inline double column_height(double d, double lo, double hi, bool level) {
    double const dd = d * d;
    double const l_lo = std::sqrt(dd + lo * lo);
    double const l_hi = std::sqrt(dd + hi * hi);
    double const a = hi * l_lo;
    double const b = lo * l_hi;
    return (level ? a - b : dd * (hi - lo) * (hi + lo)) / (l_lo * l_hi * (level ? 1.0 : a + b));
}

}  // namespace

/// What is seen at one azimuth.
struct CylinderSeen::Column {
    double d;        // horizontal distance
    double lo, hi;   // heights between which the wall is seen, relative to the receiver
    double sines;    // column_height: the solid angle over the receiver's azimuth
    double azimuth;  // the receiver's azimuth over the table's angle
};

struct CylinderSeen::Place {
    std::size_t piece;  // 2: never drawn
    float x;
    bool negative;
    Column column;
};

std::optional<CylinderSeen> seen(Cylinder const& shape, Vec3 from, EmittingSides sides) {
    std::optional<CylinderSeen> r;
    if (shape.phi_max < kTwoPi) return r;
    // On the wall itself rounding says which side the receiver is on; by area what it sees of the inside is bounded.
    double const x = from.x;
    double const y = from.y;
    double const radius = shape.radius;
    double const off = std::sqrt(x * x + y * y) - radius;
    if (sides != EmittingSides::Front && std::abs(off) < kOnSurface * radius) return r;
    r.emplace(shape, from, sides);
    if (r->empty()) r.reset();
    return r;
}

// From outside, a ray at the azimuth psi from the axis's direction meets the walls under the angle t from their normals,
// rho sin psi = r sin t, at the horizontal distances rho cos psi -+ r cos t. With t instead of psi, or of the azimuth about the axis,
// the ends have no square roots, and a near wall no peak. From inside the receiver's azimuth itself does, counted from where the
// wall is nearest.
template <CylinderSeen::Wall kWall>
inline CylinderSeen::Column CylinderSeen::column(double sine, double cosine) const {
    Column c{0, lo_, hi_, 0, 1};
    if constexpr (kWall == Wall::Around) {
        double const root = std::sqrt(r_ * r_ - rho_ * rho_ * sine * sine);
        double const b = rho_ * cosine;
        c.d = (b > 0 ? square_ : root - b) / (b > 0 ? root + b : 1.0);  // selects, for a loop in vectors
    } else {
        double const rc = r_ * cosine;
        double const q = std::sqrt(rc * rc + square_);  // rho cos psi
        double const far = q + rc;
        c.azimuth = rc / q;
        c.d = kWall == Wall::Near ? square_ / far : far;
        if constexpr (kWall == Wall::Far) {  // over the near wall's edge
            double const ratio = far * far / square_;
            double const below = lo_ * ratio < hi_ ? lo_ * ratio : hi_;
            double const above = hi_ * ratio > lo_ ? hi_ * ratio : lo_;
            c.hi = lo_ > 0 ? below : hi_;
            c.lo = lo_ > 0 ? lo_ : above;
        }
    }
    c.sines = column_height(c.d, c.lo, c.hi, lo_ * hi_ <= 0);
    return c;
}

CylinderSeen::Column CylinderSeen::column(Wall wall, double sine, double cosine) const {
    switch (wall) {
        case Wall::Near:
            return column<Wall::Near>(sine, cosine);
        case Wall::Far:
            return column<Wall::Far>(sine, cosine);
        case Wall::Around:
            break;
    }
    return column<Wall::Around>(sine, cosine);
}

template <CylinderSeen::Wall kWall>
double CylinderSeen::tabulate(std::size_t piece) {
    constexpr bool kAround = kWall == Wall::Around;
    static constexpr Turns<kNodes> kTurns(kAround);
    wall_[piece] = kWall;
    std::array<double, kNodes + 1> values;
    for (std::size_t i = 0; i <= kNodes; ++i) {
        Column const c = column<kWall>(kTurns.sine[i], kTurns.cosine[i]);
        values[i] = c.sines * c.azimuth;
    }
    if constexpr (!kAround) {
        // The walls' edge itself is nothing wide. Close to the wall all that is seen may be close to that edge.
        double const width = std::sqrt(square_) / r_;
        Column const c = column<kWall>(1, width < 0.05 ? width : 0.05);
        values[kNodes] = c.sines * c.azimuth;
    }
    double greatest = 0;
    for (double const v : values) greatest = v > greatest ? v : greatest;
    if (!(greatest > 0)) return 0;
    std::array<float, kNodes + 1> exact;
    for (std::size_t i = 0; i <= kNodes; ++i) exact[i] = static_cast<float>(values[i] / greatest);
    // Between two nodes the density may stay with the higher one: the weight is bounded by what the lower one is given.
    std::array<float, kNodes + 1> nodes = exact;
    for (std::size_t i = 0; i < kNodes; ++i) {
        nodes[i] = max(nodes[i], kLeast * exact[i + 1]);
        nodes[i + 1] = max(nodes[i + 1], kLeast * exact[i]);
    }
    table_[piece] = TabulatedDensity<kNodes>(nodes);
    return static_cast<double>(table_[piece].integral()) * greatest;
}

CylinderSeen::CylinderSeen(Cylinder const& shape, Vec3 from, EmittingSides sides)
    : radius_(shape.radius),
      z_min_(min(shape.z_min, shape.z_max)),
      z_max_(max(shape.z_min, shape.z_max)),
      from_z_(from.z) {
    double const x = from.x;
    double const y = from.y;
    double const z = from.z;
    r_ = shape.radius;
    lo_ = static_cast<double>(z_min_) - z;
    hi_ = static_cast<double>(z_max_) - z;
    rho_ = std::sqrt(x * x + y * y);
    square_ = std::abs((rho_ - r_) * (rho_ + r_));
    ex_ = rho_ > 0 ? x / rho_ : 1;
    ey_ = rho_ > 0 ? y / rho_ : 0;
    if (!(square_ > 0) || !(hi_ > lo_)) return;
    if (rho_ < r_) {
        if (sides != EmittingSides::Front) share_[0] = tabulate<Wall::Around>(0) > 0 ? 1 : 0;
        return;
    }
    double const near = sides != EmittingSides::Back ? tabulate<Wall::Near>(0) : 0;
    // Between the heights of its ends the near wall hides the far one.
    double const far = sides != EmittingSides::Front && lo_ * hi_ > 0 ? tabulate<Wall::Far>(1) : 0;
    if (!(near + far > 0)) return;
    share_[0] = near / (near + far);
    share_[1] = far / (near + far);
}

double CylinderSeen::pdf_at(std::size_t piece, float x, Column const& c) const {
    double const range = wall_[piece] == Wall::Around ? 2 * kPiDouble : kPiDouble;  // of both sides
    double const density = c.sines * c.azimuth;
    return density > 0 ? share_[piece] * static_cast<double>(table_[piece].pdf(x)) / (range * density) : 0;
}

bool CylinderSeen::sample(Vec2 u, SeenSample& s) const {
    double const ux = u.x;
    std::size_t const piece = ux < share_[0] ? 0 : 1;
    double const within = piece == 0 ? ux / share_[0] : (ux - share_[0]) / share_[1];
    double const both = 2 * within - 1;  // from one end over the middle to the other
    float const x = table_[piece].sample(below_one(std::abs(both)));
    bool const around = wall_[piece] == Wall::Around;
    SinCos const a = sin_cos_half_turn((around ? kPiDouble : kPiDouble / 2) * static_cast<double>(x));
    Column const c = column(wall_[piece], a.sin, a.cos > 0 || around ? a.cos : 0);
    s.pdf = static_cast<float>(pdf_at(piece, x, c));
    if (!(s.pdf > 0.0f) || !std::isfinite(s.pdf)) return false;
    // The receiver's azimuth, and with it the point of the circle: x towards the receiver.
    double const sin_psi = around ? a.sin : r_ * a.sin / rho_;
    double const cos_psi = around ? a.cos : -std::sqrt(r_ * r_ * a.cos * a.cos + square_) / rho_;
    double const cx = rho_ + c.d * cos_psi;
    double const cy = both < 0 ? -c.d * sin_psi : c.d * sin_psi;
    s.n =
        normalize(Vec3{static_cast<float>(cx * ex_ - cy * ey_), static_cast<float>(cx * ey_ + cy * ex_), 0});
    // z / sqrt(d^2 + z^2) is uniform between its ends.
    double const start = c.lo / std::sqrt(c.d * c.d + c.lo * c.lo);
    double const e = start + static_cast<double>(u.y) * c.sines;
    double const rest = (1 - e) * (1 + e);
    double z = rest > 0 ? e * c.d / std::sqrt(rest) : (e > 0 ? c.hi : c.lo);
    z = z < c.hi ? z : c.hi;
    z = z > c.lo ? z : c.lo;
    s.p = {radius_ * s.n.x, radius_ * s.n.y,
           clamp(static_cast<float>(z + static_cast<double>(from_z_)), z_min_, z_max_)};
    s.p_error = gamma_bound(3) * abs(Vec3{s.p.x, s.p.y, 0});
    s.uv = {static_cast<float>(turns_of(static_cast<double>(s.n.y), static_cast<double>(s.n.x))),
            (s.p.z - z_min_) / (z_max_ - z_min_)};
    return true;
}

CylinderSeen::Place CylinderSeen::place(Vec3 p) const {
    double const px = p.x;
    double const py = p.y;
    double const scale = r_ / std::sqrt(px * px + py * py);
    double const x = scale * (px * ex_ + py * ey_);
    double const y = scale * (py * ex_ - px * ey_);
    double const facing = rho_ * x - r_ * r_;  // r d cos t
    Place at{2, 0, y < 0, {}};
    if (rho_ < r_) {
        at.piece = 0;
    } else {
        at.piece = facing > 0 ? 0 : 1;
    }
    if (!(share_[at.piece] > 0)) {
        at.piece = 2;
        return at;
    }
    bool const around = wall_[at.piece] == Wall::Around;
    double const sine = around ? std::abs(y) : rho_ * std::abs(y);
    double const cosine = around ? x - rho_ : std::abs(facing);
    at.x = static_cast<float>(upper_angle(sine, cosine) / (around ? kPiDouble : kPiDouble / 2));
    double const inv = 1 / std::sqrt(sine * sine + cosine * cosine);
    at.column = column(wall_[at.piece], sine * inv, cosine * inv);
    // Hidden behind the near wall?
    double const z = static_cast<double>(p.z) - static_cast<double>(from_z_);
    double const slack = 1e-6 * (hi_ - lo_);
    if (z < at.column.lo - slack || z > at.column.hi + slack) at.piece = 2;
    return at;
}

float CylinderSeen::pdf(Vec3 p) const {
    Place const at = place(p);
    return at.piece < 2 ? static_cast<float>(pdf_at(at.piece, at.x, at.column)) : 0.0f;
}

std::optional<Vec2> CylinderSeen::invert(Vec3 p) const {
    std::optional<Vec2> u;
    Place const at = place(p);
    if (at.piece == 2) return u;
    double const side = table_[at.piece].invert(at.x);
    double const within = 0.5 + (at.negative ? -0.5 : 0.5) * side;
    Column const& c = at.column;
    double const z = static_cast<double>(p.z) - static_cast<double>(from_z_);
    double const e = z / std::sqrt(c.d * c.d + z * z) - c.lo / std::sqrt(c.d * c.d + c.lo * c.lo);
    u.emplace(below_one(at.piece == 0 ? within * share_[0] : share_[0] + within * share_[1]),
              below_one(e / c.sines));
    return u;
}

}  // namespace nephroid
