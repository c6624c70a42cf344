// Renders small films in independent batches, and holds their means against closed forms.
#pragma once

#include "statistics.h"
#include "transport/render_pass.h"

#include <doctest/doctest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::test {

/// Rgb unless said otherwise, a film of nx x ny pixels, each of which integrates over itself.
inline Settings settings(Integrator integrator, int nx = 2, int ny = 2) {
    Settings s;
    s.filter = BoxFilter{};
    s.integrator = integrator;
    s.color = ColorMode::Rgb;
    s.film.resolution = {nx, ny};
    return s;
}
/// The same with pixels that look at their centres alone.
inline Settings point_settings(Integrator integrator, int nx = 2, int ny = 2) {
    Settings s = settings(integrator, nx, ny);
    s.filter = BoxFilter{{1e-4f, 1e-4f}};
    return s;
}
inline PathIntegrator path(int max_depth, RouletteKind roulette = RouletteKind::None, float alpha = 0.5f) {
    PathIntegrator p;
    p.max_depth = max_depth;
    p.roulette = {roulette, alpha};
    return p;
}
inline PathIntegrator naive(PathIntegrator p) {
    p.sample_lights = false;
    return p;
}
inline PathIntegrator without_mis(PathIntegrator p) {
    p.sample_bsdf_mis = false;
    return p;
}
inline PathIntegrator uniform_hemisphere(PathIntegrator p) {
    p.hemisphere = HemisphereSampling::Uniform;
    return p;
}

inline std::vector<Integrator> one_bounce() {
    return {DirectIntegrator{1}, path(1), naive(path(1)), without_mis(path(1)), uniform_hemisphere(path(1)),
            WhittedIntegrator{1}};
}

constexpr int kBatches = 32;
using Means = std::vector<std::array<Mean, 3>>;

/// 32 films with scrambles of their own. One entry per pixel, or one for the whole film.
inline Means measure(World const& world, Settings s, std::uint64_t passes, bool per_pixel = false,
                     std::uint64_t first_seed = 1) {
    int const nx = s.film.resolution.x;
    int const ny = s.film.resolution.y;
    auto const pixels = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
    Means means(per_pixel ? pixels : 1);
    RayStats stats;
    for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
        s.seed = first_seed * 1000 + batch;
        RenderJob const job(world, s);
        Film film = job.make_film();
        std::uint64_t dropped = 0;
        auto const add = [&](PassWork const& work, PassRange range) {
            return TileRenderer(job, work, film, stats).add({0, nx, 0, ny}, range);
        };
        if (job.prepares())
            for (std::uint64_t i = 0; i < passes; ++i) dropped += add(*prepare_pass(job, i, {}), {i, i + 1});
        else
            dropped = add({}, {0, passes});
        CHECK(dropped == 0);
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t i = 0; i < pixels; ++i) {
                PixelSums const& p = film.pixel(static_cast<int>(i) % nx, static_cast<int>(i) / nx);
                double const value = p.rgb[c] / p.weight;
                if (per_pixel) means[i][c].add(value);
                sum += value;
            }
            if (!per_pixel) means[0][c].add(sum / static_cast<double>(pixels));
        }
    }
    CHECK(stats.rejected == 0);
    return means;
}

/// The power that a mean must have: the 99% interval's half width, as a share of the expected value.
inline double power() { return full() ? 0.001 : 0.005 * (kSanitizerShare > 1 ? 4 : 1); }

/// agrees() of statistics.h, with more room for float rounding, which adds up along long paths (1e-5).
inline Agreement agreement(Mean const& m, double expected, double within, double alpha, double unit) {
    Agreement a = agrees(m, expected, within, alpha, unit);
    double const off = std::abs(m.mean() - expected) - 1e-5 * std::abs(expected);
    a.p = off <= 0 ? 1 : student_p(off / m.standard_error(), static_cast<double>(m.count() - 1));
    a.equal = a.p >= alpha;
    if (expected == 0) a.equal = a.powerful = m.mean() == 0 && m.half_width() == 0;  // black is black
    return a;
}

/// A guess: widths shrink with the square root of the passes, for Sobol' points nearly with the passes themselves.
inline std::uint64_t more_passes(std::uint64_t n, double excess) {
    double const factor = std::clamp(1.2 * std::pow(excess, 1.5), 1.3, 32.0);
    return static_cast<std::uint64_t>(std::ceil(static_cast<double>(n) * factor));
}

using Expected = std::function<Vec3(std::size_t)>;

/// The t-test with the power rule, for every pixel (or for the film's mean): more passes until the intervals are narrow
/// enough; a failure reruns once with a new seed and ten times the samples and must then reach p = 1e-3.
/// `unit`: values that should be smaller than this (as a share of the largest) need only be as precise as this one.
inline void check_equal(World const& world, Settings const& s, std::uint64_t passes, Expected const& expected,
                        bool per_pixel, double unit = 0.05) {
    Means means;
    double largest = 0;
    // How many times too wide the widest interval is.
    double excess = 0;
    std::uint64_t n = passes;
    for (int round = 0; round < 8; ++round) {
        means = measure(world, s, n, per_pixel);
        excess = 0;
        for (std::size_t i = 0; i < means.size(); ++i)
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, static_cast<double>(std::abs(expected(i)[c])));
        for (std::size_t i = 0; i < means.size(); ++i)
            for (int c = 0; c < 3; ++c)
                if (double const e = expected(i)[c]; e != 0)
                    excess = std::max(excess, means[i][static_cast<std::size_t>(c)].half_width() /
                                                  (power() * std::max(std::abs(e), unit * largest)));
        if (excess <= 1) break;
        n = more_passes(n, excess);
    }
    bool const powerful = excess <= 1;
    INFO("passes: ", n);
    CHECK_MESSAGE(powerful, "inconclusive: the intervals are too wide");
    double const alpha = sidak(static_cast<int>(means.size()) * 3);
    bool again = false;
    for (std::size_t i = 0; i < means.size(); ++i)
        for (int c = 0; c < 3; ++c)
            again = again ||
                    !agreement(means[i][static_cast<std::size_t>(c)], expected(i)[c], 1e9, alpha, 1).equal;
    if (again) means = measure(world, s, n * 10, per_pixel, 2);
    for (std::size_t i = 0; i < means.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            auto const a = agreement(means[i][static_cast<std::size_t>(c)], expected(i)[c], 1e9,
                                     again ? std::min(1e-3, alpha) : alpha, 1);
            if (!a.equal) {
                INFO("pixel ", i, ", channel ", c);
                CHECK_MESSAGE(a.equal, a);
            }
        }
}
inline void check_mean(World const& world, Settings const& s, std::uint64_t passes, Vec3 expected) {
    check_equal(
        world, s, passes, [&](std::size_t) { return expected; }, false);
}
inline void check_mean(World const& world, Settings const& s, std::uint64_t passes, double expected) {
    check_mean(world, s, passes, Vec3(static_cast<float>(expected)));
}
inline void check_pixels(World const& world, Settings const& s, std::uint64_t passes,
                         Expected const& expected, double unit = 0.05) {
    check_equal(world, s, passes, expected, true, unit);
}

/// The means of renders that estimate the same thing: each pair differs by no more than chance.
struct Variant {
    std::string name;
    World const* world;
    Settings settings;
    std::uint64_t passes;
};
inline void check_same(std::vector<Variant> const& variants) {
    std::vector<Means> means;
    for (auto const& v : variants) {
        std::uint64_t n = v.passes;
        Means m = measure(*v.world, v.settings, n, false, means.size() + 1);
        for (int round = 0; round < 8 && m[0][1].half_width() > power() * m[0][1].mean(); ++round) {
            n = more_passes(n, m[0][1].half_width() / (power() * m[0][1].mean()));
            m = measure(*v.world, v.settings, n, false, means.size() + 1);
        }
        INFO(v.name);
        CHECK_MESSAGE(m[0][1].half_width() <= power() * m[0][1].mean(), "inconclusive: ", m[0][1].mean(),
                      " +- ", m[0][1].half_width());
        means.push_back(m);
    }
    double const alpha = sidak(static_cast<int>(3 * (variants.size() * (variants.size() - 1) / 2)));
    for (std::size_t a = 0; a < means.size(); ++a)
        for (std::size_t b = a + 1; b < means.size(); ++b)
            for (std::size_t c = 0; c < 3; ++c) {
                Mean const& x = means[a][0][c];
                Mean const& y = means[b][0][c];
                // Welch's test.
                double const vx = x.standard_error() * x.standard_error();
                double const vy = y.standard_error() * y.standard_error();
                double const off = std::abs(x.mean() - y.mean()) - 1e-5 * std::abs(x.mean());
                double const dof = (vx + vy) * (vx + vy) / ((vx * vx + vy * vy) / (kBatches - 1) + 1e-300);
                double const p = off <= 0 ? 1 : student_p(off / std::sqrt(vx + vy), dof);
                CAPTURE(c);
                CHECK_MESSAGE(p >= alpha, variants[a].name, ": ", x.mean(), ", ", variants[b].name, ": ",
                              y.mean(), ", p = ", p);
            }
}

}  // namespace nephroid::test
