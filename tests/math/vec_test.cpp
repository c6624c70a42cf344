// Scalars, vectors and ray origins, against long double.
#include "math/vec.h"

#include "math/ray.h"
#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Vec3 random_vector(Random& r, double size) {
    return {static_cast<float>(r.uniform(-size, size)), static_cast<float>(r.uniform(-size, size)),
            static_cast<float>(r.uniform(-size, size))};
}
float ulp(long double x) {
    float const f = std::abs(static_cast<float>(x));
    return std::nextafter(f, kInfinity) - f;
}

}  // namespace

TEST_CASE("next_float_up and next_float_down") {
    CHECK(next_float_up(1.0f) == 0x1.000002p0f);
    CHECK(next_float_up(-1.0f) == -0x1.fffffep-1f);
    CHECK(next_float_up(0.0f) == std::numeric_limits<float>::denorm_min());
    CHECK(next_float_up(-0.0f) == std::numeric_limits<float>::denorm_min());
    CHECK(next_float_down(0.0f) == -std::numeric_limits<float>::denorm_min());
    CHECK(next_float_up(std::numeric_limits<float>::max()) == kInfinity);
    CHECK(next_float_up(kInfinity) == kInfinity);
    CHECK(next_float_up(-kInfinity) == std::numeric_limits<float>::lowest());
    CHECK(next_float_down(-kInfinity) == -kInfinity);
    Random r(1);
    for (int i = 0; i < 100'000; ++i) {
        auto const f = std::bit_cast<float>(static_cast<std::uint32_t>(r.bits()));
        if (std::isnan(f) || std::isinf(f)) continue;
        REQUIRE(next_float_up(f) == std::nextafter(f, kInfinity));
        REQUIRE(next_float_down(f) == std::nextafter(f, -kInfinity));
    }
}

TEST_CASE("difference_of_products does not cancel") {
    Random r(2);
    double worst = 0;
    double naive = 0;
    for (int i = 0; i < 200'000; ++i) {
        auto const a = static_cast<float>(r.uniform(0.5, 2));
        auto const b = static_cast<float>(r.uniform(0.5, 2));
        auto const c = static_cast<float>(a * (1 + r.uniform(-1e-6, 1e-6)));
        auto const d = static_cast<float>(b * (1 + r.uniform(-1e-6, 1e-6)));
        long double const exact =
            static_cast<long double>(a) * b - static_cast<long double>(c) * static_cast<long double>(d);
        if (exact == 0) {
            REQUIRE(difference_of_products(a, b, c, d) == 0);
            continue;
        }
        worst = std::max(
            worst, static_cast<double>(std::abs(difference_of_products(a, b, c, d) - exact) / ulp(exact)));
        naive = std::max(naive, static_cast<double>(std::abs(a * b - c * d - exact) / ulp(exact)));
    }
    CHECK(worst <= 1.5);
    CHECK(naive > 1000);  // the plain formula is hopeless on these numbers, so the test means something
    CHECK(difference_of_products(2, 3, 4, 5) == -14);
}

TEST_CASE("cross_accurate is the cross product, for nearly parallel vectors too") {
    CHECK(cross_accurate({1, 0, 0}, {0, 1, 0}) == Vec3{0, 0, 1});
    CHECK(cross_accurate({0, 1, 0}, {0, 0, 1}) == Vec3{1, 0, 0});
    CHECK(cross_accurate({0, 0, 1}, {1, 0, 0}) == Vec3{0, 1, 0});
    Random r(3);
    for (int i = 0; i < 10'000; ++i) {
        Vec3 const a = random_vector(r, 2);
        Vec3 const b = i % 2 ? random_vector(r, 2) : a + random_vector(r, 1e-5);
        Vec3 const c = cross_accurate(a, b);
        for (int k = 0; k < 3; ++k) {
            int const x = (k + 1) % 3, y = (k + 2) % 3;
            long double const exact =
                static_cast<long double>(a[x]) * b[y] - static_cast<long double>(a[y]) * b[x];
            CHECK(std::abs(c[k] - exact) <= 1.5 * ulp(exact));
        }
    }
}

TEST_CASE("angle_between is accurate near 0 and pi") {
    Random r(4);
    for (int i = 0; i < 20'000; ++i) {
        // A pair at a known small angle, in a plane spanned by exact unit axes.
        double const t = std::exp(r.uniform(-12, 0.4));
        Vec3 const a{1, 0, 0};
        Vec3 const b{static_cast<float>(std::cos(t)), static_cast<float>(std::sin(t)), 0};
        CHECK(angle_between(a, b) == doctest::Approx(t).epsilon(1e-6));
        CHECK(angle_between(b, a) == doctest::Approx(t).epsilon(1e-6));
        CHECK(angle_between(a, -b) == doctest::Approx(3.14159265358979 - t).epsilon(3e-7));
    }
    CHECK(angle_between({0, 0, 1}, {0, 0, 1}) == 0);
    CHECK(angle_between({0, 0, 1}, {0, 0, -1}) == doctest::Approx(3.14159265));
    CHECK(angle_between({0, 0, 1}, {0, 1, 0}) == doctest::Approx(1.57079633));
}

TEST_CASE("gamma_bound covers n roundings") {
    for (int n = 1; n < 30; ++n) {
        long double const exact = std::pow(1 + 0x1p-24L, n) - 1;
        CHECK(gamma_bound(n) >= exact);
        CHECK(gamma_bound(n) <= exact * 1.001L);
    }
}

TEST_CASE("small helpers") {
    CHECK(radians(180) == doctest::Approx(3.14159265));
    CHECK(degrees(radians(33)) == doctest::Approx(33));
    CHECK(safe_sqrt(-1e-9f) == 0);
    CHECK(safe_sqrt(4) == 2);
    CHECK(nephroid::lerp(0, 3.0f, 5.0f) == 3);
    CHECK(nephroid::lerp(1, 3.0f, 5.0f) == 5);
    CHECK(nephroid::lerp(0.25f, 4.0f, 8.0f) == 5);
    CHECK(nephroid::clamp(5.0f, 0.0f, 1.0f) == 1);
    CHECK(nephroid::clamp(-5.0f, 0.0f, 1.0f) == 0);
    CHECK(kOneMinusEpsilon < 1.0f);
    CHECK(next_float_up(kOneMinusEpsilon) == 1.0f);
    CHECK(face_forward({0, 0, 1}, {1, 0, -1}) == Vec3{0, 0, -1});
    CHECK(face_forward({0, 0, 1}, {1, 0, 1}) == Vec3{0, 0, 1});
    CHECK(max_component({1, 5, 2}) == 5);
    CHECK(is_finite(Vec3{1, 2, 3}));
    CHECK_FALSE(is_finite(Vec3{1, kInfinity, 3}));
    CHECK_FALSE(is_finite(Vec3{1, 2, NAN}));
    CHECK(distance_squared({1, 2, 3}, {2, 4, 5}) == 9);
}

TEST_CASE("a ray's origin is moved off its surface, to the side that it goes to, by no more than needed") {
    Random r(5);
    for (int i = 0; i < 200'000; ++i) {
        double const size = std::exp(r.uniform(-10, 10));
        Vec3 const p = random_vector(r, size);
        Vec3 n = random_vector(r, 1);
        if (i % 7 == 0) n = Vec3{0, 0, 0}, n[i % 3] = i % 2 ? 1.0f : -1.0f;
        n = normalize(n);
        Vec3 const e = abs(p) * static_cast<float>(r.uniform(1e-7, 1e-5));
        Vec3 const w = random_vector(r, 1);
        Vec3 const o = offset_ray_origin(p, e, n, w);
        double along = 0;
        double bound = 0;
        double rounding = 0;
        for (int k = 0; k < 3; ++k) {
            along += (static_cast<double>(o[k]) - p[k]) * n[k];
            bound += std::abs(static_cast<double>(n[k])) * e[k];
            rounding +=
                std::abs(static_cast<double>(n[k])) * 2 * ulp(static_cast<long double>(std::abs(p[k])));
        }
        if (dot(w, n) < 0) along = -along;
        // Farther along the normal than any point of the error box p +- e, and not by much.
        REQUIRE(along >= bound * (1 - 1e-6));
        REQUIRE(along <= bound * (1 + 1e-6) + 2 * rounding);
    }
}

TEST_CASE("offsets scale with the scene") {
    Random r(6);
    for (int i = 0; i < 1000; ++i) {
        Vec3 const p = random_vector(r, 1);
        Vec3 const n = normalize(random_vector(r, 1));
        Vec3 const w = random_vector(r, 1);
        Vec3 const e = abs(p) * 1e-6f;
        CHECK(offset_ray_origin(p * 1024.0f, e * 1024.0f, n, w) == offset_ray_origin(p, e, n, w) * 1024.0f);
    }
}
