// Perlin's noise against its definition, and sums of octaves against sums of it.
#include "model/noise.h"

#include "support.h"

#include <doctest/doctest.h>

#include <map>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Vec3 random_point(Random& r, double size) {
    Vec3 p;
    for (int i = 0; i < 3; ++i) p[i] = static_cast<float>(r.uniform(-size, size));
    return p;
}

/// The gradient at a lattice point, measured: near it the noise is a plane to within the square of the distance.
Vec3 measured_gradient(Vec3 lattice) {
    constexpr float kStep = 1.0f / 256;
    Vec3 g;
    for (int i = 0; i < 3; ++i) {
        Vec3 d{0};
        d[i] = kStep;
        g[i] = (perlin_noise(lattice + d) - perlin_noise(lattice - d)) / (2 * kStep);
    }
    return g;
}

Octaves at(Vec3 p, int count, float roughness = 0.5f) { return {p, {}, {}, roughness, count}; }

}  // namespace

TEST_CASE("noise is Perlin's: a published value, zeros on the lattice, twelve gradients, a period of 256") {
    // Of Perlin's reference implementation in Java, by several who ported it.
    CHECK(perlin_noise({3.14f, 42, 7}) == doctest::Approx(0.13691995878).epsilon(1e-5));
    Random r(1);
    std::map<std::array<int, 3>, int> seen;
    for (int i = 0; i < 4000; ++i) {
        Vec3 const lattice = glm::floor(random_point(r, 300));
        CHECK(perlin_noise(lattice) == 0);
        Vec3 const g = measured_gradient(lattice);
        Vec3 const whole = glm::round(g);
        CHECK(length(g - whole) < 0.02f);
        CHECK(length_squared(whole) == 2);  // towards the middle of a cube's edge
        ++seen[{static_cast<int>(whole.x), static_cast<int>(whole.y), static_cast<int>(whole.z)}];
        Vec3 const p = random_point(r, 100), shift = 256.0f * glm::floor(random_point(r, 3));
        CHECK(perlin_noise(p + shift) == doctest::Approx(perlin_noise(p)).epsilon(1e-3).scale(0.2));
    }
    CHECK(seen.size() == 12);
}

TEST_CASE("inside a cell, noise is the planes of its corners under quintic weights") {
    Random r(2);
    auto const weight = [](double t) { return ((6 * t - 15) * t + 10) * t * t * t; };
    for (int i = 0; i < 1000; ++i) {
        Vec3 const cell = glm::floor(random_point(r, 50));
        Vec3 const d{r.unit(), r.unit(), r.unit()};
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            Vec3 const offset{static_cast<float>(corner & 1), static_cast<float>(corner >> 1 & 1),
                              static_cast<float>(corner >> 2)};
            double w = 1;
            for (int k = 0; k < 3; ++k) {
                double const t = weight(static_cast<double>(d[k]));
                w *= offset[k] > 0 ? t : 1 - t;
            }
            sum += w * static_cast<double>(dot(glm::round(measured_gradient(cell + offset)), d - offset));
        }
        CHECK(std::abs(static_cast<double>(perlin_noise(cell + d)) - sum) < 1e-4);
    }
}

TEST_CASE("noise is smooth over the cells' faces, within its range, and has mean 0") {
    Random r(3);
    double sum = 0, sum_abs = 0, most = 0;
    int const n = samples(200'000, 2'000'000);
    for (int i = 0; i < n; ++i) {
        double const v = static_cast<double>(perlin_noise(random_point(r, 120)));
        sum += v;
        sum_abs += std::abs(v);
        most = std::max(most, std::abs(v));
    }
    CHECK(most <= 1);
    CHECK(most > 0.8);
    CHECK(std::abs(sum / n) < 3e-3);
    MESSAGE("mean of |noise|: ", sum_abs / n, " (turbulence takes 0.2 for it)");
    CHECK(std::abs(sum_abs / n - 0.2) < 0.03);
    for (int i = 0; i < 2000; ++i) {
        Vec3 p = random_point(r, 60);
        int const axis = i % 3;
        p[axis] = std::floor(p[axis]);
        Vec3 d{0};
        d[axis] = 1.0f / 256;
        float const before = (perlin_noise(p) - perlin_noise(p - d)) * 256,
                    after = (perlin_noise(p + d) - perlin_noise(p)) * 256;
        CHECK(std::abs(before - after) < 0.02f);
    }
}

TEST_CASE("noise of anything is a number") {
    for (float const x : {1e9f, -1e10f, 3e30f, 1e38f, kInfinity, -kInfinity, std::nanf("")})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 p{0.3f, 0.4f, 0.5f};
            p[axis] = x;
            CHECK(std::isfinite(perlin_noise(p)));
            CHECK(std::isfinite(fbm(at(p, 64, 2))));
            CHECK(std::isfinite(turbulence(at(p, 64, 1))));
        }
    Octaves broken = at({0.3f, 0.4f, 0.5f}, 8);
    for (float const x : {std::nanf(""), kInfinity, 1e30f, 1e-40f}) {
        broken.dpdx = Vec3{x};
        CHECK(std::isfinite(fbm(broken)));
        CHECK(std::isfinite(turbulence(broken)));
    }
}

TEST_CASE("octaves are sums of noise, each 1.99 times as fine and weaker by the roughness") {
    Random r(4);
    for (int i = 0; i < 300; ++i) {
        Vec3 const p = random_point(r, 5);
        float const roughness = static_cast<float>(r.uniform(0.2, 0.8));
        int const count = static_cast<int>(r.below(7));
        double sum = 0, sum_abs = 0, height = 1;
        float frequency = 1;
        for (int k = 0; k < count; ++k) {
            double const v = static_cast<double>(perlin_noise(frequency * p));
            sum += height * v;
            sum_abs += height * std::abs(v);
            frequency *= 1.99f;
            height *= static_cast<double>(roughness);
        }
        CHECK(static_cast<double>(fbm(at(p, count, roughness))) == doctest::Approx(sum).epsilon(1e-4));
        // pbrt-v4 adds one mean of the octave that is not there.
        CHECK(static_cast<double>(turbulence(at(p, count, roughness))) ==
              doctest::Approx(sum_abs + 0.2 * height).epsilon(1e-4));
    }
}

TEST_CASE("a footprint takes the fine octaves away") {
    Random r(5);
    for (int i = 0; i < 300; ++i) {
        Octaves o = at(random_point(r, 5), 8);
        // Of length 2^-(m+1): exactly m octaves are left, whichever axis of the pixel is the longer.
        for (int m = 0; m < 8; ++m) {
            Vec3 const d = random_direction(r) * std::ldexp(1.0f, -m - 1);
            o.dpdx = i % 2 ? d : 0.5f * d;
            o.dpdy = i % 2 ? Vec3{0} : d;
            CHECK(fbm(o) == doctest::Approx(fbm(at(o.p, m))).epsilon(2e-3).scale(1));
        }
        for (float const wide : {0.5f, 1.0f, 100.0f}) {
            o.dpdx = Vec3{wide, 0, 0}, o.dpdy = Vec3{0};
            CHECK(fbm(o) == 0);
            // 0.2 (1 + 1 + 1/2 + ... + 1/128)
            CHECK(turbulence(o) == doctest::Approx(0.2 * (3 - 1.0 / 128)));
        }
    }
    // In between an octave fades in without a jump, but for the mean that pbrt-v4's turbulence counts twice: half of it goes
    // where one octave more is shown.
    Octaves o = at({1.3f, 2.7f, 0.4f}, 8);
    float last = fbm(o), last_turbulence = turbulence(o);
    for (double length = 1e-4; length < 2; length *= 1.002) {
        o.dpdx = Vec3{0, static_cast<float>(length), 0};
        CHECK(std::abs(fbm(o) - last) < 0.02f);
        CHECK(std::abs(turbulence(o) - last_turbulence) < 0.5f * 0.2f + 0.01f);
        last = fbm(o), last_turbulence = turbulence(o);
    }
}
