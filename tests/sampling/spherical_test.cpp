// Triangles and rectangles by solid angle, the bilinear cosine on top of them, and tabulated densities: against solid angles in
// long double, Lambert's irradiance, inverses, Jacobians, and the ends of the unit interval.
#include "sampling/arc.h"
#include "sampling/spherical_rectangle.h"
#include "sampling/spherical_triangle.h"
#include "sampling/tabulated.h"
#include "sampling/warp.h"
#include "statistics.h"

#include <doctest/doctest.h>

#include <string>

using namespace nephroid;
using namespace nephroid::test;

namespace {

using Real = long double;
struct R3 {
    Real x, y, z;
};
R3 real(Vec3 v) { return {v.x, v.y, v.z}; }
R3 operator+(R3 a, R3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
R3 operator-(R3 a, R3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
R3 operator*(Real s, R3 a) { return {s * a.x, s * a.y, s * a.z}; }
Real dot(R3 a, R3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
R3 cross(R3 a, R3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Real length(R3 a) { return std::sqrt(dot(a, a)); }

/// Of a triangle, by the angles between its sides' planes (Girard) where it is large and by l'Huilier's formula where it is not.
Real solid_angle(R3 a, R3 b, R3 c) {
    auto const arc = [](R3 p, R3 q) { return std::atan2(length(cross(p, q)), dot(p, q)); };
    Real const ab = arc(a, b), bc = arc(b, c), ca = arc(c, a);
    Real const s = (ab + bc + ca) / 2;
    // Sides that differ from their sum by rounding only: the volume says how flat the triangle is.
    Real const volume = std::abs(dot(a, cross(b - a, c - a)));
    auto const angle = [&](R3 p, R3 q, R3 r) {
        R3 const n1 = cross(p, q), n2 = cross(p, r);
        return std::atan2(volume * length(p), dot(n1, n2));
    };
    if (s > 1) return angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - std::acos(Real(-1));
    Real const t = std::tan(s / 2) * std::tan((s - ab) / 2) * std::tan((s - bc) / 2) * std::tan((s - ca) / 2);
    return t > 0 ? 4 * std::atan(std::sqrt(t)) : 0;
}
/// Of the rectangle [x0,x1] x [y0,y1] at the distance z: the sum over corners of atan(xy / (z r)).
Real solid_angle(Real x0, Real x1, Real y0, Real y1, Real z) {
    auto const f = [z](Real x, Real y) { return std::atan2(x * y, z * std::sqrt(x * x + y * y + z * z)); };
    return f(x1, y1) - f(x0, y1) - f(x1, y0) + f(x0, y0);
}
/// Irradiance by Lambert's formula, all corners above the horizon n.
Real irradiance(R3 n, std::vector<R3> const& v) {
    Real sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        R3 const a = v[i], b = v[(i + 1) % v.size()];
        R3 const g = cross(a, b);
        sum += std::atan2(length(g), dot(a, b)) * dot(n, g) / length(g);
    }
    return std::abs(sum) / 2;
}

Vec2 random_square(Random& r) {
    float const x = r.unit();
    return {x, r.unit()};
}
float const kCorners[] = {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f};

/// How much a function of two floats changes with their last bits.
template <class F>
Vec2 last_bits(F const& f, Vec2 at) {
    Vec2 const here = f(at);
    Vec2 worst{0, 0};
    for (Vec2 const step : {Vec2{0x1p-22f, 0}, Vec2{-0x1p-22f, 0}, Vec2{0, 0x1p-22f}, Vec2{0, -0x1p-22f}}) {
        Vec2 const there = f(at + step);
        worst = {std::max(worst.x, std::abs(there.x - here.x)),
                 std::max(worst.y, std::abs(there.y - here.y))};
    }
    return worst;
}

/// A rectangle in a general position and receivers all around it: coordinates along its edges and from its plane, in units of the
/// edges' mean.
Vec3 const kEdgeX{1.2f, 0.6f, 0.3f}, kEdgeY{-0.4f, 0.8f, 0};
std::vector<std::pair<std::string, Vec3>> const kReceivers = {{"over the middle", {0.5f, 0.5f, 0.7f}},
                                                              {"the other side", {0.5f, 0.4f, -0.7f}},
                                                              {"near", {0.3f, 0.6f, 0.05f}},
                                                              {"very near", {0.7f, 0.3f, 1e-3f}},
                                                              {"touching", {0.4f, 0.4f, -1e-5f}},
                                                              {"over an edge", {0, 0.5f, 0.2f}},
                                                              {"over a corner", {1, 1, 0.3f}},
                                                              {"near a corner", {1.001f, 1.002f, 0.001f}},
                                                              {"near an edge", {0.5f, -1e-4f, 1e-4f}},
                                                              {"beside", {2, 0.5f, 0.5f}},
                                                              {"beside, below", {-2, 0.5f, -0.5f}},
                                                              {"grazing", {2, 0.4f, 0.01f}},
                                                              {"grazing more", {-1, 1.5f, 1e-4f}},
                                                              {"grazing most", {0.5f, -2, -1e-6f}},
                                                              {"grazing near", {1.01f, 0.5f, 1e-3f}},
                                                              {"diagonal", {3, 3, 0.5f}},
                                                              {"behind the corner", {-3, -3, -0.05f}},
                                                              {"far", {2, 3, 30}},
                                                              {"far, grazing", {50, 20, 1}},
                                                              {"very far", {300, -500, 800}},
                                                              {"very far, grazing", {-1000, 300, 10}},
                                                              {"ten thousand", {3000, 4000, -9000}},
                                                              {"over the diagonal", {0.25f, 0.25f, 1e-4f}},
                                                              {"half way", {0.9f, 0.1f, 0.3f}}};

/// The rectangle's corner relative to such a receiver.
Vec3 corner_of(RectangleAxes const& axes, Vec3 at) {
    return -(at.x * kEdgeX + at.y * kEdgeY + at.z * axes.n);
}
/// The same numbers, in long double, from what the sampler is given.
struct Placed {
    Real x0, x1, y0, y1, z;
};
Placed place(RectangleAxes const& axes, Vec3 corner) {
    Real const x0 = dot(real(corner), real(axes.x)), y0 = dot(real(corner), real(axes.y));
    return {x0, x0 + axes.width, y0, y0 + axes.height, std::abs(dot(real(corner), real(axes.n)))};
}

struct Corners {
    Vec3 a, b, c;
};
/// The rectangle's halves and thinner ones: 0 right-angled, 1 sliver, 2 obtuse.
std::vector<Corners> triangles_from(RectangleAxes const& axes, Vec3 at) {
    Vec3 const s = corner_of(axes, at);
    return {{s, s + kEdgeX, s + kEdgeY},
            {s + 1e-3f * kEdgeY, s + kEdgeX, s + 0.6f * kEdgeX},
            {s + 0.5f * kEdgeY, s + 2.0f * kEdgeX, s + kEdgeY - kEdgeX}};
}
template <class F>
void for_triangles(F const& f) {
    RectangleAxes const axes = rectangle_axes(kEdgeX, kEdgeY);
    for (auto const& receiver : kReceivers) {
        std::string const& name = receiver.first;
        Vec3 const at = receiver.second;
        int k = 0;
        for (Corners const& t : triangles_from(axes, at)) {
            INFO(name, ", triangle ", k++);
            f(t);
        }
    }
}
int triangle_count() { return static_cast<int>(kReceivers.size()) * 3; }

Vec3 point(Corners const& t, Vec2 bc) { return (1.0f - bc.x - bc.y) * t.a + bc.x * t.b + bc.y * t.c; }
R3 exact_point(Corners const& t, Real b, Real c) {
    return (1 - b - c) * real(t.a) + b * real(t.b) + c * real(t.c);
}

}  // namespace

TEST_CASE("sines, cosines and angles by polynomials are exact to 2e-10, small ones relatively") {
    Random r(1);
    double sine = 0, small = 0, angle = 0, small_angle = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        double const a = kPiDouble * r.uniform() * (i % 2 ? 1 : std::exp(r.uniform(-40, 0)));
        SinCos const s = sin_cos_half_turn(a);
        sine = std::max({sine, std::abs(s.sin - std::sin(a)), std::abs(s.cos - std::cos(a))});
        if (a > 0 && a < 1) small = std::max(small, std::abs(s.sin / std::sin(a) - 1));
        double const x = std::exp(r.uniform(-20, 20)) * (i % 2 ? 1 : -1), y = std::exp(r.uniform(-20, 20));
        double const off = std::abs(upper_angle(y, x) - std::atan2(y, x));
        angle = std::max(angle, off);
        if (x > 0) small_angle = std::max(small_angle, off / std::atan2(y, x));
    }
    CHECK(sine < 2e-10);
    CHECK(small < 3e-11);
    CHECK(angle < 1e-10);
    CHECK(small_angle < 3e-11);
    CHECK(upper_angle(0, 1) == 0);
    CHECK(upper_angle(0, 0) == 0);
    CHECK(upper_angle(0, -1) == doctest::Approx(kPiDouble).epsilon(1e-12));
    CHECK(upper_angle(1, 0) == doctest::Approx(kPiDouble / 2).epsilon(1e-12));
}

TEST_CASE("rectangle: the solid angle, from everywhere") {
    RectangleAxes const axes = rectangle_axes(kEdgeX, kEdgeY);
    for (auto const& receiver : kReceivers) {
        std::string const& name = receiver.first;
        Vec3 const at = receiver.second;
        INFO(name);
        Vec3 const s = corner_of(axes, at);
        Placed const p = place(axes, s);
        CHECK(static_cast<double>(SphericalRectangle(axes, s).solid_angle()) ==
              doctest::Approx(static_cast<double>(solid_angle(p.x0, p.x1, p.y0, p.y1, p.z))).epsilon(2e-6));
    }
    // A face of a cube from its centre is a sixth of the sphere. From its own plane a rectangle is nothing.
    RectangleAxes const square = rectangle_axes({2, 0, 0}, {0, 2, 0});
    CHECK(SphericalRectangle(square, {-1, -1, 1}).solid_angle() ==
          doctest::Approx(4 * kPiDouble / 6).epsilon(1e-7));
    CHECK(SphericalRectangle(square, {-1, -1, 0}).solid_angle() == 0);
    CHECK(SphericalRectangle(square, {1, 1, 0}).solid_angle() == 0);
}

TEST_CASE("rectangle: chi square of the points against the solid angles of 400 cells") {
    RectangleAxes const axes = rectangle_axes(kEdgeX, kEdgeY);
    double const alpha = sidak(static_cast<int>(kReceivers.size()));
    int const n = samples(1'000'000, 4'000'000);
    std::uint64_t seed = 100;
    for (auto const& receiver : kReceivers) {
        std::string const& name = receiver.first;
        Vec3 const at = receiver.second;
        Vec3 const s = corner_of(axes, at);
        Placed const p = place(axes, s);
        SphericalRectangle const rectangle(axes, s);
        std::vector<double> o(400), e(400);
        Random r(seed++);
        for (int i = 0; i < n; ++i) {
            Vec2 const st = rectangle.sample(random_square(r));
            REQUIRE((st.x >= 0 && st.x <= 1 && st.y >= 0 && st.y <= 1));
            ++o[static_cast<std::size_t>(std::min(19, static_cast<int>(st.y * 20)) * 20 +
                                         std::min(19, static_cast<int>(st.x * 20)))];
        }
        auto const at_x = [&](int k) { return p.x0 + (p.x1 - p.x0) * k / 20; };
        auto const at_y = [&](int k) { return p.y0 + (p.y1 - p.y0) * k / 20; };
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 20; ++x)  // the total is not scaled: the density is 1 / solid_angle()
                e[static_cast<std::size_t>(y * 20 + x)] =
                    n * static_cast<double>(solid_angle(at_x(x), at_x(x + 1), at_y(y), at_y(y + 1), p.z)) /
                    static_cast<double>(rectangle.solid_angle());
        ChiSquare const c = chi_square(o, e);
        INFO(name, ": ", c);
        CHECK(c.p >= alpha);
    }
}

TEST_CASE("rectangle: inverse, Jacobian, ends, and scaled scenes") {
    RectangleAxes const axes = rectangle_axes(kEdgeX, kEdgeY);
    Random r(3);
    for (auto const& receiver : kReceivers) {
        std::string const& name = receiver.first;
        Vec3 const at = receiver.second;
        INFO(name);
        Vec3 const s = corner_of(axes, at);
        SphericalRectangle const q(axes, s);
        for (int i = 0; i < 2000; ++i) {
            Vec2 const u = random_square(r);
            Vec2 const st = q.sample(u);
            // Where many u share a float of st, the inverse cannot tell them apart.
            Vec2 const back = q.invert(st);
            Vec2 const loss = last_bits([&](Vec2 v) { return q.invert(v); }, st);
            REQUIRE(std::abs(back.x - u.x) <= 2e-6f + loss.x);
            REQUIRE(std::abs(back.y - u.y) <= 2e-6f + loss.y);
        }
        for (float const x : kCorners)
            for (float const y : kCorners) {
                Vec2 const st = q.sample({x, y});
                REQUIRE((st.x >= 0 && st.x <= 1 && st.y >= 0 && st.y <= 1));  // and so no NaN
                Vec2 const u = q.invert({x, y});
                REQUIRE((u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
            }
        CHECK((q.solid_angle() > 0 && q.solid_angle() <= kTwoPi));
        for (float const scale : {0x1p-13f, 0x1p20f}) {
            RectangleAxes const scaled = rectangle_axes(scale * kEdgeX, scale * kEdgeY);
            SphericalRectangle const other(scaled, scale * s);
            CHECK(other.solid_angle() == q.solid_angle());
            for (int i = 0; i < 100; ++i) {
                Vec2 const u = random_square(r);
                CHECK(other.sample(u) == q.sample(u));
            }
        }
        // The solid angle of a cell of the square is its area times the whole's. Very near, nearly all of the square is one place.
        if (std::abs(at.z) < 0.1f) continue;
        for (int i = 0; i < 200; ++i) {
            float const h = 3e-3f;
            Vec2 const u{0.02f + 0.96f * r.unit(), 0.02f + 0.96f * r.unit()};
            Placed const p = place(axes, s);
            auto const direction = [&](Vec2 v) {
                Vec2 const st = q.sample(v);
                R3 const w{p.x0 + (p.x1 - p.x0) * static_cast<Real>(st.x),
                           p.y0 + (p.y1 - p.y0) * static_cast<Real>(st.y), p.z};
                return (1 / length(w)) * w;
            };
            R3 const du = direction({u.x + h, u.y}) - direction({u.x - h, u.y});
            R3 const dv = direction({u.x, u.y + h}) - direction({u.x, u.y - h});
            double const element =
                static_cast<double>(length(cross(du, dv))) / (4.0 * static_cast<double>(h * h));
            CHECK(element == doctest::Approx(static_cast<double>(q.solid_angle())).epsilon(1e-3));
        }
    }
}

TEST_CASE("triangle: the solid angle, from everywhere, slivers and almost half of the sphere") {
    for_triangles([](Corners const& t) {
        CHECK(
            static_cast<double>(SphericalTriangle(t.a, t.b, t.c).solid_angle()) ==
            doctest::Approx(static_cast<double>(solid_angle(real(t.a), real(t.b), real(t.c)))).epsilon(2e-6));
    });
    CHECK(SphericalTriangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}).solid_angle() ==
          doctest::Approx(kPiDouble / 2).epsilon(1e-7));
    float const h = 1e-4f;
    CHECK(SphericalTriangle({-2, -1, h}, {2, -1, h}, {0, 2, h}).solid_angle() ==
          doctest::Approx(2 * kPiDouble).epsilon(1e-4));
    CHECK(SphericalTriangle({-2, -1, 0}, {2, -1, 0}, {0, 2, 0}).solid_angle() == 0);
    CHECK(SphericalTriangle({1, 1, 1}, {2, 2, 2}, {3, 1, 0}).solid_angle() == 0);
}

TEST_CASE("triangle: chi square of the points against the solid angles of 256 cells") {
    constexpr int kN = 16;
    double const alpha = sidak(triangle_count());
    int const n = samples(300'000, 4'000'000);
    std::uint64_t seed = 200;
    for_triangles([&](Corners const& t) {
        SphericalTriangle const triangle(t.a, t.b, t.c);
        std::vector<double> o(kN * kN * 2), e(kN * kN * 2);
        Random r(seed++);
        for (int i = 0; i < n; ++i) {
            Vec2 const b = triangle.sample(random_square(r));
            REQUIRE((b.x >= 0 && b.y >= 0 && b.x + b.y <= 1));
            double const bx = static_cast<double>(b.x) * kN, by = static_cast<double>(b.y) * kN;
            int const x = std::min(kN - 1, static_cast<int>(bx)),
                      y = std::min(kN - 1 - x, static_cast<int>(by));
            bool const upper = x + y < kN - 1 && bx - x + by - y > 1;
            ++o[static_cast<std::size_t>((y * kN + x) * 2 + upper)];
        }
        auto const at = [&](int x, int y) {
            return exact_point(t, static_cast<Real>(x) / kN, static_cast<Real>(y) / kN);
        };
        for (int y = 0; y < kN; ++y)
            for (int x = 0; x + y < kN; ++x)
                for (int upper = 0; upper <= (x + y < kN - 1 ? 1 : 0); ++upper)
                    e[static_cast<std::size_t>((y * kN + x) * 2 + upper)] =
                        n *
                        static_cast<double>(upper ? solid_angle(at(x + 1, y), at(x + 1, y + 1), at(x, y + 1))
                                                  : solid_angle(at(x, y), at(x + 1, y), at(x, y + 1))) /
                        static_cast<double>(triangle.solid_angle());
        ChiSquare const c = chi_square(o, e);
        INFO(c);
        CHECK(c.p >= alpha);
    });
}

TEST_CASE("triangle: inverse, Jacobian, ends, and scaled scenes") {
    Random r(5);
    for_triangles([&](Corners const& t) {
        SphericalTriangle const q(t.a, t.b, t.c);
        for (int i = 0; i < 1000; ++i) {
            Vec2 const u{r.unit(), 0.01f + 0.99f * r.unit()};
            Vec2 const b = q.sample(u);
            Vec2 const back = q.invert(b);
            Vec2 const loss = last_bits([&](Vec2 v) { return q.invert(v); }, b);
            REQUIRE(std::abs(back.x - u.x) <= 2e-6f + loss.x);
            REQUIRE(std::abs(back.y - u.y) <= 2e-6f + loss.y);
        }
        for (float const x : kCorners)
            for (float const y : kCorners) {
                Vec2 const b = q.sample({x, y});
                REQUIRE((b.x >= 0 && b.y >= 0 && b.x + b.y <= 1));
                Vec2 const u = q.invert(b);
                REQUIRE((u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
            }
        CHECK((q.solid_angle() > 0 && q.solid_angle() <= kTwoPi));
        for (float const scale : {0x1p-13f, 0x1p20f}) {
            SphericalTriangle const other(scale * t.a, scale * t.b, scale * t.c);
            CHECK(other.solid_angle() == q.solid_angle());
            for (int i = 0; i < 100; ++i) {
                Vec2 const u = random_square(r);
                CHECK(other.sample(u) == q.sample(u));
            }
        }
    });
    // Away from b, where the map is a cone's tip.
    for (Vec3 const at : {Vec3{0.5f, 0.5f, 0.7f}, Vec3{2, 0.5f, 0.5f}, Vec3{1, 1, 0.3f}, Vec3{2, 3, 8}})
        for (Corners const& t : triangles_from(rectangle_axes(kEdgeX, kEdgeY), at)) {
            SphericalTriangle const q(t.a, t.b, t.c);
            for (int i = 0; i < 200; ++i) {
                float const h = 3e-3f;
                Vec2 const u{0.02f + 0.96f * r.unit(), 0.3f + 0.68f * r.unit()};
                auto const direction = [&](Vec2 v) {
                    Vec2 const b = q.sample(v);
                    R3 const w = exact_point(t, b.x, b.y);
                    return (1 / length(w)) * w;
                };
                R3 const du = direction({u.x + h, u.y}) - direction({u.x - h, u.y});
                R3 const dv = direction({u.x, u.y + h}) - direction({u.x, u.y - h});
                double const element =
                    static_cast<double>(length(cross(du, dv))) / (4.0 * static_cast<double>(h * h));
                CHECK(element == doctest::Approx(static_cast<double>(q.solid_angle())).epsilon(1e-3));
            }
        }
}

TEST_CASE("triangle: the square's corners are b, b, a and c; directions lead back, and misses to nothing") {
    Corners const t{{-1, -1, 2}, {2, -0.5f, 1.5f}, {0.3f, 1.5f, 2.5f}};
    for (bool const mirrored : {false, true}) {
        Corners const m = mirrored ? Corners{t.c, t.b, t.a} : t;
        SphericalTriangle const q(m.a, m.b, m.c);
        float const end = 1 - 0x1p-24f;
        auto const near = [](Vec2 a, Vec2 b) {
            return std::abs(a.x - b.x) < 1e-6f && std::abs(a.y - b.y) < 1e-6f;
        };
        CHECK(near(q.sample({0, 0}), {1, 0}));
        CHECK(near(q.sample({end, 0}), {1, 0}));
        CHECK(near(q.sample({0, end}), {0, 0}));
        CHECK(near(q.sample({end, end}), {0, 1}));
        Random r(6);
        for (int i = 0; i < 2000; ++i) {
            Vec2 const u{r.unit(), 0.01f + 0.99f * r.unit()};
            auto const back = q.invert(3.5f * point(m, q.sample(u)));
            REQUIRE(back);
            REQUIRE(std::abs(back->x - u.x) < 3e-5f);
            REQUIRE(std::abs(back->y - u.y) < 1e-5f);
            // Outside by a tenth, and behind.
            Vec2 const out = q.sample({u.x, end}) * 1.1f + Vec2{-0.1f, 0};
            CHECK_FALSE(q.invert(point(m, out)));
            CHECK_FALSE(q.invert(-point(m, q.sample(u))));
        }
    }
}

TEST_CASE("irradiance by Lambert's formula, with and without the cosine's warp, which lowers the variance") {
    RectangleAxes const axes = rectangle_axes(kEdgeX, kEdgeY);
    int tests = 0;
    for (auto const& [name, at] : kReceivers)
        if (std::abs(at.z) > 0.01f) ++tests;
    double const alpha = sidak(tests * 4);
    int better = 0, worse = 0;
    std::uint64_t seed = 300;
    for (auto const& receiver : kReceivers) {
        std::string const& name = receiver.first;
        Vec3 const at = receiver.second;
        if (std::abs(at.z) <= 0.01f) continue;
        Vec3 const s = corner_of(axes, at);
        // A horizon that the whole rectangle is above of, and close to some of it.
        Vec3 const to_middle = s + 0.5f * kEdgeX + 0.5f * kEdgeY;
        Vec3 n = normalize(normalize(to_middle) + 0.8f * axes.x);
        for (Vec3 const corner : {s, s + kEdgeX, s + kEdgeY, s + kEdgeX + kEdgeY})
            if (nephroid::dot(n, corner) <= 0) n = at.z > 0 ? -axes.n : axes.n;
        for (int kind = 0; kind < 2; ++kind) {
            SphericalRectangle const rectangle(axes, s);
            SphericalTriangle const triangle(s, s + kEdgeX, s + kEdgeY);
            std::array<Vec3, 4> const square{kind ? s + kEdgeX : s, s + kEdgeX, kind ? s : s + kEdgeY,
                                             kind ? s + kEdgeY : s + kEdgeX + kEdgeY};
            auto const weights = cosine_weights(square, n, false);
            float const omega = kind ? triangle.solid_angle() : rectangle.solid_angle();
            // The rectangle's corners as they are, not rounded; the triangle has them rounded.
            std::vector<R3> corners{real(s), kind ? real(s + kEdgeX) : real(s) + real(kEdgeX)};
            if (!kind) corners.push_back(real(s) + real(kEdgeX) + real(kEdgeY));
            corners.push_back(kind ? real(s + kEdgeY) : real(s) + real(kEdgeY));
            auto const expected = static_cast<double>(irradiance(real(n), corners));
            Mean plain, warped;
            Random r(seed++);
            for (int i = 0; i < samples(40'000, 1'000'000); ++i) {
                Vec2 const u = random_square(r);
                for (bool const warp : {false, true}) {
                    Vec2 const v = warp ? sample_bilinear(u, weights.data()) : u;
                    Vec3 w;
                    if (kind) {
                        w = point({s, s + kEdgeX, s + kEdgeY}, triangle.sample(v));
                    } else {
                        Vec2 const st = rectangle.sample(v);
                        w = s + st.x * kEdgeX + st.y * kEdgeY;
                    }
                    float const pdf = (warp ? bilinear_pdf(v, weights.data()) : 1.0f) / omega;
                    (warp ? warped : plain)
                        .add(static_cast<double>(std::max(0.0f, nephroid::dot(n, normalize(w))) / pdf));
                    if (warp && i % 64 == 0) {
                        Vec2 const back = invert_bilinear(v, weights.data());
                        REQUIRE(std::abs(back.x - u.x) < 4e-6f);
                        REQUIRE(std::abs(back.y - u.y) < 4e-6f);
                    }
                }
            }
            Agreement const a = agrees(plain, expected, 0.02, alpha),
                            b = agrees(warped, expected, 0.02, alpha);
            std::string const which = name + (kind ? ", triangle" : ", rectangle");
            INFO(which, ": ", a, "; warped: ", b);
            CHECK(a);
            CHECK(b);
            // Right over the rectangle the cosine is highest in its middle, which the corners do not tell: no gain, little loss.
            if (plain.variance() > 1e-4 * expected * expected) {
                ++(warped.variance() < plain.variance() ? better : worse);
                CHECK(warped.variance() < 1.2 * plain.variance());
            }
        }
    }
    CHECK(better >= 15);
    CHECK(worse <= 2);
}

TEST_CASE("tabulated densities: chi square, inverse, Jacobian, ends, nothing at all") {
    std::vector<std::array<float, 9>> const tables = {{1, 1, 1, 1, 1, 1, 1, 1, 1},
                                                      {0, 1, 2, 3, 4, 5, 6, 7, 8},
                                                      {0, 0, 0, 5, 0, 0, 3, 0, 0},
                                                      {9, 0, 0, 0, 0, 0, 0, 0, 1e-3f},
                                                      {1e-30f, 2e-30f, 5e-30f, 1e-30f, 0, 1e-30f, 0, 0, 0},
                                                      {3, 1, 4, 1, 5, 9, 2, 6, 5}};
    double const alpha = sidak(static_cast<int>(tables.size()));
    int const n = samples(1'000'000, 4'000'000);
    std::uint64_t seed = 400;
    for (auto const& nodes : tables) {
        TabulatedDensity<8> const d(nodes);
        CHECK_FALSE(d.empty());
        Random r(seed++);
        std::vector<double> o(80), e(80);
        for (int i = 0; i < n; ++i) {
            float const u = r.unit();
            float const x = d.sample(u);
            REQUIRE((x >= 0 && x < 1));
            REQUIRE(d.pdf(x) > 0);
            ++o[static_cast<std::size_t>(std::min(79, static_cast<int>(x * 80)))];
            // Where the density is low, a float of x spans many u.
            if (i % 8 == 0) REQUIRE(std::abs(d.invert(x) - u) < 1e-6f + 4 * 0x1p-24f * d.pdf(x));
        }
        double total = 0;
        for (int k = 0; k < 80; ++k) {
            e[static_cast<std::size_t>(k)] =
                n * static_cast<double>(d.pdf((static_cast<float>(k) + 0.5f) / 80)) / 80;
            total += e[static_cast<std::size_t>(k)];
        }
        CHECK(total == doctest::Approx(n).epsilon(1e-5));
        ChiSquare const c = chi_square(o, e);
        INFO(c);
        CHECK(c.p >= alpha);
        for (float const u : {0.0f, 0x1p-32f, 0x1p-24f, 0.5f, 1 - 0x1p-24f}) {
            float const x = d.sample(u);
            CHECK((x >= 0 && x < 1));
            CHECK(d.pdf(x) > 0);
            CHECK(std::isfinite(d.pdf(x)));
        }
        for (int i = 0; i < 1000; ++i) {
            float const h = 1e-3f, u = h + (1 - 2 * h) * r.unit();
            float const x0 = d.sample(u - h), x1 = d.sample(u + h);
            if (static_cast<int>(x0 * 8) != static_cast<int>(x1 * 8)) continue;  // linear between nodes
            CHECK(static_cast<double>(d.pdf((x0 + x1) / 2)) *
                      (static_cast<double>(x1) - static_cast<double>(x0)) ==
                  doctest::Approx(2e-3).epsilon(1e-3));
        }
        CHECK(d.pdf(-0.1f) == 0);
        CHECK(d.pdf(1.1f) == 0);
    }
    CHECK(TabulatedDensity<8>().empty());
    CHECK(TabulatedDensity<8>(std::array<float, 9>{}).empty());
    CHECK(TabulatedDensity<8>(std::array<float, 9>{}).pdf(0.5f) == 0);
    CHECK(TabulatedDensity<2>({1, 3, 1}).integral() == 2);
}

TEST_CASE("bilinear: the inverse leads back, also from densities of nothing") {
    Random r(9);
    for (auto const& w :
         {std::array<float, 4>{1, 4, 0, 2}, {0, 0, 0, 1}, {0, 0, 0, 0}, {5, 5, 5, 5}, {0.01f, 1, 0.01f, 1}})
        for (int i = 0; i < 20'000; ++i) {
            Vec2 const u = random_square(r);
            Vec2 const p = sample_bilinear(u, w.data());
            Vec2 const back = invert_bilinear(p, w.data());
            float const pdf = std::max(1.0f, bilinear_pdf(p, w.data()));
            REQUIRE(std::abs(back.x - u.x) < 2e-6f * pdf);
            REQUIRE(std::abs(back.y - u.y) < 2e-6f * pdf);
        }
}
