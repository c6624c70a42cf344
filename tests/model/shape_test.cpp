// Shapes: areas, samples, normals, parametrisations, error bounds, and rays that do not hit what they leave.
#include "model/shape.h"

#include "math/ray.h"
#include "model/surface.h"
#include "support.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// The surface as an equation f = 0 in exact units of length near it, and what of it exists.
double off_surface(Sphere const& s, D3 p) { return std::sqrt(dot(p, p)) - static_cast<double>(s.radius); }
double off_surface(Cylinder const& s, D3 p) { return std::hypot(p.x, p.y) - static_cast<double>(s.radius); }
double off_surface(Disk const& s, D3 p) { return p.z - static_cast<double>(s.height); }
double off_surface(Box const& s, D3 p) {
    D3 const lo = to_d(s.lo), hi = to_d(s.hi);
    double best = 1e300;
    for (double const d : {p.x - lo.x, p.x - hi.x, p.y - lo.y, p.y - hi.y, p.z - lo.z, p.z - hi.z})
        if (std::abs(d) < std::abs(best)) best = d;
    return best;
}
double off_surface(Quad const& q, D3 p) {
    D3 const u = to_d(q.edge_u), v = to_d(q.edge_v), o = to_d(q.origin);
    D3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    return dot({p.x - o.x, p.y - o.y, p.z - o.z}, n) / std::sqrt(dot(n, n));
}

D3 outward(Sphere const&, D3 p) { return p; }
D3 outward(Cylinder const&, D3 p) { return {p.x, p.y, 0}; }
D3 outward(Disk const&, D3) { return {0, 0, 1}; }
D3 outward(Box const& s, D3 p) {
    D3 const lo = to_d(s.lo), hi = to_d(s.hi);
    double const d[6] = {std::abs(p.x - lo.x), std::abs(p.x - hi.x), std::abs(p.y - lo.y),
                         std::abs(p.y - hi.y), std::abs(p.z - lo.z), std::abs(p.z - hi.z)};
    auto const k = std::min_element(d, d + 6) - d;
    double const side = k % 2 ? 1 : -1;
    return {k / 2 == 0 ? side : 0, k / 2 == 1 ? side : 0, k / 2 == 2 ? side : 0};
}
D3 outward(Quad const& q, D3) {
    D3 const u = to_d(q.edge_u), v = to_d(q.edge_v);
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

Ray3d ray_of(Vec3 o, Vec3 d) {
    D3 const a = to_d(o), b = to_d(d);
    return {{a.x, a.y, a.z}, {b.x, b.y, b.z}};
}
Vec3 point_at(Ray3d const& r, double t) {
    return {static_cast<float>(r.o[0] + t * r.d[0]), static_cast<float>(r.o[1] + t * r.d[1]),
            static_cast<float>(r.o[2] + t * r.d[2])};
}

/// A ray from around the bounds to somewhere inside them.
Ray3d random_ray(Bounds3 const& b, Random& r) {
    Vec3 const c = b.centre(), d = b.diagonal() * 0.5f + Vec3{1e-3f};
    float const reach = length(d) * (r.below(3) ? 3.0f : 0.9f);
    Vec3 const o = c + random_direction(r) * reach;
    Vec3 const to = c + d * Vec3{2 * r.unit() - 1, 2 * r.unit() - 1, 2 * r.unit() - 1};
    return ray_of(o, to - o);
}

std::vector<Sphere> const kSpheres = {{1, -1, 1, kTwoPi},
                                      {2.5f, -2.5f, 2.5f, kTwoPi},
                                      {1, -0.4f, 0.7f, kTwoPi},
                                      {1.5f, -1.5f, 1.5f, 2},
                                      {2, 0, 2, 4.5f}};
std::vector<Cylinder> const kCylinders = {{1, -1, 1, kTwoPi}, {0.3f, 0, 4, kTwoPi}, {2, -1, 0.5f, 2.2f}};
std::vector<Disk> const kDisks = {{0, 1, 0, kTwoPi}, {2, 3, 1, kTwoPi}, {-1, 2, 0.5f, 4}};
std::vector<Box> const kBoxes = {{}, {{-1, 0, 2}, {0.5f, 3, 2.25f}}};
std::vector<Quad> const kQuads = {{}, {{1, 2, 3}, {0.5f, 1, 0}, {-1, 0.25f, 2}}};

template <class F>
void for_analytic(F const& f) {
    for (auto const& s : kSpheres) f(s);
    for (auto const& s : kCylinders) f(s);
    for (auto const& s : kDisks) f(s);
    for (auto const& s : kBoxes) f(s);
    for (auto const& s : kQuads) f(s);
}

double area(auto const& shape) {
    double a = 0;
    for (std::uint32_t k = 0; k < part_count(shape); ++k) a += static_cast<double>(part_area(shape, k));
    return a;
}
int analytic_count() {
    return static_cast<int>(kSpheres.size() + kCylinders.size() + kDisks.size() + kBoxes.size() +
                            kQuads.size());
}

/// u and v from a sample, as areas: maps the shape's uv to numbers that are uniform when samples are uniform by area.
Vec2 equal_area_uv(Sphere const& s, ShapeSample const& x) {
    float const lo = std::max(s.z_min, -s.radius), hi = std::min(s.z_max, s.radius);
    return {x.uv.x, (x.p.z - lo) / (hi - lo)};
}
Vec2 equal_area_uv(Cylinder const&, ShapeSample const& x) { return x.uv; }
Vec2 equal_area_uv(Disk const& s, ShapeSample const& x) {
    float const r2 = x.p.x * x.p.x + x.p.y * x.p.y;
    return {x.uv.x, (r2 - sqr(s.inner_radius)) / (sqr(s.radius) - sqr(s.inner_radius))};
}
Vec2 equal_area_uv(Box const&, ShapeSample const& x) { return x.uv; }
Vec2 equal_area_uv(Quad const&, ShapeSample const& x) { return x.uv; }

BilinearMesh planar_patch() {
    BilinearMesh m;
    m.p = {{0, 0, 1}, {2, 0, 1}, {0, 1, 1}, {3, 2, 1}};
    m.patches = {{0, 1, 2, 3}};
    return m;
}
BilinearMesh twisted_patch() {
    BilinearMesh m;
    m.p = {{-1, -1, 0.3f}, {1, -1, -0.4f}, {-1, 1, -0.5f}, {1.2f, 1, 0.6f}};
    m.patches = {{0, 1, 2, 3}};
    return m;
}

SurfacePoint surface_of(TriangleMesh const& m, std::uint32_t triangle, Vec2 b, bool flip, bool tangents) {
    SurfacePoint s;
    triangle_surface(m, triangle, b, flip, tangents, s);
    return s;
}

}  // namespace

TEST_CASE("areas by hand") {
    CHECK(area(Sphere{2, -2, 2, kTwoPi}) == doctest::Approx(16 * kPiD));
    CHECK(area(Sphere{2, 0, 2, kTwoPi}) == doctest::Approx(8 * kPiD));
    CHECK(area(Sphere{1, -0.5f, 0.5f, kPi}) == doctest::Approx(kPiD));
    CHECK(area(Cylinder{2, -1, 2, kTwoPi}) == doctest::Approx(12 * kPiD));
    CHECK(area(Disk{0, 3, 1, kTwoPi}) == doctest::Approx(8 * kPiD));
    CHECK(area(Disk{0, 2, 0, kPi}) == doctest::Approx(2 * kPiD));
    CHECK(area(Box{{0, 0, 0}, {1, 2, 3}}) == doctest::Approx(22));
    CHECK(area(Quad{{0, 0, 0}, {2, 0, 0}, {1, 3, 0}}) == doctest::Approx(6));
    CHECK(area(planar_patch()) == doctest::Approx(3.5));
}

TEST_CASE("samples lie on the surface, within its bounds, with outward normals, uniform by area") {
    double const alpha = sidak(analytic_count() * 2);
    for_analytic([&](auto const& shape) {
        Random r(1);
        Bounds3 const b = bounds(shape);
        int const n = samples(1'000'000, 4'000'000);
        for (std::uint32_t part = 0; part < part_count(shape); part += std::max(1u, part_count(shape) / 2)) {
            std::vector<double> o(20 * 20);
            for (int i = 0; i < n; ++i) {
                ShapeSample const s = sample(shape, part, random_square(r));
                D3 const p = to_d(s.p);
                D3 const w = outward(shape, p);
                double const bound = std::abs(static_cast<double>(s.n.x)) * s.p_error.x +
                                     std::abs(static_cast<double>(s.n.y)) * s.p_error.y +
                                     std::abs(static_cast<double>(s.n.z)) * s.p_error.z;
                REQUIRE(std::abs(off_surface(shape, p)) <= bound + 1e-12);
                REQUIRE(dot(w, to_d(s.n)) / std::sqrt(dot(w, w)) == doctest::Approx(1).epsilon(1e-6));
                REQUIRE(s.pdf_area == doctest::Approx(1 / static_cast<double>(part_area(shape, part))));
                // The sample's (u, v) is the surface's there, but for the seam where u jumps and the poles where it is none.
                if (i % 16 == 0 && s.uv.x > 1e-3f && s.uv.x < 0.999f && s.uv.y > 1e-3f && s.uv.y < 0.999f)
                    REQUIRE(length(Vec3(surface(shape, ShapeHit{0, s.uv.x, s.uv.y, part}, s.p).uv - s.uv,
                                        0.0f)) < 1e-3f);
                for (int k = 0; k < 3; ++k) REQUIRE((s.p[k] >= b.lo[k] - 1e-5f && s.p[k] <= b.hi[k] + 1e-5f));
                Vec2 const q = equal_area_uv(shape, s);
                REQUIRE((q.x > -1e-4f && q.x < 1.0001f && q.y > -1e-4f && q.y < 1.0001f));
                auto const cell = [](float x) { return std::clamp(static_cast<int>(x * 20), 0, 19); };
                ++o[static_cast<std::size_t>(cell(q.y) * 20 + cell(q.x))];
            }
            auto const c = chi_square(o, std::vector<double>(400, n / 400.0));
            INFO(c);
            CHECK(c.p >= alpha);
        }
        for (float const x : {0.0f, 0x1p-32f, 1 - 0x1p-24f})
            for (float const y : {0.0f, 0x1p-32f, 1 - 0x1p-24f}) {
                ShapeSample const s = sample(shape, 0, {x, y});
                CHECK(is_finite(s.p));
                CHECK(is_finite(s.n));
                CHECK(std::abs(length(s.n) - 1) < 1e-6f);
                CHECK((std::isfinite(s.uv.x) && std::isfinite(s.uv.y)));
                CHECK(s.pdf_area > 0);
            }
    });
}

TEST_CASE("areas agree with chords: random lines through a ball cross a surface A / (2 pi R^2) times") {
    // Cauchy-Crofton: lines that are uniform in a ball of radius R meet a surface of area A that often on average.
    double const alpha = sidak(analytic_count() + 2);
    auto const count = [&](auto const& shape, std::uint32_t prims) {
        Random r(2);
        Bounds3 const b = bounds(shape);
        BoundingSphere const ball = bounding_sphere(b);
        double const radius = static_cast<double>(ball.radius) * 1.001 + 1e-3;
        Mean crossings;
        int const n = samples(1'000'000, 4'000'000);
        for (int i = 0; i < n; ++i) {
            Vec3 const d = random_direction(r);
            Frame const f = frame_from_z(d);
            double const rho = radius * std::sqrt(r.uniform()), phi = r.uniform(0, 2 * kPiD);
            Vec3 const o = ball.centre + f.from_local({static_cast<float>(rho * std::cos(phi)),
                                                       static_cast<float>(rho * std::sin(phi)),
                                                       -2 * static_cast<float>(radius)});
            int hits = 0;
            for (std::uint32_t prim = 0; prim < prims; ++prim) {
                double t = 0;
                while (auto const hit = intersect(shape, prim, ray_of(o, d), t, 1e30)) {
                    ++hits;
                    t = hit->t * (1 + 1e-12);
                    REQUIRE(hits <= 4);
                }
            }
            crossings.add(hits);
        }
        auto const a = agrees(crossings, area(shape) / (2 * kPiD * radius * radius), 0.03, alpha);
        INFO(a);
        CHECK(a);
    };
    for_analytic([&](auto const& shape) { count(shape, 1); });
    count(planar_patch(), 1);
    count(twisted_patch(), 1);
}

TEST_CASE("hits are on the surface and within its cuts, and the nearest; misses agree with a fine march") {
    for_analytic([&](auto const& shape) {
        Random r(3);
        Bounds3 const b = bounds(shape);
        int found = 0;
        for (int i = 0; i < 20'000; ++i) {
            Ray3d const ray = random_ray(b, r);
            auto const hit = intersect(shape, 0, ray, 0, 1e30);
            if (!hit) continue;
            ++found;
            double const size = static_cast<double>(length(b.diagonal()));
            auto const at = [&](double t) {
                return D3{ray.o[0] + t * ray.d[0], ray.o[1] + t * ray.d[1], ray.o[2] + t * ray.d[2]};
            };
            REQUIRE(std::abs(off_surface(shape, at(hit->t))) < 1e-11 * (1 + size));
            Vec3 const p = point_at(ray, hit->t);
            for (int k = 0; k < 3; ++k) REQUIRE((p[k] >= b.lo[k] - 1e-4f && p[k] <= b.hi[k] + 1e-4f));
            // t_max and t_min cut.
            CHECK_FALSE(intersect(shape, 0, ray, 0, hit->t * (1 - 1e-9)));
            CHECK(intersect(shape, 0, ray, 0, hit->t * (1 + 1e-9)));
            if (auto const second = intersect(shape, 0, ray, hit->t * (1 + 1e-9), 1e30))
                CHECK(second->t > hit->t);
            // Scaling the direction scales t alone.
            Ray3d longer = ray;
            for (double& x : longer.d) x *= 4;
            auto const again = intersect(shape, 0, longer, 0, 1e30);
            REQUIRE(again);
            CHECK(again->t * 4 == doctest::Approx(hit->t).epsilon(1e-9));
        }
        CHECK(found > 500);
    });
    // Brute force for the whole sphere: step along the ray for the first change of sign.
    Random r(4);
    Sphere const sphere{1, -1, 1, kTwoPi};
    for (int i = 0; i < 300; ++i) {
        Ray3d const ray = random_ray(bounds(sphere), r);
        double first = -1;
        double before = 0;
        for (int k = 0; k <= 20'000 && first < 0; ++k) {
            double const t = k * 3.0 / 20'000;
            double const f = off_surface(
                sphere, {ray.o[0] + t * ray.d[0], ray.o[1] + t * ray.d[1], ray.o[2] + t * ray.d[2]});
            if (k > 0 && f * before < 0) first = t;
            before = f;
        }
        auto const hit = intersect(sphere, 0, ray, 0, 3);
        if (first > 0) {
            REQUIRE(hit);
            CHECK(std::abs(hit->t - first) < 3e-4);
        }
    }
}

TEST_CASE(
    "the surface at a hit: within its error bound, unit outward normal, uv and tangents by finite "
    "differences") {
    for_analytic([&](auto const& shape) {
        Random r(5);
        Bounds3 const b = bounds(shape);
        int checked = 0;
        for (int i = 0; i < 20'000; ++i) {
            Ray3d const ray = random_ray(b, r);
            auto const hit = intersect(shape, 0, ray, 0, 1e30);
            if (!hit) continue;
            Vec3 const p = point_at(ray, hit->t);
            SurfacePoint const s = surface(shape, *hit, p);
            double const bound = std::abs(static_cast<double>(s.ng.x)) * s.p_error.x +
                                 std::abs(static_cast<double>(s.ng.y)) * s.p_error.y +
                                 std::abs(static_cast<double>(s.ng.z)) * s.p_error.z;
            REQUIRE(std::abs(off_surface(shape, to_d(s.p))) <= bound + 1e-12);
            REQUIRE(length(s.p - p) < 1e-5f * (1 + length(p)));
            D3 const w = outward(shape, to_d(s.p));
            REQUIRE(dot(w, to_d(s.ng)) / std::sqrt(dot(w, w)) == doctest::Approx(1).epsilon(1e-6));
            REQUIRE(s.ns == s.ng);
            REQUIRE((s.uv.x >= -1e-4f && s.uv.x <= 1.0001f && s.uv.y >= -1e-4f && s.uv.y <= 1.0001f));
            // Tangents lie in the surface.
            float const lu = length(s.dpdu), lv = length(s.dpdv);
            REQUIRE(std::abs(nephroid::dot(s.dpdu, s.ng)) <= 1e-4f * (lu + 1e-6f));
            REQUIRE(std::abs(nephroid::dot(s.dpdv, s.ng)) <= 1e-4f * (lv + 1e-6f));
            // A step in the surface changes uv as the tangents say. Near poles, centres and seams uv has no derivative.
            if (lu < 0.3f || lv < 0.05f) continue;
            float const h = 1e-2f;
            Vec3 const step = h * (s.dpdu * (r.unit() - 0.5f) / lu + s.dpdv * (r.unit() - 0.5f) / lv) * 0.5f;
            auto const uv_at = [&](Vec3 q) {
                ShapeHit moved = *hit;
                if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, Quad>) {
                    // A quad takes uv from its hit: shoot again.
                    auto const again = intersect(shape, 0, ray_of(q - s.ng, s.ng), 0, 1e30);
                    if (again) moved = *again;
                }
                return surface(shape, moved, q).uv;
            };
            Vec2 const a = uv_at(s.p - step), c = uv_at(s.p + step);
            if (std::abs(a.x - c.x) > 0.1f || a.y < 0.02f || a.y > 0.98f || c.y < 0.02f || c.y > 0.98f ||
                a.x < 0.02f || a.x > 0.98f || c.x < 0.02f || c.x > 0.98f)
                continue;
            Vec3 const predicted = s.dpdu * (c.x - a.x) + s.dpdv * (c.y - a.y);
            REQUIRE(length(predicted - 2.0f * step) < 0.02f * length(step) + 2e-5f);
            ++checked;
        }
        CHECK(checked > 200);
    });
}

TEST_CASE("a ray that leaves a convex shape to its outside does not hit it again") {
    auto const leave = [&](auto const& shape, bool whole, std::uint64_t seed) {
        Random r(seed);
        int again = 0, n = samples(1'000'000, 4'000'000);
        for (int i = 0; i < n; ++i) {
            auto const part = r.below(part_count(shape));
            // From a hit, and from a sample of the shape as a light.
            Vec3 p, e, ng;
            if (i % 2) {
                auto const s = sample(shape, part, random_square(r));
                p = s.p, e = s.p_error, ng = s.n;
            } else {
                Ray3d const ray = random_ray(bounds(shape), r);
                auto const hit = intersect(shape, 0, ray, 0, 1e30);
                if (!hit) continue;
                auto const s = surface(shape, *hit, point_at(ray, hit->t));
                p = s.p, e = s.p_error, ng = s.ng;
            }
            Vec3 w = random_direction(r);
            if (i % 3 == 0) w = normalize(w - ng * nephroid::dot(w, ng) + ng * 1e-4f * r.unit());  // grazing
            if (nephroid::dot(w, ng) < 0) w = -w;
            if (nephroid::dot(w, ng) <= 0) continue;
            Vec3 const o = offset_ray_origin(p, e, ng, w);
            again += intersect(shape, 0, ray_of(o, w), 0, 1e30).has_value();
            if (!whole) continue;
            // And one that goes in hits the far side exactly once, not the surface that it has left.
            Vec3 const inwards = normalize(random_direction(r) * 0.99f - ng);
            Vec3 const q = offset_ray_origin(p, e, ng, inwards);
            auto const far = intersect(shape, 0, ray_of(q, inwards), 0, 1e30);
            REQUIRE(far);
            REQUIRE(far->t > 1e-3 * static_cast<double>(length(bounds(shape).diagonal())) *
                                 std::abs(static_cast<double>(nephroid::dot(inwards, ng))) * 0.01);
        }
        CHECK(again == 0);
    };
    leave(Sphere{1, -1, 1, kTwoPi}, true, 1);
    leave(Sphere{1234.567f, -1234.567f, 1234.567f, kTwoPi}, true, 2);
    leave(Sphere{1e-4f, -1e-4f, 1e-4f, kTwoPi}, true, 3);
    leave(Sphere{1, -1, 0.3f, 4}, false, 4);
    leave(Cylinder{0.7f, -1, 3, kTwoPi}, false, 5);
    leave(Disk{3.3f, 2, 0, kTwoPi}, false, 6);
    leave(Box{{-1, 0.1f, 2}, {0.37f, 3, 2.2f}}, false, 7);
    leave(Quad{{1, 2, 3}, {0.5f, 1, 0}, {-1, 0.25f, 2}}, false, 8);
}

TEST_CASE("bilinear patches: hits, samples, density, normals") {
    for (BilinearMesh const& m : {planar_patch(), twisted_patch()}) {
        Random r(6);
        // Points with known (u, v) are found again, from either side.
        for (int i = 0; i < 20'000; ++i) {
            float const u = 0.01f + 0.98f * r.unit(), v = 0.01f + 0.98f * r.unit();
            SurfacePoint const s = surface(m, ShapeHit{0, u, v, 0}, {});
            Vec3 const exact =
                (1 - u) * (1 - v) * m.p[0] + u * (1 - v) * m.p[1] + (1 - u) * v * m.p[2] + u * v * m.p[3];
            REQUIRE(length(s.p - exact) < 1e-6f);
            REQUIRE(std::abs(length(s.ng) - 1) < 1e-6f);
            REQUIRE(nephroid::dot(s.ng, cross(s.dpdu, s.dpdv)) > 0);
            float const h = 1e-2f;
            SurfacePoint const du = surface(m, ShapeHit{0, u + h, v, 0}, {}),
                               dv = surface(m, ShapeHit{0, u, v + h, 0}, {});
            REQUIRE(length((du.p - s.p) / h - s.dpdu) < 1e-3f);
            REQUIRE(length((dv.p - s.p) / h - s.dpdv) < 1e-3f);
            Vec3 d = random_direction(r);
            if (std::abs(nephroid::dot(d, s.ng)) < 0.3f) continue;
            // From close by, so that no other sheet is in between.
            auto const hit = intersect(m, 0, ray_of(s.p - 0.05f * d, d), 0, 1e30);
            REQUIRE(hit);
            REQUIRE(hit->t == doctest::Approx(0.05).epsilon(1e-3));
            REQUIRE((std::abs(hit->u - u) < 1e-4f && std::abs(hit->v - v) < 1e-4f));
        }
        // The density by area, drawn as said: the mean of 1 / pdf is the area.
        Mean mean;
        int const n = samples(1'000'000, 4'000'000);
        std::vector<double> o(400);
        for (int i = 0; i < n; ++i) {
            Vec2 const u = random_square(r);
            ShapeSample const s = sample(m, 0, u);
            REQUIRE(s.pdf_area == sample_pdf(m, 0, u));
            REQUIRE(length(s.p - surface(m, ShapeHit{0, u.x, u.y, 0}, {}).p) == 0);
            mean.add(1 / static_cast<double>(s.pdf_area));
        }
        auto const a = agrees(mean, static_cast<double>(part_area(m, 0)), 0.005);
        INFO(a);
        CHECK(a);
        // ... and is the Jacobian of the map.
        for (int i = 0; i < 500; ++i) {
            Vec2 const u{0.1f + 0.8f * r.unit(), 0.1f + 0.8f * r.unit()};
            float const h = 0.02f;
            auto const at = [&](float x, float y) { return sample(m, 0, {u.x + x, u.y + y}).p; };
            double const element =
                static_cast<double>(length(cross(at(h, 0) - at(-h, 0), at(0, h) - at(0, -h)))) /
                (4.0 * h * h);
            CHECK(static_cast<double>(sample_pdf(m, 0, u)) * element == doctest::Approx(1).epsilon(1e-3));
        }
    }
    // Normals of the mesh turn the geometric normal to their side; uv of the mesh are interpolated, and so are tangents.
    BilinearMesh m = twisted_patch();
    m.n = std::vector<Vec3>(4, Vec3{0, 0, -1});
    m.uv = {{0, 0}, {2, 0}, {0, 3}, {2, 3}};
    SurfacePoint const s = surface(m, ShapeHit{0, 0.25f, 0.5f, 0}, {});
    CHECK(s.ng.z < 0);
    CHECK(s.ns == Vec3{0, 0, -1});
    CHECK(sample(m, 0, {0.3f, 0.4f}).n.z < 0);
    CHECK(s.uv.x == doctest::Approx(0.5));
    CHECK(s.uv.y == doctest::Approx(1.5));
    SurfacePoint const plain = surface(twisted_patch(), ShapeHit{0, 0.25f, 0.5f, 0}, {});
    CHECK(length(s.dpdu - plain.dpdu / 2.0f) < 1e-5f);
    CHECK(length(s.dpdv - plain.dpdv / 3.0f) < 1e-5f);
}

TEST_CASE("triangles: points, normals, flips, tangents, samples") {
    TriangleMesh m;
    m.p = {{0, 0, 0}, {2, 0, 0}, {0, 3, 1}};
    m.triangles = {{0, 1, 2}};
    CHECK(triangle_area(m, 0) == doctest::Approx(0.5 * std::sqrt(36 + 4)));
    Vec3 const n = normalize(cross(m.p[1], m.p[2]));
    SurfacePoint s = surface_of(m, 0, {0.25f, 0.5f}, false, true);
    CHECK(length(s.p - (0.25f * m.p[1] + 0.5f * m.p[2])) < 1e-6f);
    CHECK(length(s.ng - n) < 1e-6f);
    CHECK(length(surface_of(m, 0, {0.25f, 0.5f}, true, false).ng + n) < 1e-6f);
    // Without uv the corners are (0,0), (1,0), (1,1), as pbrt has them.
    CHECK(s.uv.x == doctest::Approx(0.75));
    CHECK(s.uv.y == doctest::Approx(0.5));
    CHECK(length(s.dpdu - (m.p[1] - m.p[0])) < 1e-6f);
    CHECK(length(s.dpdv - (m.p[2] - m.p[1])) < 1e-6f);
    m.uv = {{0, 0}, {0, 2}, {4, 0}};
    s = surface_of(m, 0, {0.25f, 0.5f}, false, true);
    CHECK(length(s.dpdv - m.p[1] / 2.0f) < 1e-6f);
    CHECK(length(s.dpdu - m.p[2] / 4.0f) < 1e-6f);
    // Shading normals decide the side.
    m.n = std::vector<Vec3>(3, -n);
    m.n[1] = normalize(-n + Vec3{0.2f, 0, 0});
    s = surface_of(m, 0, {0.5f, 0.25f}, false, false);
    CHECK(length(s.ng + n) < 1e-6f);
    CHECK(length(s.ns - normalize(0.5f * m.n[1] - 0.5f * n)) < 1e-6f);
    m.n.clear();
    // Uniform by area: barycentric coordinates in small congruent triangles; points within their error of the plane.
    Random r(7);
    std::vector<double> o(200);
    int const count = samples(1'000'000, 4'000'000);
    for (int i = 0; i < count; ++i) {
        ShapeSample const q = sample_triangle(m, 0, false, random_square(r));
        REQUIRE(q.pdf_area == doctest::Approx(1 / static_cast<double>(triangle_area(m, 0))));
        double const off = std::abs(dot(to_d(q.p), to_d(n)));
        REQUIRE(off <= static_cast<double>(nephroid::dot(abs(n), q.p_error)) * 1.01 + 1e-7);
        double const b2 = static_cast<double>(q.p.y) / 3, b1 = static_cast<double>(q.p.x) / 2;
        // Folding the triangle to a parallelogram and back: sqrt(b1 + b2) turns it into a square.
        double const t = b1 + b2;
        int const row = std::clamp(static_cast<int>(t * t * 20), 0, 19);
        int const col = std::clamp(static_cast<int>(b1 / t * 10), 0, 9);
        ++o[static_cast<std::size_t>(row * 10 + col)];
    }
    auto const c = chi_square(o, std::vector<double>(200, count / 200.0));
    INFO(c);
    CHECK(c.p >= 0.01);
    CHECK(bounds(m).hi == Vec3{2, 3, 1});
}

TEST_CASE("baking a transform into a mesh: points, normals by the inverse transpose, reversal") {
    TriangleMesh m;
    m.p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
    m.triangles = {{0, 1, 2}};
    Vec3 const n = normalize(cross(m.p[1], m.p[2]));
    m.n = std::vector<Vec3>(3, n);
    Mat4 const t = translate(1, 2, 3) * *rotate(40, 1, 2, 3) * scale(1, 3, 0.5);
    TriangleMesh b = m;
    transform_mesh(b, t, false);
    Vec3 const exact = cross(b.p[1] - b.p[0], b.p[2] - b.p[0]);
    CHECK(length(cross(normalize(exact), normalize(b.n[0]))) < 1e-5f);
    CHECK(nephroid::dot(exact, b.n[0]) > 0);
    TriangleMesh c = m;
    transform_mesh(c, t, true);
    CHECK(length(c.n[0] + b.n[0]) < 1e-6f);
    CHECK(c.p[1] == b.p[1]);
}

TEST_CASE("mapped surfaces: the side is kept under mirrors, area stretches under shear") {
    Random r(8);
    for (bool const mirror : {false, true}) {
        AffineMap map;
        map.m = {{{mirror ? -1.0f : 1.0f, 0.4f, 0, 1}, {0, 2, 0.3f, -2}, {0.2f, 0, 0.5f, 3}}};
        CHECK((map.determinant() < 0) == mirror);
        Sphere const sphere{1, -1, 1, kTwoPi};
        Mean area_mean;
        Vec3 const centre = map.point({0, 0, 0});
        for (int i = 0; i < samples(1'000'000, 4'000'000); ++i) {
            ShapeSample const local = sample(sphere, 0, random_square(r));
            ShapeSample const s = transformed(map, local);
            REQUIRE(std::abs(length(s.n) - 1) < 1e-5f);
            // An ellipsoid is convex: its normals point away from its centre.
            REQUIRE(nephroid::dot(s.n, s.p - centre) > 0);
            area_mean.add(1 / static_cast<double>(s.pdf_area));
            if (i % 100 == 0) {
                // The stretch by hand, from mapped tangents.
                Frame const f = frame_from_z(local.n);
                double const stretch = static_cast<double>(length(cross(map.vector(f.x), map.vector(f.y))));
                CHECK(static_cast<double>(local.pdf_area / s.pdf_area) ==
                      doctest::Approx(stretch).epsilon(1e-4));
                CHECK(std::abs(nephroid::dot(s.n, map.vector(f.x))) < 1e-4f);
                SurfacePoint q;
                q.p = local.p, q.ng = local.n, q.ns = local.n, q.dpdu = f.x, q.dpdv = f.y;
                SurfacePoint const t = transformed(map, q);
                CHECK(length(t.ng - s.n) < 1e-5f);
                CHECK(length(t.dpdu - map.vector(f.x)) == 0);
            }
        }
        // Monte Carlo against a fine mesh of the ellipsoid.
        double exact = 0;
        int const k = 600;
        auto const at = [&](int a, int b) { return map.point(direction(kPiD * a / k, 2 * kPiD * b / k)); };
        for (int a = 0; a < k; ++a)
            for (int b = 0; b < k; ++b)
                exact += 0.5 * static_cast<double>(
                                   length(cross(at(a + 1, b) - at(a, b), at(a, b + 1) - at(a, b)))) +
                         0.5 * static_cast<double>(length(
                                   cross(at(a + 1, b) - at(a + 1, b + 1), at(a, b + 1) - at(a + 1, b + 1))));
        auto const a = agrees(area_mean, exact, 0.005);
        INFO(a);
        CHECK(a);
    }
    // Error bounds against long double.
    for (int i = 0; i < 20'000; ++i) {
        AffineMap map;
        for (auto& row : map.m)
            for (float& x : row) x = static_cast<float>(r.uniform(-5, 5));
        SurfacePoint s;
        s.p = random_direction(r) * 7.0f;
        s.p_error = abs(s.p) * 3e-7f;
        SurfacePoint const t = transformed(map, s);
        for (int k = 0; k < 3; ++k) {
            auto const& row = map.m[static_cast<std::size_t>(k)];
            long double exact = row[3], spread = 0;
            for (int j = 0; j < 3; ++j) {
                exact += static_cast<long double>(row[static_cast<std::size_t>(j)]) * s.p[j];
                spread += std::abs(static_cast<long double>(row[static_cast<std::size_t>(j)]) * s.p_error[j]);
            }
            REQUIRE(std::abs(t.p[k] - exact) + spread <= t.p_error[k]);
        }
    }
}

TEST_CASE("Loop subdivision of an octahedron and an icosahedron: closed, outward, convergent") {
    LoopSubdivision octahedron;
    octahedron.p = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    octahedron.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    LoopSubdivision icosahedron;
    float const g = 1.61803399f;
    icosahedron.p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    icosahedron.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                             {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                             {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                             {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (LoopSubdivision control : {octahedron, icosahedron}) {
        std::vector<double> areas;
        for (int const levels : {1, 2, 3, 4}) {
            control.levels = levels;
            TriangleMesh const m = subdivide(control);
            REQUIRE(m.triangles.size() == control.triangles.size() << (2 * levels));
            REQUIRE(m.n.size() == m.p.size());
            std::map<std::pair<int, int>, int> edges;
            double total = 0;
            for (std::uint32_t t = 0; t < m.triangles.size(); ++t) {
                Vec3i const v = m.triangles[t];
                for (int k = 0; k < 3; ++k) ++edges[{v[k], v[(k + 1) % 3]}];
                total += static_cast<double>(triangle_area(m, t));
                SurfacePoint const s = surface_of(m, t, {1 / 3.0f, 1 / 3.0f}, false, false);
                REQUIRE(nephroid::dot(s.ng, s.p) > 0);
                REQUIRE(nephroid::dot(s.ns, s.p) > 0.8f * length(s.p));
            }
            // Closed and oriented: each directed edge once, and its reverse.
            for (auto const& [e, k] : edges) {
                REQUIRE(k == 1);
                REQUIRE(edges.count({e.second, e.first}) == 1);
            }
            // Limit vertices stay on the limit surface: coarse ones are among the fine ones.
            areas.push_back(total);
        }
        double const d1 = areas[1] - areas[0], d2 = areas[2] - areas[1], d3 = areas[3] - areas[2];
        CHECK(d1 > 0);
        CHECK(d1 / d2 == doctest::Approx(4).epsilon(0.25));  // inscribed triangles: an error of h^2
        CHECK(d2 / d3 == doctest::Approx(4).epsilon(0.15));
    }
    // A vertex of valence 4 by hand: limit = (5/8 ... Loop's weights): beta = 31/64/... beta_4 = 0.121094,
    // chi = 1 / (4 + 3 / (8 beta)) = 0.140939; the ring of an octahedron's tip averages to 0.
    octahedron.levels = 1;
    TriangleMesh const m = subdivide(octahedron);
    float top = 0;
    for (Vec3 const p : m.p) top = std::max(top, p.z);
    double const beta = (0.625 - std::pow(0.375 + 0.25 * std::cos(kPiD / 2), 2)) / 4;
    double const chi = 1 / (4 + 3 / (8 * beta));
    CHECK(static_cast<double>(top) == doctest::Approx(1 - 4 * chi).epsilon(1e-5));
}
