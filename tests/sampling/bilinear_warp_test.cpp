// Bilinear densities, mixed between slices: sampled by what they are, and inverted.
#include "sampling/bilinear_warp.h"

#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

std::size_t const kWidth = 9, kHeight = 7;

/// Six slices of very different nodes, some of them 0: whole rows and columns at the rims too.
std::vector<float> nodes() {
    Random r(3);
    std::vector<float> f;
    for (int s = 0; s < 6; ++s)
        for (std::size_t y = 0; y < kHeight; ++y)
            for (std::size_t x = 0; x < kWidth; ++x) {
                bool const dark = r.below(4) == 0 || (s % 2 == 0 && (y < 2 || y > 4 || x > 6));
                f.push_back(dark ? 0.0f : static_cast<float>(std::exp(r.uniform(-4, 4))));
            }
    return f;
}
ParameterGrid grid() { return {{-1, 0.5f}, {0, 1, 4}}; }

/// The density by its definition: weights times slices, each over its own integral.
double brute(std::vector<float> const& f, SliceMix const& mix, double x, double y) {
    auto const node = [&](std::size_t s, std::size_t i, std::size_t j) {
        return static_cast<double>(f[(s * kHeight + j) * kWidth + i]);
    };
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(mix.count); ++k) {
        std::size_t const s = mix.slice[k];
        double whole = 0;
        for (std::size_t j = 0; j + 1 < kHeight; ++j)
            for (std::size_t i = 0; i + 1 < kWidth; ++i)
                whole += (node(s, i, j) + node(s, i + 1, j) + node(s, i, j + 1) + node(s, i + 1, j + 1)) / 4 /
                         ((kWidth - 1.0) * (kHeight - 1.0));
        double const px = x * (kWidth - 1), py = y * (kHeight - 1);
        auto const i = std::min(static_cast<std::size_t>(px), kWidth - 2);
        auto const j = std::min(static_cast<std::size_t>(py), kHeight - 2);
        double const tx = px - static_cast<double>(i), ty = py - static_cast<double>(j);
        sum += static_cast<double>(mix.weight[k]) *
               ((1 - ty) * ((1 - tx) * node(s, i, j) + tx * node(s, i + 1, j)) +
                ty * ((1 - tx) * node(s, i, j + 1) + tx * node(s, i + 1, j + 1))) /
               whole;
    }
    return sum;
}

}  // namespace

TEST_CASE("a pair of parameters is mixed of its neighbours, and brought back from beyond") {
    ParameterGrid const g = grid();
    auto const at = [&](float a, float b) {
        std::vector<float> w(6);
        SliceMix const m = g.mix(a, b);
        for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) w[m.slice[k]] += m.weight[k];
        return w;
    };
    CHECK(at(-1, 0) == std::vector<float>{1, 0, 0, 0, 0, 0});
    CHECK(at(-9, 1) == std::vector<float>{0, 1, 0, 0, 0, 0});
    CHECK(at(9, 9) == std::vector<float>{0, 0, 0, 0, 0, 1});
    CHECK(at(-0.25f, 2.5f) == std::vector<float>{0, 0.25f, 0.25f, 0, 0.25f, 0.25f});
    CHECK(at(-1, 3.25f) == std::vector<float>{0, 0.25f, 0.75f, 0, 0, 0});
    CHECK(ParameterGrid({2}, {3}).mix(7, -7).count == 1);
    CHECK(at(std::nanf(""), std::nanf("")) == std::vector<float>{1, 0, 0, 0, 0, 0});
}

TEST_CASE("bilinear warp: samples by the density, which is the slices' mixture") {
    auto const f = nodes();
    BilinearWarp const warp(f, kWidth, kHeight);
    ParameterGrid const g = grid();
    std::vector<SliceMix> mixes;
    for (std::size_t s = 0; s < 6; ++s) mixes.push_back(ParameterGrid::only(s));
    for (auto const& [a, b] : {std::pair{-0.9f, 0.1f}, {0.2f, 2.0f}, {0.5f, 0.5f}, {-1.0f, 3.9f}})
        mixes.push_back(g.mix(a, b));
    int const n = samples(400'000, 4'000'000);
    double const alpha = sidak(static_cast<int>(mixes.size()));
    for (auto const& mix : mixes) {
        CAPTURE(mix.slice[0]);
        CAPTURE(mix.count);
        std::vector<double> o(48 * 48), e(48 * 48);
        int const nx = 6 * (kWidth - 1), ny = 8 * (kHeight - 1);  // 48 x 48
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x)
                e[static_cast<std::size_t>(y * nx + x)] =
                    n * brute(f, mix, (x + 0.5) / nx, (y + 0.5) / ny) / (nx * ny);
        Random r(5);
        for (int i = 0; i < n; ++i) {
            Vec2 const u{r.unit(), r.unit()};
            auto const s = warp.sample(mix, u);
            REQUIRE((s.p.x >= 0 && s.p.x <= 1 && s.p.y >= 0 && s.p.y <= 1));
            ++o[static_cast<std::size_t>(std::min(static_cast<int>(s.p.y * ny), ny - 1) * nx +
                                         std::min(static_cast<int>(s.p.x * nx), nx - 1))];
            if (i % 64) continue;
            double const x = s.p.x, y = s.p.y;
            double const expected = brute(f, mix, x, y);
            CHECK(static_cast<double>(s.pdf) == doctest::Approx(expected).epsilon(1e-3).scale(1e-2));
            CHECK(static_cast<double>(warp.pdf(mix, s.p)) ==
                  doctest::Approx(expected).epsilon(1e-3).scale(1e-2));
            auto const back = warp.invert(mix, s.p);
            CHECK(back.pdf == warp.pdf(mix, s.p));
            CHECK(std::abs(back.p.x - u.x) < 2e-4f);
            CHECK(std::abs(back.p.y - u.y) < 2e-5f);
        }
        auto const c = chi_square(o, e);
        INFO(c);
        CHECK(c.p >= alpha);
    }
}

TEST_CASE("bilinear warp: the density is the Jacobian of the warp") {
    auto const f = nodes();
    BilinearWarp const warp(f, kWidth, kHeight);
    ParameterGrid const g = grid();
    Random r(6);
    int looked = 0;
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        SliceMix const mix =
            g.mix(static_cast<float>(r.uniform(-1, 0.5)), static_cast<float>(r.uniform(0, 4)));
        Vec2 const u{0.05f + 0.9f * r.unit(), 0.05f + 0.9f * r.unit()};
        auto const same_cell = [&](Vec2 a, Vec2 b) {
            return static_cast<int>(a.x * (kWidth - 1)) == static_cast<int>(b.x * (kWidth - 1)) &&
                   static_cast<int>(a.y * (kHeight - 1)) == static_cast<int>(b.y * (kHeight - 1));
        };
        bool crease = false;
        auto const element = [&](float h) {
            Vec2 const a = warp.sample(mix, u + Vec2{h, 0}).p, b = warp.sample(mix, u - Vec2{h, 0}).p;
            Vec2 const c = warp.sample(mix, u + Vec2{0, h}).p, d = warp.sample(mix, u - Vec2{0, h}).p;
            crease = crease || !same_cell(a, b) || !same_cell(c, d) || !same_cell(a, c);
            Vec2 const x = a - b, y = c - d;
            return std::abs(static_cast<double>(x.x) * static_cast<double>(y.y) -
                            static_cast<double>(x.y) * static_cast<double>(y.x)) /
                   (4.0 * static_cast<double>(h * h));
        };
        double const coarse = element(0x1p-7f), fine = element(0x1p-8f);
        if (crease || std::abs(coarse / fine - 1) > 0.02) continue;  // near a node of density 0
        ++looked;
        worst = std::max(
            worst, std::abs((4 * fine - coarse) / 3 * static_cast<double>(warp.sample(mix, u).pdf) - 1));
    }
    INFO(looked, " looked at");
    CHECK(looked > 500);
    CHECK(worst < 1e-3);
}

TEST_CASE("bilinear warp: empty slices are uniform, negative nodes are 0, and ends of the square hold") {
    std::vector<float> f(2 * 4);
    f[4] = -1, f[5] = 1, f[6] = -2, f[7] = 1;
    BilinearWarp const warp(f, 2, 2);
    auto const uniform = warp.sample(ParameterGrid::only(0), {0.3f, 0.8f});
    CHECK(uniform.p.x == doctest::Approx(0.3f));
    CHECK(uniform.p.y == doctest::Approx(0.8f));
    CHECK(uniform.pdf == 1);
    // Of slice 1 a line from 0 to 2 along x is left.
    CHECK(warp.pdf(ParameterGrid::only(1), {0.25f, 0.5f}) == doctest::Approx(0.5));
    CHECK(warp.sample(ParameterGrid::only(1), {0.25f, 0.5f}).p.x == doctest::Approx(0.5));
    auto const all = nodes();
    BilinearWarp const w(all, kWidth, kHeight);
    for (std::size_t s = 0; s < 6; ++s)
        for (float const x : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
            for (float const y : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f}) {
                auto const p = w.sample(ParameterGrid::only(s), {x, y});
                CHECK((std::isfinite(p.pdf) && p.p.x >= 0 && p.p.x <= 1 && p.p.y >= 0 && p.p.y <= 1));
            }
}
