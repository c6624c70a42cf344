#include "few_spheres.h"

#include "model/sphere_ray.h"
#include "ray_caster.h"

#include <algorithm>

namespace nephroid {

namespace {

/// As many as are surely worth it: of 16 it is a twentieth of the time, and beyond some 25 Embree's tree is faster
/// (docs/decisions/0012).
constexpr std::size_t kMostSpheres = 8;

Sphere const* takable(ObjectRecord const& record) {
    auto const* sphere = std::get_if<Sphere>(&record.object->shape);
    return sphere && is_whole(*sphere) && !record.object->alpha.valid() ? sphere : nullptr;
}

Ray3d in_double(Ray const& ray) { return {{ray.o.x, ray.o.y, ray.o.z}, {ray.d.x, ray.d.y, ray.d.z}}; }

/// The first root within (t_min, t_max), or infinity. Means something where the equation is solvable.
double first_root(SphereEquation const& e, double t_min, double t_max) {
    SphereRoots const roots(e);
    bool const near = !e.from_inside() & (roots.near > t_min) & (roots.near < t_max);
    bool const far = (roots.far > t_min) & (roots.far < t_max);
    double const t = near ? roots.near : roots.far;
    return near | far ? t : static_cast<double>(kInfinity);
}
/// Distances are compared as the floats that hits carry.
bool closer(double t, double than) { return static_cast<float>(t) < static_cast<float>(than); }

using Doubles = std::array<double, kLanes>;
struct EquationLanes {
    alignas(32) Doubles a, h, c, discriminant;
    alignas(32) std::array<std::uint64_t, kLanes> solvable;
};

void equations(RayPacket const& __restrict rays, std::array<std::array<double, 4>, 3> const& to_shape,
               double radius, EquationLanes& __restrict e) {
    auto const m = to_shape;
    for (std::size_t i = 0; i < kLanes; ++i) {
        SphereEquation const one(AnalyticPlace::in_shape(m, in_double(rays.ray(i))), radius);
        e.a[i] = one.a, e.h[i] = one.h, e.c[i] = one.c, e.discriminant[i] = one.discriminant;
        e.solvable[i] = one.solvable() ? 1 : 0;
    }
}

/// No vector of length 1 becomes longer by the linear part of a map: Gershgorin's bound on its square, which is that of the longest axis
/// where axes are scaled, then turned.
double longest(Mat4 const& m) {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            double product = 0;
            for (std::size_t k = 0; k < 3; ++k) product += m.m[k][i] * m.m[k][j];
            sum += std::abs(product);
        }
        most = std::max(most, sum);
    }
    return std::sqrt(most);
}

// Squares of less are not precise any more.
constexpr float kLeastSquare = 1e-30f;

}  // namespace

EnclosingBall::EnclosingBall(ObjectRecord const& record, float radius) {
    Mat4 const& m = record.object->to_group;
    centre = {static_cast<float>(m.m[0][3]), static_cast<float>(m.m[1][3]), static_cast<float>(m.m[2][3])};
    // The centre has been rounded.
    float const r = static_cast<float>(radius * longest(m) * (1 + 1e-6)) + 1e-6f * length(centre);
    if (r * r > kLeastSquare) radius2 = r * r;
}

inline bool EnclosingBall::misses(Vec3 o, Vec3 d) const {
    // By the distance of the ray, |v|^2 - (v . d)^2 / |d|^2; rounding is less than 20 times 2^-24 |v|^2. Nothing is missed by a NaN.
    constexpr float kLess = 1.0f - 4e-6f;
    Vec3 const v = centre - o;
    float const d2 = dot(d, d);
    float const along = max(dot(v, d), 0.0f);
    return (dot(v, v) * kLess - along * (along / d2) > radius2) & (d2 > kLeastSquare);
}

namespace {

/// Might any of the rays meet it?
bool may_be_met(EnclosingBall const& around, RayPacket const& __restrict rays, LaneMask lanes) {
    EnclosingBall const ball = around;
    std::array<std::uint32_t, kLanes> may;
    for (std::uint32_t i = 0; i < kLanes; ++i)
        may[i] = (ball.misses(rays.o[i], rays.d[i]) ? 0u : 1u) & lanes >> i;
    std::uint32_t any = 0;
    for (std::uint32_t const m : may) any |= m;
    return any != 0;
}

}  // namespace

void FewSpheres::take(std::span<ObjectRecord const> group) {
    std::vector<Place> all;
    for (std::size_t i = 0; i < group.size(); ++i) {
        ObjectRecord const& record = group[i];
        if (std::holds_alternative<TriangleMesh>(record.object->shape)) continue;
        Sphere const* sphere = takable(record);
        if (!sphere || all.size() == kMostSpheres) return;
        Place place{
            EnclosingBall(record, sphere->radius), {},     sphere->radius, RayCaster::seen(record.passage),
            static_cast<std::uint32_t>(i),         &record};
        for (std::size_t k = 0; k < 3; ++k) place.to_shape[k][k] = 1;
        if (record.place) place.to_shape = record.place->group_to_shape;
        all.push_back(place);
    }
    spheres_ = std::move(all);
}

bool FewSpheres::has(std::uint32_t geometry) const {
    return std::any_of(spheres_.begin(), spheres_.end(),
                       [&](Place const& s) { return s.geometry == geometry; });
}

SphereMet FewSpheres::nearest(Ray const& ray, double t_min, double t_max, std::uint32_t sees) const {
    SphereMet met;
    for (std::size_t k = 0; k < spheres_.size(); ++k) {
        Place const& sphere = spheres_[k];
        if (sphere.ball.misses(ray.o, ray.d) || (sphere.seen_by & sees) == 0) continue;
        SphereEquation const e(AnalyticPlace::in_shape(sphere.to_shape, in_double(ray)), sphere.radius);
        if (!e.solvable()) continue;
        double const t = first_root(e, t_min, t_max);
        if (closer(t, met.t)) met = {t, k};
    }
    return met;
}

void FewSpheres::nearest(RayPacket const& rays, LaneMask lanes, double t_min, std::uint32_t sees,
                         SphereMetLanes& met) const {
    met.t.fill(kInfinity);
    met.sphere.fill(0);
    for (std::size_t k = 0; k < spheres_.size(); ++k) {
        Place const& sphere = spheres_[k];
        if (!may_be_met(sphere.ball, rays, lanes) || (sphere.seen_by & sees) == 0) continue;
        EquationLanes e;
        equations(rays, sphere.to_shape, sphere.radius, e);
        if (std::none_of(e.solvable.begin(), e.solvable.end(), [](auto s) { return s != 0; })) continue;
        for (std::size_t i = 0; i < kLanes; ++i) {
            double const t = first_root({e.a[i], e.h[i], e.c[i], e.discriminant[i]}, t_min,
                                        static_cast<double>(rays.t_max[i]));
            bool const first = (e.solvable[i] != 0) & closer(t, met.t[i]);
            met.t[i] = first ? t : met.t[i];
            met.sphere[i] = first ? k : met.sphere[i];
        }
    }
}

void FewSpheres::complete(Ray const& ray, SphereMet const& met, RawHit& hit) const {
    Place const& sphere = spheres_[met.sphere];
    auto const p = detail::at(sphere.record->in_shape(in_double(ray)), met.t);
    hit.t = static_cast<float>(met.t);
    hit.u = hit.v = 0;
    for (int k = 0; k < 3; ++k) hit.local[k] = static_cast<float>(p[static_cast<std::size_t>(k)]);
    hit.geometry = sphere.geometry;
    hit.primitive = 0;
    hit.instance = kNoInstance;
    hit.found = true;
}

}  // namespace nephroid
