// A sphere as a receiver sees it.
#include "model/solid_angle.h"
#include "sampling/arc.h"
#include "sampling/warp.h"

namespace nephroid {

namespace {
double squared_length(Vec3 v) {
    double const x = v.x;
    double const y = v.y;
    double const z = v.z;
    return x * x + y * y + z * z;
}
}  // namespace

std::optional<SphereSeen> seen(Sphere const& shape, Vec3 from, EmittingSides sides) {
    std::optional<SphereSeen> r;
    bool const full = shape.z_min <= -shape.radius && shape.z_max >= shape.radius && shape.phi_max >= kTwoPi;
    if (!full) return r;
    double const radius = shape.radius;
    double const off = std::sqrt(squared_length(from)) - radius;
    // On the surface itself rounding says which side the receiver is on. By area its inside is seen without any noise from there:
    // the product of the cosines over the squared distance is the same everywhere.
    if (sides != EmittingSides::Front && std::abs(off) < kOnSurface * radius) return r;
    bool const visible = off > 0 ? sides != EmittingSides::Back : off < 0 && sides != EmittingSides::Front;
    if (visible) r.emplace(shape.radius, from);
    return r;
}

SphereSeen::SphereSeen(float radius, Vec3 from) : from_(from), r_(static_cast<double>(radius)) {
    d_ = std::sqrt(squared_length(from));
    inside_ = d_ < r_;
    square_ = (d_ - r_) * (d_ + r_);
    auto const inv = static_cast<float>(d_ > 0 ? 1 / d_ : 0);
    frame_ = frame_from_z(d_ > 0 ? from * inv : Vec3{0, 0, 1});
    // 1 - cos by the sine, which stays exact for small cones.
    double const sin2 = (r_ / d_) * (r_ / d_);
    one_minus_cos_ = inside_ ? 2 : sin2 / (1 + std::sqrt(square_) / d_);
    pdf_ = static_cast<float>(1 / (2 * kPiDouble * one_minus_cos_));
}

bool SphereSeen::sample(Vec2 u, SeenSample& s) const {
    if (inside_) {
        // |from + t w| = r, by the root that does not cancel.
        Vec3 const w = square_to_uniform_sphere(u);
        double const b = static_cast<double>(dot(w, from_));
        double const root = std::sqrt(b * b - square_);
        auto const t = static_cast<float>(b > 0 ? -square_ / (b + root) : root - b);
        s.n = normalize(from_ + t * w);
    } else {
        // The angle alpha at the centre of the point that the ray at the angle theta from the axis hits first: its sine by the
        // distance t along the ray, its cosine as a sum of positive terms, both exact where they are small.
        double const o = static_cast<double>(u.x) * one_minus_cos_;
        double const sin2 = o * (2 - o);
        double const cosine = 1 - o;
        double const rest = r_ * r_ - d_ * d_ * sin2;
        double const root = rest > 0 ? std::sqrt(rest) : 0;
        double const t = square_ / (d_ * cosine + root);
        double const sin_alpha = t * std::sqrt(sin2) / r_;
        double const cos_alpha = (sin2 * d_ + cosine * root) / r_;
        SinCos const phi = sin_cos_turns(static_cast<double>(u.y));
        s.n = normalize(
            frame_.from_local({static_cast<float>(sin_alpha * phi.cos),
                               static_cast<float>(sin_alpha * phi.sin), static_cast<float>(cos_alpha)}));
    }
    s.p = static_cast<float>(r_) * s.n;
    s.p_error = gamma_bound(5) * abs(s.p);
    double const x = s.n.x;
    double const y = s.n.y;
    double const theta = upper_angle(std::sqrt(x * x + y * y), static_cast<double>(s.n.z));
    s.uv = {static_cast<float>(turns_of(y, x)), static_cast<float>(1 - theta / kPiDouble)};
    s.pdf = pdf_;
    return true;
}

/// Is a point of the sphere seen from outside? The edge itself is, whatever rounding makes of it.
bool SphereSeen::faces(Vec3 p) const {
    return static_cast<double>(dot(p, frame_.z)) * d_ >= r_ * (r_ - 1e-6 * d_);
}

float SphereSeen::pdf(Vec3 p) const { return inside_ || faces(p) ? pdf_ : 0.0f; }

std::optional<Vec2> SphereSeen::invert(Vec3 p) const {
    std::optional<Vec2> u;
    if (inside_) {
        Vec3 const w = normalize(p - from_);
        u.emplace(below_one(0.5 - 0.5 * static_cast<double>(w.z)),
                  below_one(turns_of(static_cast<double>(w.y), static_cast<double>(w.x))));
        return u;
    }
    if (!faces(p)) return u;
    Vec3 const local = frame_.to_local(p);
    double const x = local.x;
    double const y = local.y;
    double const across = x * x + y * y;
    // Near the sphere the distance to its tip says little in floats: the height comes from the distance to the axis.
    double const z = across < 0.5 * r_ * r_ ? std::sqrt(r_ * r_ - across) : static_cast<double>(local.z);
    double const along = d_ - z;
    double const distance = std::sqrt(along * along + across);
    u.emplace(below_one(across / (distance * (distance + along)) / one_minus_cos_),
              below_one(turns_of(y, x)));
    return u;
}

}  // namespace nephroid
