// Transforms against hand values and against long double.
#include "math/transform.h"

#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

void check_equal(Mat4 const& a, Mat4 const& b, double tolerance = 1e-12) {
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            CAPTURE(i);
            CAPTURE(j);
            CHECK(std::abs(a.m[i][j] - b.m[i][j]) <= tolerance);
        }
}
std::array<double, 3> apply(Mat4 const& m, double x, double y, double z, double w = 1) {
    std::array<double, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = m.m[i][0] * x + m.m[i][1] * y + m.m[i][2] * z + m.m[i][3] * w;
    return r;
}
void check_point(std::array<double, 3> a, double x, double y, double z) {
    CHECK(a[0] == doctest::Approx(x).epsilon(1e-12));
    CHECK(a[1] == doctest::Approx(y).epsilon(1e-12));
    CHECK(a[2] == doctest::Approx(z).epsilon(1e-12));
}
Mat4 random_matrix(Random& r, double size, bool affine) {
    Mat4 m;
    for (std::size_t i = 0; i < (affine ? 3u : 4u); ++i)
        for (std::size_t j = 0; j < 4; ++j) m.m[i][j] = r.uniform(-size, size);
    return m;
}

}  // namespace

TEST_CASE("inverse") {
    Random r(1);
    for (int k = 0; k < 1000; ++k) {
        Mat4 const m = random_matrix(r, 10, k % 2 == 0);
        auto const inv = inverse(m);
        REQUIRE(inv);
        double size = 0;
        for (auto const& row : inv->m)
            for (double const x : row) size = std::max(size, std::abs(x));
        check_equal(m * *inv, Mat4{}, 1e-12 * (1 + size) * 10);
        check_equal(*inv * m, Mat4{}, 1e-12 * (1 + size) * 10);
    }
    Mat4 flat = scale(1, 0, 1);
    CHECK_FALSE(inverse(flat));
    flat = Mat4{};
    flat.m[2] = flat.m[1];
    CHECK_FALSE(inverse(flat));
    flat = Mat4{};
    flat.m[0][0] = NAN;
    CHECK_FALSE(inverse(flat));
    // Needs a pivot: zeros on the diagonal.
    Mat4 swap;
    swap.m = {{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}}};
    check_equal(*inverse(swap), swap);
    check_equal(*inverse(translate(1, 2, 3)), translate(-1, -2, -3));
    check_equal(*inverse(scale(2, -4, 8)), scale(0.5, -0.25, 0.125));
}

TEST_CASE("a product applies the right factor first") {
    check_point(apply(translate(1, 0, 0) * scale(2, 2, 2), 1, 1, 1), 3, 2, 2);
    check_point(apply(scale(2, 2, 2) * translate(1, 0, 0), 1, 1, 1), 4, 2, 2);
    check_equal(transpose(translate(1, 2, 3) * *rotate(30, 1, 2, 3)),
                transpose(*rotate(30, 1, 2, 3)) * transpose(translate(1, 2, 3)));
}

TEST_CASE("rotations are counter-clockwise seen from the axis' tip") {
    check_point(apply(*rotate(90, 0, 0, 1), 1, 0, 0), 0, 1, 0);
    check_point(apply(*rotate(90, 1, 0, 0), 0, 1, 0), 0, 0, 1);
    check_point(apply(*rotate(90, 0, 1, 0), 0, 0, 1), 1, 0, 0);
    check_point(apply(*rotate(120, 1, 1, 1), 1, 2, 3), 3, 1, 2);  // x -> y -> z -> x
    double const c = std::sqrt(0.75);
    check_point(apply(*rotate(30, 0, 0, 5), 1, 0, 7), c, 0.5, 7);
    CHECK_FALSE(rotate(30, 0, 0, 0));
    CHECK_FALSE(rotate(30, INFINITY, 0, 0));
    Random r(2);
    for (int k = 0; k < 200; ++k) {
        double const angle = r.uniform(-400, 400);
        double const x = r.uniform(-1, 1), y = r.uniform(-1, 1), z = r.uniform(-1, 1);
        Mat4 const m = *rotate(angle, x, y, z);
        check_equal(m * transpose(m), Mat4{});
        CHECK(determinant3(m) == doctest::Approx(1));
        check_equal(m * *rotate(-angle, x, y, z), Mat4{});
        check_point(apply(m, x, y, z), x, y, z);
    }
}

TEST_CASE("determinant and handedness") {
    CHECK(determinant3(scale(2, 3, 4)) == doctest::Approx(24));
    CHECK(determinant3(*rotate(50, 1, 2, 3) * scale(2, 3, -4)) == doctest::Approx(-24));
    CHECK(swaps_handedness(scale(-1, 1, 1)));
    CHECK_FALSE(swaps_handedness(scale(-1, -1, 1)));
    CHECK(swaps_handedness(scale(-1, -1, -1)));
    CHECK_FALSE(swaps_handedness(*rotate(170, 1, 2, 3)));
    CHECK(is_identity(Mat4{}));
    CHECK_FALSE(is_identity(translate(0, 0, 1e-9)));
    CHECK(is_affine(translate(1, 2, 3)));
    CHECK_FALSE(is_affine(perspective(60, 0.1, 10)));
}

TEST_CASE("look_at is pbrt's: a left-handed camera that looks along +z, y up") {
    // From (0,0,5) to the origin: the camera's x axis is up × dir = (0,1,0) × (0,0,-1) = (-1,0,0).
    auto const m = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    REQUIRE(m);
    check_point(apply(*m, 0, 0, 5), 0, 0, 0);
    check_point(apply(*m, 0, 0, 0), 0, 0, 5);
    check_point(apply(*m, 0, 1, 0), 0, 1, 5);
    check_point(apply(*m, 1, 0, 0), -1, 0, 5);
    // Looking along +x from (1,2,3), z up: right = z × x = y.
    auto const n = look_at({1, 2, 3}, {4, 2, 3}, {0, 0, 2});
    REQUIRE(n);
    check_point(apply(*n, 3, 2, 3), 0, 0, 2);
    check_point(apply(*n, 1, 3, 3), 1, 0, 0);
    check_point(apply(*n, 1, 2, 4), 0, 1, 0);
    // A slanting up vector is made perpendicular.
    auto const s = look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 5});
    REQUIRE(s);
    check_equal(*s, Mat4{});
    CHECK_FALSE(swaps_handedness(*s));
    CHECK_FALSE(look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0}));
    CHECK_FALSE(look_at({0, 0, 0}, {0, 2, 0}, {0, 1, 0}));
    CHECK_FALSE(look_at({0, 0, 0}, {0, 0, 1}, {0, 0, 0}));
}

TEST_CASE("perspective maps the field of view to [-1, 1] and near to 0, far to 1") {
    Mat4 const p = perspective(90, 1, 11);
    auto const project = [&](double x, double y, double z) {
        double const w = p.m[3][0] * x + p.m[3][1] * y + p.m[3][2] * z + p.m[3][3];
        auto const q = apply(p, x, y, z);
        return std::array<double, 3>{q[0] / w, q[1] / w, q[2] / w};
    };
    check_point(project(1, -1, 1), 1, -1, 0);
    check_point(project(11, 11, 11), 1, 1, 1);
    Mat4 const q = perspective(60, 1, 2);
    CHECK(q.m[0][0] == doctest::Approx(std::sqrt(3)));
}

TEST_CASE("make_transform carries the inverse, and refuses what has none") {
    Random r(3);
    for (int k = 0; k < 1000; ++k) {
        Mat4 const m = *rotate(r.uniform(0, 360), r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1)) *
                       scale(r.uniform(0.5, 2), r.uniform(-2, -0.5), r.uniform(0.5, 2)) *
                       translate(r.uniform(-3, 3), r.uniform(-3, 3), r.uniform(-3, 3));
        auto const t = make_transform(m);
        REQUIRE(t);
        Vec3 const p{r.unit(), r.unit(), r.unit()};
        Vec3 const q{r.unit() - 0.5f, r.unit() - 0.5f, r.unit() - 0.5f};
        CHECK(length(t->point_inverse(t->point(p)) - p) < 1e-5f);
        CHECK(length(t->vector_inverse(t->vector(p)) - p) < 1e-5f);
        CHECK(length(t->normal_inverse(t->normal(p)) - p) < 1e-5f);
        CHECK(length(t->point(p) - t->point(q) - t->vector(p - q)) < 1e-5f);
        // A normal stays perpendicular to what it was perpendicular to.
        CHECK(dot(t->normal(p), t->vector(q)) == doctest::Approx(dot(p, q)).epsilon(1e-4));
    }
    CHECK_FALSE(make_transform(scale(1, 1, 0)));
    CHECK_FALSE(make_transform(perspective(60, 0.1, 10)));
    CHECK_FALSE(make_transform(scale(1e-60, 1, 1)));
    CHECK_FALSE(make_transform(translate(1e60, 1, 1)));
    auto const t = make_transform(translate(1, 2, 3));
    CHECK(t->normal({0, 0, 1}) == Vec3{0, 0, 1});
    CHECK(t->vector({0, 0, 1}) == Vec3{0, 0, 1});
}

TEST_CASE("bounds of a transformed box hold its transformed points, and touch them") {
    Random r(4);
    for (int k = 0; k < 200; ++k) {
        auto const t = make_transform(random_matrix(r, 3, true));
        if (!t) continue;
        Bounds3 b;
        b.add(Vec3{-1, 0, 2});
        b.add(Vec3{2, 1, 3});
        Bounds3 const image = t->bounds(b);
        Bounds3 tight;
        for (int i = 0; i < 300; ++i) {
            Vec3 const p{static_cast<float>(r.uniform(-1, 2)), r.unit(), static_cast<float>(r.uniform(2, 3))};
            Vec3 const q = t->point(p);
            for (int a = 0; a < 3; ++a) CHECK((q[a] >= image.lo[a] - 1e-4f && q[a] <= image.hi[a] + 1e-4f));
        }
        for (int i = 0; i < 8; ++i) tight.add(t->point(b.corner(i)));
        CHECK(tight.lo == image.lo);
        CHECK(tight.hi == image.hi);
    }
    CHECK(Transform{}.bounds(Bounds3{}).empty());
}

TEST_CASE("bounds: growing, centre, sphere") {
    Bounds3 b;
    CHECK(b.empty());
    CHECK(bounding_sphere(b).radius == 0);
    b.add(Vec3{1, 2, 3});
    CHECK_FALSE(b.empty());
    CHECK(b.centre() == Vec3{1, 2, 3});
    b.add(Vec3{3, -2, 3});
    CHECK(b.diagonal() == Vec3{2, 4, 0});
    CHECK(bounding_sphere(b).centre == Vec3{2, 0, 3});
    CHECK(bounding_sphere(b).radius == doctest::Approx(std::sqrt(5)));
    Bounds3 c;
    c.add(Vec3{0, 0, 9});
    c.add(b);
    CHECK(c.lo == Vec3{0, -2, 3});
    CHECK(c.hi == Vec3{3, 2, 9});
}

TEST_CASE("point_error bounds the rounding error, against long double") {
    Random r(5);
    double tightest = 1e9;
    double greatest = 0;
    for (int k = 0; k < 200'000; ++k) {
        Transform t;
        double const size = std::exp(r.uniform(-8, 8));
        for (auto& row : t.m)
            for (float& x : row) x = static_cast<float>(r.uniform(-size, size));
        t.inv = t.m;
        double const far = std::exp(r.uniform(-8, 8));
        Vec3 const p{static_cast<float>(r.uniform(-far, far)), static_cast<float>(r.uniform(-far, far)),
                     static_cast<float>(r.uniform(-far, far))};
        Vec3 e{0, 0, 0};
        if (k % 2) e = abs(p) * static_cast<float>(r.uniform(0, 1e-5));
        Vec3 const q = t.point(p);
        Vec3 const bound = t.point_error(p, e);
        CHECK(t.point_inverse_error(p, e) == bound);
        // The exact point may lie anywhere in the box p +- e: take its worst corner, row by row.
        for (int i = 0; i < 3; ++i) {
            auto const& row = t.m[static_cast<std::size_t>(i)];
            long double exact = row[3];
            long double spread = 0;
            for (int j = 0; j < 3; ++j) {
                exact += static_cast<long double>(row[static_cast<std::size_t>(j)]) * p[j];
                spread += std::abs(static_cast<long double>(row[static_cast<std::size_t>(j)]) * e[j]);
            }
            long double const off = std::abs(static_cast<long double>(q[i]) - exact) + spread;
            greatest = std::max(greatest, static_cast<double>(off / bound[i]));
            tightest = std::min(tightest, static_cast<double>(bound[i] / (std::abs(exact) + 1e-30L)));
        }
    }
    CHECK(greatest <= 1);
    CHECK(greatest > 0.2);  // a bound that nothing comes near would push rays too far
    CHECK(tightest > 0);
}
