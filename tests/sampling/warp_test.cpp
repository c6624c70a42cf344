// Warps: chi square against their densities, inverses, and the ends of the unit interval.
#include "sampling/warp.h"

#include "statistics.h"

#include <doctest/doctest.h>

#include <functional>
#include <string>

using namespace nephroid;
using namespace nephroid::test;

namespace {

float const kExtremes[] = {0.0f, 0x1p-32f, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f};

Vec2 random_square(Random& r) {
    float const x = r.unit();
    return {x, r.unit()};
}

/// Samples on the sphere, in cells of equal solid angle, against a density by solid angle integrated over each cell.
ChiSquare sphere_chi_square(std::function<Vec3(Vec2)> const& warp, std::function<double(Vec3)> const& pdf,
                            int n, std::uint64_t seed) {
    constexpr int kZ = 40, kPhi = 40, kSub = 8;
    std::vector<double> o(kZ * kPhi), e(kZ * kPhi);
    Random r(seed);
    for (int i = 0; i < n; ++i) {
        Vec3 const w = warp(random_square(r));
        int const z = std::clamp(static_cast<int>((static_cast<double>(w.z) + 1) / 2 * kZ), 0, kZ - 1);
        double const phi = std::atan2(w.y, w.x) / (2 * kPiD) + 0.5;
        ++o[static_cast<std::size_t>(z * kPhi + std::clamp(static_cast<int>(phi * kPhi), 0, kPhi - 1))];
    }
    for (int z = 0; z < kZ; ++z)
        for (int k = 0; k < kPhi; ++k) {
            double sum = 0;
            for (int a = 0; a < kSub; ++a)
                for (int b = 0; b < kSub; ++b) {
                    double const c = (z + (a + 0.5) / kSub) / kZ * 2 - 1;
                    double const phi = ((k + (b + 0.5) / kSub) / kPhi - 0.5) * 2 * kPiD;
                    double const s = std::sqrt(1 - c * c);
                    sum += pdf({static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                                static_cast<float>(c)});
                }
            e[static_cast<std::size_t>(z * kPhi + k)] = n * sum / (kSub * kSub) * 4 * kPiD / (kZ * kPhi);
        }
    // The density must integrate to 1 by itself: the total is not scaled.
    return chi_square(o, e);
}

/// Samples of the unit square against a density on it, by 32 x 32 cells.
ChiSquare square_chi_square(std::function<Vec2(Vec2)> const& warp, std::function<double(Vec2)> const& pdf,
                            int n, std::uint64_t seed) {
    constexpr int kN = 32, kSub = 8;
    std::vector<double> o(kN * kN), e(kN * kN);
    Random r(seed);
    for (int i = 0; i < n; ++i) {
        Vec2 const p = warp(random_square(r));
        int const x = std::clamp(static_cast<int>(p.x * kN), 0, kN - 1);
        int const y = std::clamp(static_cast<int>(p.y * kN), 0, kN - 1);
        ++o[static_cast<std::size_t>(y * kN + x)];
    }
    for (int y = 0; y < kN; ++y)
        for (int x = 0; x < kN; ++x)
            for (int b = 0; b < kSub; ++b)
                for (int a = 0; a < kSub; ++a)
                    e[static_cast<std::size_t>(y * kN + x)] +=
                        n *
                        pdf({static_cast<float>((x + (a + 0.5) / kSub) / kN),
                             static_cast<float>((y + (b + 0.5) / kSub) / kN)}) /
                        (kSub * kSub * kN * kN);
    return chi_square(o, e);
}

double sum(std::vector<double> const& v) {
    double s = 0;
    for (double const x : v) s += x;
    return s;
}

}  // namespace

TEST_CASE("sphere, hemispheres and cones are drawn from their densities") {
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(5);
    auto const sphere = sphere_chi_square(
        square_to_uniform_sphere, [](Vec3) { return kUniformSpherePdf; }, n, 1);
    INFO("sphere ", sphere);
    CHECK(sphere.p >= alpha);
    auto const hemisphere = sphere_chi_square(
        square_to_uniform_hemisphere, [](Vec3 w) { return w.z > 0 ? kUniformHemispherePdf : 0; }, n, 2);
    INFO("hemisphere ", hemisphere);
    CHECK(hemisphere.p >= alpha);
    auto const cosine = sphere_chi_square(
        square_to_cosine_hemisphere, [](Vec3 w) { return cosine_hemisphere_pdf(w.z); }, n, 3);
    INFO("cosine ", cosine);
    CHECK(cosine.p >= alpha);
    auto const cone = sphere_chi_square([](Vec2 u) { return square_to_uniform_cone(u, 0.4f); },
                                        [](Vec3 w) { return w.z > 0.6f ? uniform_cone_pdf(0.4f) : 0; }, n, 4);
    INFO("cone ", cone);
    CHECK(cone.p >= alpha);
    auto const area = sphere_chi_square(
        equal_area_square_to_sphere, [](Vec3) { return kUniformSpherePdf; }, n, 5);
    INFO("equal area ", area);
    CHECK(area.p >= alpha);
    // Control: the wrong density is noticed.
    CHECK(sphere_chi_square(
              square_to_cosine_hemisphere, [](Vec3 w) { return w.z > 0 ? kUniformHemispherePdf : 0; }, n, 3)
              .p < 1e-9);
}

TEST_CASE("a small cone stays exact") {
    for (float const one_minus_cos : {1e-12f, 1e-7f, 1e-3f, 1.0f, 2.0f}) {
        Random r(6);
        Mean mean;
        for (int i = 0; i < 100'000; ++i) {
            Vec3 const w = square_to_uniform_cone(random_square(r), one_minus_cos);
            double const r2 = static_cast<double>(w.x) * w.x + static_cast<double>(w.y) * w.y;
            // 1 - z by the sine, where z itself rounds to 1.
            double const drop = one_minus_cos < 0.01f ? r2 / 2 : 1 - static_cast<double>(w.z);
            REQUIRE(drop <= static_cast<double>(one_minus_cos) * (1 + 1e-3) + 1e-20);
            mean.add(drop);
        }
        auto const a = agrees(mean, one_minus_cos / 2.0, 0.01, sidak(5));
        INFO(a);
        CHECK(a);
        CHECK(uniform_cone_pdf(one_minus_cos) * 2 * kPiD * static_cast<double>(one_minus_cos) ==
              doctest::Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("the disk is filled evenly") {
    int const n = samples(1'000'000, 4'000'000);
    std::vector<double> o(32 * 64);
    Random r(7);
    for (int i = 0; i < n; ++i) {
        Vec2 const d = square_to_disk(random_square(r));
        double const r2 = static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y;
        REQUIRE(r2 <= 1 + 1e-6);
        double const phi = std::atan2(d.y, d.x) / (2 * kPiD) + 0.5;
        ++o[static_cast<std::size_t>(std::min(31, static_cast<int>(r2 * 32)) * 64 +
                                     std::min(63, static_cast<int>(phi * 64)))];
    }
    auto const c = chi_square(o, std::vector<double>(o.size(), n / static_cast<double>(o.size())));
    INFO(c);
    CHECK(c.p >= 0.01);
    CHECK(kDiskPdf * kPiD == doctest::Approx(1));
}

TEST_CASE("the triangle is filled evenly") {
    int const n = samples(1'000'000, 4'000'000);
    std::vector<double> o(20 * 20 * 2);
    Random r(8);
    for (int i = 0; i < n; ++i) {
        Vec2 const b = square_to_triangle(random_square(r));
        REQUIRE((b.x >= 0 && b.y >= 0 && b.x + b.y <= 1));
        // Small congruent triangles: lower and upper ones in a 20 x 20 grid.
        int const x = std::min(19, static_cast<int>(b.x * 20)), y = std::min(19, static_cast<int>(b.y * 20));
        bool const upper = b.x * 20 - static_cast<float>(x) + b.y * 20 - static_cast<float>(y) > 1;
        ++o[static_cast<std::size_t>((y * 20 + x) * 2 + upper)];
    }
    std::vector<double> e(o.size());
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
            for (int u = 0; u < 2; ++u)
                e[static_cast<std::size_t>((y * 20 + x) * 2 + u)] = x + y + u <= 19 ? n / 400.0 : 0;
    // Rounding may put a point on the hypotenuse into the cell beyond.
    for (std::size_t i = 0; i < o.size(); ++i)
        if (e[i] == 0) {
            CHECK(o[i] <= 3);
            o[i] = 0;
        }
    CHECK(sum(e) == doctest::Approx(n));
    auto const c = chi_square(o, e);
    INFO(c);
    CHECK(c.p >= 0.01);
}

TEST_CASE("inverses lead back") {
    Random r(9);
    for (int i = 0; i < 100'000; ++i) {
        Vec2 const u = random_square(r);
        auto const near = [&](Vec2 v, float tolerance) {
            return std::abs(v.x - u.x) < tolerance && std::abs(v.y - u.y) < tolerance;
        };
        REQUIRE(near(disk_to_square(square_to_disk(u)), 2e-6f));
        REQUIRE(near(cosine_hemisphere_to_square(square_to_cosine_hemisphere(u)), 2e-6f));
        REQUIRE(near(triangle_to_square(square_to_triangle(u)), 1e-6f));
    }
    for (float const x : kExtremes)
        for (float const y : kExtremes) {
            Vec2 const back = disk_to_square(square_to_disk({x, y}));
            CHECK((back.x >= 0 && back.x < 1 && back.y >= 0 && back.y < 1));
        }
}

TEST_CASE("equal-area square: round trip, areas, poles") {
    Random r(10);
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) {
        Vec2 const u = random_square(r);
        Vec3 const d = equal_area_square_to_sphere(u);
        REQUIRE(std::abs(length(d) - 1) < 1e-6f);
        Vec2 const back = equal_area_sphere_to_square(d);
        // Near the poles and the fold the square is steep: compare on the sphere, and in the square away from them.
        worst = std::max(worst, static_cast<double>(angle_between(equal_area_square_to_sphere(back), d)));
        if (std::abs(d.z) < 0.99f && std::abs(u.x - 0.5f) > 1e-3f && std::abs(u.y - 0.5f) > 1e-3f)
            REQUIRE((std::abs(back.x - u.x) < 2e-6f && std::abs(back.y - u.y) < 2e-6f));
    }
    CHECK(worst < 1.5e-3);  // acos-like loss near the poles: sqrt of a float's rounding
    CHECK(equal_area_square_to_sphere({0.5f, 0.5f}).z == 1);
    for (Vec2 const corner : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}})
        CHECK(equal_area_square_to_sphere(corner).z == -1);
    // The equator is the inner diamond: its corners are the axes, as pbrt-v4 has them.
    CHECK(length(equal_area_square_to_sphere({1.0f, 0.5f}) - Vec3{1, 0, 0}) < 1e-6f);
    CHECK(length(equal_area_square_to_sphere({0.5f, 1.0f}) - Vec3{0, 1, 0}) < 1e-6f);
    CHECK(length(equal_area_square_to_sphere({0.0f, 0.5f}) - Vec3{-1, 0, 0}) < 1e-6f);
    // Equal areas by the Jacobian, everywhere.
    for (int i = 0; i < 2000; ++i) {
        Vec2 const u{0.02f + 0.96f * r.unit(), 0.02f + 0.96f * r.unit()};
        float const h = 2e-3f;
        float const a = std::abs(u.x - 0.5f), b = std::abs(u.y - 0.5f);
        if (a < 0.02f || b < 0.02f || std::abs(a + b - 0.5f) < 0.02f) continue;  // folds
        Vec3 const du =
            equal_area_square_to_sphere({u.x + h, u.y}) - equal_area_square_to_sphere({u.x - h, u.y});
        Vec3 const dv =
            equal_area_square_to_sphere({u.x, u.y + h}) - equal_area_square_to_sphere({u.x, u.y - h});
        double const element = static_cast<double>(length(cross(du, dv))) / (4.0 * h * h);
        CHECK(element == doctest::Approx(4 * kPiD).epsilon(5e-3));
    }
}

TEST_CASE("equal-area square: directions go on across its edges") {
    Random r(11);
    for (int i = 0; i < 10'000; ++i) {
        float const t = r.unit();
        float const e = 1e-3f * r.unit();
        for (Vec2 const out : {Vec2{-e, t}, Vec2{1 + e, t}, Vec2{t, -e}, Vec2{t, 1 + e}}) {
            Vec2 const in = wrap_equal_area_square(out);
            REQUIRE((in.x >= 0 && in.x <= 1 && in.y >= 0 && in.y <= 1));
            Vec2 const edge{nephroid::clamp(out.x, 0, 1), nephroid::clamp(out.y, 0, 1)};
            // Both lie within a step of the edge: no jump.
            CHECK(angle_between(equal_area_square_to_sphere(in), equal_area_square_to_sphere(edge)) < 0.02f);
        }
        CHECK(wrap_equal_area_square({t, e}) == Vec2{t, e});
    }
    // Out over a corner and back: two folds.
    Vec2 const c = wrap_equal_area_square({-0.1f, -0.2f});
    CHECK(c.x == doctest::Approx(0.9));
    CHECK(c.y == doctest::Approx(0.8));
}

TEST_CASE("linear, tent and bilinear densities") {
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(6);
    for (auto const& [a, b] : {std::pair{1.0f, 3.0f}, {2.0f, 0.0f}, {0.0f, 1.0f}, {5.0f, 5.0f}}) {
        auto const c = square_chi_square(
            [&](Vec2 u) {
                return Vec2{sample_linear(u.x, a, b), u.y};
            },
            [&](Vec2 p) { return linear_pdf(p.x, a, b); }, n, 12);
        INFO(a, " to ", b, ": ", c);
        CHECK(c.p >= alpha);
    }
    // The tent of half-width 2, seen over [-2, 2].
    auto const tent = square_chi_square(
        [](Vec2 u) {
            return Vec2{sample_tent(u.x, 2) / 4 + 0.5f, u.y};
        },
        [](Vec2 p) { return 4 * tent_pdf((p.x - 0.5f) * 4, 2); }, n, 13);
    INFO("tent ", tent);
    CHECK(tent.p >= alpha);
    float const w[4] = {1, 4, 0, 2};
    auto const bilinear = square_chi_square([&](Vec2 u) { return sample_bilinear(u, w); },
                                            [&](Vec2 p) { return bilinear_pdf(p, w); }, n, 14);
    INFO("bilinear ", bilinear);
    CHECK(bilinear.p >= alpha);
    CHECK(linear_pdf(-0.1f, 1, 2) == 0);
    CHECK(linear_pdf(1.1f, 1, 2) == 0);
    CHECK(tent_pdf(2.5f, 2) == 0);
    CHECK(tent_pdf(0, 2) == 0.5f);
    CHECK(bilinear_pdf({0.5f, 1.5f}, w) == 0);
}

TEST_CASE("densities of nothing at all are uniform, not NaN") {
    float const none[4] = {0, 0, 0, 0};
    for (float const x : {0.0f, 0.3f, 0.9f}) {
        CHECK(sample_linear(x, 0, 0) == doctest::Approx(x));
        CHECK(linear_pdf(x, 0, 0) == 1);
        for (float const y : {0.0f, 0.3f, 0.9f}) {
            CHECK(sample_bilinear({x, y}, none).x == doctest::Approx(x));
            CHECK(sample_bilinear({x, y}, none).y == doctest::Approx(y));
            CHECK(bilinear_pdf({x, y}, none) == 1);
        }
    }
}

TEST_CASE("densities are Jacobians: linear and bilinear by finite differences") {
    Random r(15);
    float const w[4] = {1, 4, 0.5f, 2};
    for (int i = 0; i < 1000; ++i) {
        double const h = 1e-2;
        float const u = 0.02f + 0.96f * r.unit();
        float const x0 = sample_linear(u - static_cast<float>(h), 1, 3),
                    x1 = sample_linear(u + static_cast<float>(h), 1, 3);
        // The mean density between the two points is what lies between them.
        double const density = 2 * h / (static_cast<double>(x1) - x0);
        CHECK(linear_pdf((x0 + x1) / 2, 1, 3) == doctest::Approx(density).epsilon(1e-4));
        Vec2 const v{0.05f + 0.9f * r.unit(), 0.05f + 0.9f * r.unit()};
        auto const f = [&](float a, float b) { return sample_bilinear({v.x + a, v.y + b}, w); };
        auto const k = 5e-3f;
        Vec2 const du = f(k, 0) - f(-k, 0), dv = f(0, k) - f(0, -k);
        double const element =
            std::abs(static_cast<double>(du.x) * dv.y - static_cast<double>(du.y) * dv.x) / (4.0 * k * k);
        CHECK(bilinear_pdf(f(0, 0), w) * element == doctest::Approx(1).epsilon(1e-3));
    }
}

TEST_CASE("the ends of the unit interval give finite points inside") {
    float const w[4] = {1, 4, 0, 2};
    for (float const x : kExtremes)
        for (float const y : kExtremes) {
            CAPTURE(x);
            CAPTURE(y);
            Vec2 const u{x, y};
            Vec2 const d = square_to_disk(u);
            CHECK(length(Vec3{d.x, d.y, 0}) <= 1 + 1e-6f);
            for (Vec3 const v : {square_to_cosine_hemisphere(u), square_to_uniform_hemisphere(u),
                                 square_to_uniform_sphere(u), square_to_uniform_cone(u, 0.01f),
                                 square_to_uniform_cone(u, 1e-10f), equal_area_square_to_sphere(u)})
                CHECK(std::abs(length(v) - 1) < 1e-6f);
            CHECK(square_to_cosine_hemisphere(u).z >= 0);
            CHECK(square_to_uniform_hemisphere(u).z >= 0);
            Vec2 const t = square_to_triangle(u);
            CHECK((t.x >= 0 && t.y >= 0 && t.x + t.y <= 1));
            for (float const v : {sample_linear(x, 0, 1), sample_linear(x, 1, 0), sample_linear(x, 1, 1),
                                  sample_bilinear(u, w).x, sample_bilinear(u, w).y})
                CHECK((v >= 0 && v < 1));
            CHECK(std::abs(sample_tent(x, 2)) <= 2);
            Vec2 const e = equal_area_sphere_to_square(equal_area_square_to_sphere(u));
            CHECK((e.x >= 0 && e.x <= 1 && e.y >= 0 && e.y <= 1));
        }
    for (Vec3 const axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{-1, 0, -0.0f}})
        CHECK(length(equal_area_square_to_sphere(equal_area_sphere_to_square(axis)) - axis) < 1e-6f);
}

TEST_CASE("heuristics share one whole between two strategies") {
    Random r(16);
    for (int i = 0; i < 1000; ++i) {
        auto const f = static_cast<float>(std::exp(r.uniform(-10, 10)));
        auto const g = static_cast<float>(std::exp(r.uniform(-10, 10)));
        CHECK(balance_heuristic(f, g) + balance_heuristic(g, f) == doctest::Approx(1));
        CHECK(power_heuristic(f, g) + power_heuristic(g, f) == doctest::Approx(1));
    }
    CHECK(balance_heuristic(3, 1) == 0.75f);
    CHECK(power_heuristic(3, 1) == doctest::Approx(0.9));
    CHECK(power_heuristic(1, 0) == 1);
    CHECK(power_heuristic(1e30f, 1) == 1);
    CHECK(power_heuristic(1, 1e30f) == 0);
}
