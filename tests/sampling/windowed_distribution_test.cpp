// Densities within windows, against the same picture cut by hand.
#include "sampling/windowed_distribution.h"

#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

int const kWidth = 37, kHeight = 23;

/// Values over six decades, dark cells, a dark block, and a sun.
std::vector<float> picture() {
    Random r(11);
    std::vector<float> f(static_cast<std::size_t>(kWidth * kHeight));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            bool const dark = r.below(4) == 0 || (x >= 20 && x < 27 && y >= 5 && y < 12);
            f[static_cast<std::size_t>(y * kWidth + x)] =
                dark ? 0.0f : static_cast<float>(std::exp(r.uniform(-7, 7)));
        }
    f[static_cast<std::size_t>(3 * kWidth + 30)] = 1e9f;
    return f;
}

/// Overlap of [a, b] with [c, d].
double overlap(double a, double b, double c, double d) {
    return std::max(0.0, std::min(b, d) - std::max(a, c));
}

/// Integral of the picture over a window, cell by cell.
double brute(std::vector<float> const& f, SquareWindow const& w) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            sum +=
                static_cast<double>(f[static_cast<std::size_t>(y * kWidth + x)]) *
                overlap(w.x0, w.x1, static_cast<double>(x) / kWidth, static_cast<double>(x + 1) / kWidth) *
                overlap(w.y0, w.y1, static_cast<double>(y) / kHeight, static_cast<double>(y + 1) / kHeight);
    return sum;
}

}  // namespace

TEST_CASE("a window's samples have the density that is the picture's over its integral") {
    auto const f = picture();
    WindowedDistribution const d(f, kWidth, kHeight);
    double const cx = 1.0 / kWidth, cy = 1.0 / kHeight;
    SquareWindow const windows[] = {
        {0, 0, 1, 1},
        {0.1, 0.2, 0.73, 0.91},
        {10 * cx, 4 * cy, 19 * cx, 9 * cy},                              // along cell edges
        {0.5, 0.01, 0.95, 0.4},                                          // the sun, and the dark block
        {30.25 * cx, 3.5 * cy, 32.5 * cx, 4.5 * cy},                     // part of the sun
        {0.31, 0.33, 0.31 + 0.2 * cx, 0.33 + 3 * cy},                    // narrower than a cell
        {0.4, 0.62, 0.4 + 1e-9, 0.62 + 1e-10},                           // a billionth of a cell
        {12 * cx - 1e-9, 7 * cy - 1e-9, 12 * cx + 1e-9, 7 * cy + 2e-9},  // across a corner
        {19.5 * cx, 4.5 * cy, 27.5 * cx, 12.5 * cy},                     // dark but for its rim
        {0, 0.97, 1, 1},
    };
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(static_cast<int>(std::size(windows)));
    int const side = 60;
    for (SquareWindow const& w : windows) {
        CAPTURE(w.x0);
        CAPTURE(w.y0);
        double const total = brute(f, w);
        CHECK(d.integral(w) == doctest::Approx(total).epsilon(1e-7));
        if (!(total > 0)) continue;
        std::vector<double> o(side * side), e(side * side);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                SquareWindow const bin{w.x0 + (w.x1 - w.x0) * x / side, w.y0 + (w.y1 - w.y0) * y / side,
                                       w.x0 + (w.x1 - w.x0) * (x + 1) / side,
                                       w.y0 + (w.y1 - w.y0) * (y + 1) / side};
                e[static_cast<std::size_t>(y * side + x)] = n * brute(f, bin) / total;
            }
        Random r(12);
        for (int i = 0; i < n; ++i) {
            auto const s = d.sample(r.uniform(), r.uniform(), w);
            REQUIRE(s);
            REQUIRE((s->x >= w.x0 && s->x <= w.x1 && s->y >= w.y0 && s->y <= w.y1));
            REQUIRE(s->pdf > 0);
            if (i % 16 == 0) REQUIRE(d.pdf(s->x, s->y, w) == doctest::Approx(s->pdf).epsilon(1e-9));
            int const x = std::min(side - 1, static_cast<int>((s->x - w.x0) / (w.x1 - w.x0) * side));
            int const y = std::min(side - 1, static_cast<int>((s->y - w.y0) / (w.y1 - w.y0) * side));
            ++o[static_cast<std::size_t>(y * side + x)];
        }
        // Bins that hold nothing but a rounding error of a bin's edge are none.
        for (double& x : e)
            if (x < 1e-6) x = 0;
        int stray = 0;
        for (std::size_t i = 0; i < e.size(); ++i)
            if (e[i] == 0 && o[i] > 0) stray += static_cast<int>(o[i]), o[i] = 0;
        CHECK(stray == 0);
        if (std::count_if(e.begin(), e.end(), [](double x) { return x > 0; }) < 2) continue;
        auto const c = chi_square(o, e);
        INFO(c);
        CHECK(c.p >= alpha);
    }
}

TEST_CASE("the density is the picture's value over the window's integral, also far below a sun") {
    auto const f = picture();
    WindowedDistribution const d(f, kWidth, kHeight);
    Random r(13);
    for (int i = 0; i < 20000; ++i) {
        double const size = std::pow(10.0, r.uniform(-12, 0));
        double const x = r.uniform(), y = r.uniform();
        SquareWindow const w{x, y, std::min(1.0, x + size), std::min(1.0, y + size * r.uniform())};
        double const total = brute(f, w);
        double const px = r.uniform(w.x0, w.x1), py = r.uniform(w.y0, w.y1);
        double const value = static_cast<double>(f[static_cast<std::size_t>(
            static_cast<int>(py * kHeight) * kWidth + static_cast<int>(px * kWidth))]);
        if (total > 0)
            REQUIRE(d.pdf(px, py, w) == doctest::Approx(value / total).epsilon(1e-4));
        else
            REQUIRE(d.pdf(px, py, w) == 0);
        REQUIRE(d.pdf(w.x1 + 1e-3, py, w) == 0);
        REQUIRE(d.pdf(px, w.y0 - 1e-3, w) == 0);
    }
}

TEST_CASE("windows without light or area give no sample, and extreme numbers no wrong one") {
    auto const f = picture();
    WindowedDistribution const d(f, kWidth, kHeight);
    SquareWindow const dark{20.1 / kWidth, 5.1 / kHeight, 26.9 / kWidth, 11.9 / kHeight};
    CHECK(d.integral(dark) == 0);
    CHECK_FALSE(d.sample(0.3, 0.4, dark));
    CHECK_FALSE(d.sample(0.3, 0.4, {0.5, 0.2, 0.5, 0.7}));
    CHECK_FALSE(d.sample(0.3, 0.4, {0.5, 0.7, 0.6, 0.2}));
    CHECK_FALSE(WindowedDistribution{}.sample(0.3, 0.4, {}));
    CHECK_FALSE(WindowedDistribution(std::vector<float>(6, 0.0f), 3, 2).sample(0.3, 0.4, {}));
    for (double const u : {0.0, 0x1p-53, 0x1p-32, 0.5, 1 - 0x1p-24, 1 - 0x1p-53})
        for (double const v : {0.0, 0x1p-53, 0x1p-32, 0.5, 1 - 0x1p-24, 1 - 0x1p-53})
            for (SquareWindow const& w :
                 {SquareWindow{}, SquareWindow{0.2, 0.3, 0.6, 0.4}, SquareWindow{0.99, 0.99, 1, 1},
                  SquareWindow{19.5 / kWidth, 4.5 / kHeight, 27.0 / kWidth, 12.0 / kHeight}})
                if (auto const s = d.sample(u, v, w)) {
                    CHECK(s->pdf > 0);
                    CHECK(d.pdf(s->x, s->y, w) == doctest::Approx(s->pdf));
                    CHECK((s->x >= w.x0 && s->x <= w.x1 && s->y >= w.y0 && s->y <= w.y1));
                } else {
                    CHECK(brute(f, w) == 0);
                }
}
