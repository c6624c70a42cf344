// Discrete and piecewise-constant distributions.
#include "sampling/distribution.h"
#include "sampling/path_sampler.h"

#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

float const kEnds[] = {0.0f, 0x1p-32f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};

std::vector<float> random_weights(Random& r, int n, bool zeros) {
    std::vector<float> w;
    for (int i = 0; i < n; ++i)
        w.push_back(zeros && r.below(3) == 0 ? 0.0f : static_cast<float>(std::exp(r.uniform(-3, 3))));
    w[static_cast<std::size_t>(r.below(static_cast<std::uint32_t>(n)))] = 1;
    return w;
}

}  // namespace

TEST_CASE(
    "alias table: a million indices, one number each, and no more chance for the dim ones than is theirs") {
    // A number of 24 bits gives the lighter half 25.6% here, where 24.6% is right.
    Random r(5);
    auto const w = random_weights(r, 1'000'000, false);
    AliasTable const t(w);
    double lighter = 0;
    for (std::uint32_t i = 0; i < w.size(); ++i)
        if (w[i] < 1) lighter += static_cast<double>(t.pmf(i));
    Sequence sequence;
    for (auto const kind : {SequenceKind::Sobol, SequenceKind::Stratified, SequenceKind::Independent}) {
        sequence.kind = kind;
        double const n = samples(4'000'000, 40'000'000);
        double found = 0;
        for (std::uint64_t pass = 0; pass < static_cast<std::uint64_t>(n); ++pass) {
            // Many paths of 16 passes: independent of each other, whatever a path's own passes are.
            PathSampler sampler(sequence, 0, pass / 16, pass % 16);
            found += w[t.sample(sampler.next_1d_fine()).index] < 1;
        }
        double const sigma = std::sqrt(lighter * (1 - lighter) / n);
        CHECK(std::abs(found / n - lighter) < 4 * sigma);
    }
}

TEST_CASE("alias table: indices by weight, leftover uniform") {
    Random r(1);
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(2 * 6);
    for (int const size : {1, 2, 3, 10, 100, 1000}) {
        auto const w = random_weights(r, size, size > 3);
        AliasTable const t(w);
        REQUIRE(t.size() == w.size());
        double total = 0;
        double pmf = 0;
        for (float const x : w) total += static_cast<double>(x);
        std::vector<double> e;
        for (std::uint32_t i = 0; i < w.size(); ++i) {
            CHECK(t.pmf(i) == doctest::Approx(static_cast<double>(w[i]) / total).epsilon(1e-5));
            pmf += static_cast<double>(t.pmf(i));
            e.push_back(n * static_cast<double>(w[i]) / total);
        }
        CHECK(pmf == doctest::Approx(1).epsilon(1e-5));
        std::vector<double> o(w.size()), left(50);
        for (int i = 0; i < n; ++i) {
            auto const s = t.sample(r.uniform());
            REQUIRE(s.index < w.size());
            CHECK(s.pmf == t.pmf(s.index));
            CHECK(s.pmf > 0);
            REQUIRE((s.u >= 0 && s.u < 1));
            ++o[s.index];
            ++left[static_cast<std::size_t>(s.u * 50)];
        }
        if (size > 1) {
            auto const c = chi_square(o, e);
            INFO(size, ": ", c);
            CHECK(c.p >= alpha);
        } else {
            CHECK(o[0] == n);
        }
        auto const c = chi_square(left, std::vector<double>(50, n / 50.0));
        INFO("leftover ", size, ": ", c);
        CHECK(c.p >= alpha);
        for (float const u : kEnds) {
            auto const s = t.sample(u);
            CHECK(w[s.index] > 0);
            CHECK((s.u >= 0 && s.u < 1));
        }
    }
}

TEST_CASE("alias table: the leftover is uniform within each index") {
    AliasTable const t(std::vector<float>{1, 7, 2, 0.5f});
    Random r(2);
    std::vector<double> o(4 * 20), e(4 * 20);
    int const n = 400'000;
    for (int i = 0; i < n; ++i) {
        auto const s = t.sample(r.unit());
        ++o[s.index * 20 + static_cast<std::size_t>(s.u * 20)];
    }
    float const w[4] = {1, 7, 2, 0.5f};
    for (std::size_t i = 0; i < e.size(); ++i) e[i] = n * static_cast<double>(w[i / 20]) / 10.5 / 20;
    auto const c = chi_square(o, e);
    INFO(c);
    CHECK(c.p >= 0.01);
}

TEST_CASE("alias table: nothing to choose from") {
    CHECK(AliasTable{}.empty());
    CHECK(AliasTable(std::vector<float>{}).empty());
    CHECK(AliasTable(std::vector<float>{0, 0, 0}).empty());
    AliasTable const one(std::vector<float>{0, 3, 0});
    for (float u = 0; u < 1; u += 0.01f) CHECK(one.sample(u).index == 1);
    CHECK(one.sample(1 - 0x1p-24f).index == 1);
    CHECK(one.pmf(1) == 1);
    CHECK(one.pmf(0) == 0);
}

TEST_CASE("Distribution1D: samples, density, inverse") {
    Random r(3);
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(5);
    for (int const size : {1, 2, 7, 64, 1000}) {
        auto const f = random_weights(r, size, size > 2);
        Distribution1D const d(f);
        double total = 0;
        for (float const x : f) total += static_cast<double>(x);
        CHECK(d.integral() == doctest::Approx(total / size).epsilon(1e-5));
        double integral = 0;
        for (int i = 0; i < size; ++i)
            integral +=
                static_cast<double>(d.pdf((static_cast<float>(i) + 0.5f) / static_cast<float>(size))) / size;
        CHECK(integral == doctest::Approx(1).epsilon(1e-5));
        // Cells halved, so that the place within a cell counts too.
        std::vector<double> o(2 * f.size()), e;
        for (std::size_t i = 0; i < e.size() + 2 * f.size() && e.size() < 2 * f.size(); ++i)
            e.push_back(n * static_cast<double>(f[i / 2]) / total / 2);
        for (int i = 0; i < n; ++i) {
            float const u = r.unit();
            float pdf = 0;
            std::size_t cell = 0;
            float const x = d.sample(u, &pdf, &cell);
            REQUIRE((x >= 0 && x < 1));
            REQUIRE(f[cell] > 0);
            CHECK(pdf == doctest::Approx(f[cell] / d.integral()).epsilon(2e-3));
            CHECK(d.pdf(x) == pdf);
            if (auto const back = d.invert(x))
                CHECK(std::abs(*back - u) < 1e-6f + 1e-4f / static_cast<float>(size));
            ++o[std::min(o.size() - 1, static_cast<std::size_t>(x * static_cast<float>(2 * size)))];
        }
        auto const c = chi_square(o, e);
        INFO(size, ": ", c);
        CHECK(c.p >= alpha);
    }
}

TEST_CASE("Distribution1D: no sample where the density is 0, to the last bit") {
    // A lit cell before a dark one: rounding must not carry a sample over the edge.
    for (std::size_t const size : {2u, 3u, 5u, 10u, 100u, 1000u, 4096u})
        for (std::size_t lit = 0; lit < size; lit += std::max<std::size_t>(1, size / 17)) {
            std::vector<float> f(size, 0.0f);
            f[lit] = 2;
            Distribution1D const d(f);
            for (float const u : kEnds) {
                float pdf = 0;
                std::size_t cell = 0;
                float const x = d.sample(u, &pdf, &cell);
                CAPTURE(size);
                CAPTURE(lit);
                CAPTURE(u);
                CHECK(cell == lit);
                CHECK(pdf > 0);
                CHECK(d.pdf(x) == pdf);
            }
        }
}

TEST_CASE("Distribution1D: all zero is uniform, outside is 0") {
    Distribution1D const d(std::vector<float>{0, 0, 0, 0});
    CHECK(d.integral() == 0);
    float pdf = 0;
    for (float const u : {0.0f, 0.1f, 0.6f, 1 - 0x1p-24f}) {
        CHECK(d.sample(u, &pdf) == doctest::Approx(u).epsilon(1e-6));
        CHECK(pdf == 1);
        CHECK(d.pdf(u) == 1);
    }
    Distribution1D const one(std::vector<float>{3});
    CHECK(one.sample(0.25f, &pdf) == 0.25f);
    CHECK(pdf == 1);
    CHECK(one.pdf(-0.1f) == 0);
    CHECK(one.pdf(1.1f) == 0);
    CHECK_FALSE(one.invert(-0.1f));
    CHECK_FALSE(one.invert(1.5f));
}

TEST_CASE("Distribution1D: each of the 2^24 numbers counted: a cell gets as many as its density says") {
    // Cells of a billionth beside a sun, dark ones between, more lit ones at the end than there would be room for.
    for (std::size_t const size : {5u, 300u, 4096u}) {
        std::vector<float> f(size);
        for (std::size_t i = 0; i < size; ++i) f[i] = i % 7 == 3 ? 0.0f : 1e-3f;
        f[size / 2] = 1e6f;
        Distribution1D const d(f);
        std::vector<double> count(size);
        for (std::uint32_t k = 0; k < (1u << 24); ++k) {
            std::size_t cell = 0;
            d.sample(static_cast<float>(k) * 0x1p-24f, nullptr, &cell);
            ++count[cell];
        }
        for (std::size_t i = 0; i < size; ++i) {
            float const x = (static_cast<float>(i) + 0.5f) / static_cast<float>(size);
            CAPTURE(size);
            CAPTURE(i);
            CHECK(static_cast<double>(d.pdf(x)) * 0x1p24 / static_cast<double>(size) ==
                  doctest::Approx(count[i]).epsilon(1e-6));
            CHECK((count[i] > 0) == (f[i] > 0));
        }
    }
}

TEST_CASE("Distribution2D: one texel of 1e6 among others of 1e-3: the dim ones are not lost") {
    int const side = 64;
    std::vector<float> f(side * side, 1e-3f);
    std::size_t const sun = 20 * side + 41;
    f[sun] = 1e6f;
    for (std::size_t x = 0; x < side; ++x) f[50 * side + x] = 0;
    Distribution2D const d(f, side, side);
    Random r(6);
    int const n = samples(5'000'000, 20'000'000);  // the dim cells get some 0.8% of them
    double const alpha = sidak(3);
    // Four quarters to a cell.
    std::vector<double> o(f.size() * 4), e(f.size() * 4);
    double total = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
        std::size_t const x = i % (2 * side), y = i / (2 * side);
        Vec2 const centre{(static_cast<float>(x) + 0.5f) / (2 * side),
                          (static_cast<float>(y) + 0.5f) / (2 * side)};
        e[i] = n * static_cast<double>(d.pdf(centre)) / static_cast<double>(e.size());
        total += e[i];
        CHECK((e[i] > 0) == (f[y / 2 * side + x / 2] > 0));
    }
    CHECK(total == doctest::Approx(n).epsilon(1e-6));
    // A function that is 1 + x y on the dim cells, 0 on the sun.
    Mean dim, all;
    for (int i = 0; i < n; ++i) {
        float pdf = 0;
        Vec2 const p = d.sample({r.unit(), r.unit()}, &pdf);
        REQUIRE(pdf > 0);
        REQUIRE(pdf == d.pdf(p));
        auto const x = static_cast<std::size_t>(p.x * side), y = static_cast<std::size_t>(p.y * side);
        ++o[static_cast<std::size_t>(p.y * 2 * side) * 2 * side + static_cast<std::size_t>(p.x * 2 * side)];
        bool const at_sun = y * side + x == sun;
        double const value = 1 + static_cast<double>(p.x) * static_cast<double>(p.y);
        dim.add(at_sun ? 0 : value / static_cast<double>(pdf));
        all.add(static_cast<double>(f[y * side + x]) / static_cast<double>(pdf));
    }
    auto const c = chi_square(o, e);
    INFO(c);
    CHECK(c.p >= alpha);
    double exact = 0;
    for (std::size_t i = 0; i < f.size(); ++i)
        if (i != sun && f[i] > 0)
            exact += (1 + (static_cast<double>(i % side) + 0.5) * (static_cast<double>(i / side) + 0.5) /
                              (side * side)) /
                     static_cast<double>(f.size());
    auto const a = agrees(dim, exact, 0.05, alpha);
    INFO(a);
    CHECK(a);
    auto const b = agrees(all, static_cast<double>(d.integral()), 0.001, alpha);
    INFO(b);
    CHECK(b);
}

TEST_CASE("Distribution2D: samples, density, inverse, zero rows") {
    Random r(4);
    int const n = samples(1'000'000, 4'000'000);
    int const w = 13, h = 9;
    auto f = random_weights(r, w * h, true);
    for (int x = 0; x < w; ++x) f[static_cast<std::size_t>(4 * w + x)] = 0;  // a dark row
    Distribution2D const d(f, w, h);
    double total = 0;
    for (float const x : f) total += static_cast<double>(x);
    CHECK(d.integral() == doctest::Approx(total / (w * h)).epsilon(1e-5));
    std::vector<double> o(f.size()), e(f.size());
    for (std::size_t i = 0; i < f.size(); ++i) {
        e[i] = n * static_cast<double>(f[i]) / total;
        Vec2 const centre{(static_cast<float>(i % w) + 0.5f) / w, (static_cast<float>(i / w) + 0.5f) / h};
        CHECK(d.pdf(centre) == doctest::Approx(static_cast<double>(f[i]) / total * w * h).epsilon(1e-4));
    }
    for (int i = 0; i < n; ++i) {
        Vec2 const u{r.unit(), r.unit()};
        float pdf = 0;
        Vec2 const p = d.sample(u, &pdf);
        REQUIRE((p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1));
        REQUIRE(pdf > 0);
        CHECK(d.pdf(p) == doctest::Approx(pdf));
        auto const back = d.invert(p);
        REQUIRE(back);
        CHECK((std::abs(back->x - u.x) < 2e-6f * w && std::abs(back->y - u.y) < 2e-6f * h));
        ++o[static_cast<std::size_t>(p.y * h) * w + static_cast<std::size_t>(p.x * w)];
    }
    auto const c = chi_square(o, e);
    INFO(c);
    CHECK(c.p >= 0.01);
    CHECK(d.pdf({0.5f, -0.5f}) == 0);
    CHECK(d.pdf({1.5f, 0.5f}) == 0);
    CHECK_FALSE(d.invert({0.5f, 2.0f}));
    CHECK_FALSE(d.invert({-1.0f, 0.5f}));
    for (float const x : kEnds)
        for (float const y : kEnds) {
            float pdf = 0;
            Vec2 const p = d.sample({x, y}, &pdf);
            CHECK(pdf > 0);
            CHECK(d.pdf(p) == doctest::Approx(pdf));
        }
    CHECK(Distribution2D{}.empty());
    Distribution2D const black(std::vector<float>(12, 0.0f), 4, 3);
    float pdf = 0;
    black.sample({0.3f, 0.4f}, &pdf);
    CHECK(pdf == 1);
    CHECK(black.integral() == 0);
}
