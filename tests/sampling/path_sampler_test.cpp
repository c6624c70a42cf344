// The numbers of a path: pure, keyed, stratified, and good at integrating.
#include "sampling/path_sampler.h"

#include "statistics.h"

#include <doctest/doctest.h>

#include <set>

using namespace nephroid;
using namespace nephroid::test;

namespace {

std::vector<Sequence> sequences(std::uint64_t seed = 11) {
    Sequence sobol;
    sobol.seed = seed;
    Sequence stratified = sobol;
    stratified.kind = SequenceKind::Stratified;
    Sequence independent = sobol;
    independent.kind = SequenceKind::Independent;
    return {sobol, stratified, independent};
}

std::vector<float> draws(Sequence const& s, std::uint64_t stream, std::uint64_t path, std::uint64_t pass) {
    PathSampler p(s, stream, path, pass);
    std::vector<float> v;
    for (int i = 0; i < 6; ++i) {
        v.push_back(p.next_1d());
        Vec2 const u = p.next_2d();
        v.push_back(u.x), v.push_back(u.y);
    }
    return v;
}

}  // namespace

TEST_CASE("numbers do not depend on the order of asking") {
    for (Sequence const& s : sequences()) {
        std::vector<std::vector<float>> forward;
        for (std::uint64_t pass = 0; pass < 40; ++pass)
            for (std::uint64_t path = 0; path < 5; ++path) forward.push_back(draws(s, 0, path, pass));
        std::vector<std::uint64_t> order;
        for (std::uint64_t i = 0; i < 200; ++i) order.push_back(i);
        Random r(1);
        for (std::size_t i = order.size(); i > 1; --i)
            std::swap(order[i - 1], order[r.below(static_cast<std::uint32_t>(i))]);
        for (std::uint64_t const i : order) CHECK(draws(s, 0, i % 5, i / 5) == forward[i]);
    }
}

TEST_CASE("at() goes to a dimension, whatever was drawn before") {
    for (Sequence const& s : sequences()) {
        PathSampler a(s, 0, 3, 9);
        std::vector<float> one;
        for (int i = 0; i < 20; ++i) one.push_back(a.next_1d());
        CHECK(a.dimension() == 20);
        PathSampler b(s, 0, 3, 9);
        for (std::uint32_t i : {7u, 0u, 19u, 7u}) {
            b.at(i);
            CHECK(b.next_1d() == one[i]);
        }
        b.at(4);
        Vec2 const u = b.next_2d();
        b.at(4);
        Vec2 const v = b.next_2d();
        CHECK(u == v);
        CHECK(b.next_1d() == one[5]);
    }
}

TEST_CASE("seed, stream, path, pass and dimension all matter") {
    for (Sequence const& s : sequences()) {
        auto const base = draws(s, 0, 1, 2);
        Sequence other = s;
        other.seed += 1;
        CHECK(draws(other, 0, 1, 2) != base);
        CHECK(draws(s, 1, 1, 2) != base);
        CHECK(draws(s, 0, 2, 2) != base);
        CHECK(draws(s, 0, 1, 3) != base);
        CHECK(draws(s, 0, 1, 2 + (std::uint64_t{1} << 32)) != base);
        std::set<float> distinct(base.begin(), base.end());
        CHECK(distinct.size() == base.size());
    }
}

TEST_CASE("dimensions, paths, streams and passes are independent of each other") {
    // Pairs of numbers that differ in one key only fill the square evenly.
    int const n = samples(1'000'000, 4'000'000);
    struct Pair {
        char const* what;
        std::uint64_t stream, path, pass;
        std::uint32_t dimension;
    };
    // The second number of a pair, relative to the first. Neighbouring passes of one path are *meant* to be stratified.
    Pair const pairs[] = {{"dimension", 0, 0, 0, 1}, {"far dimension", 0, 0, 0, 64},
                          {"path", 0, 1, 0, 0},      {"far path", 0, 1920, 0, 0},
                          {"stream", 1, 0, 0, 0},    {"path and dimension", 0, 1, 0, 1}};
    double const alpha = sidak(3 * 6);
    for (Sequence const& s : sequences(5))
        for (Pair const& q : pairs) {
            std::vector<double> o(16 * 16);
            for (int k = 0; k < n; ++k) {
                // Passes of many paths, so that stratification over passes does not make counts too even.
                auto const path = static_cast<std::uint64_t>(k) * 7919;
                std::uint64_t const pass = static_cast<std::uint64_t>(k) % 13;
                PathSampler a(s, 0, path, pass);
                PathSampler b(s, q.stream, path + q.path, pass + q.pass);
                a.at(3);
                b.at(3 + q.dimension);
                float const x = a.next_1d();
                float const y = b.next_1d();
                ++o[static_cast<std::size_t>(x * 16) * 16 + static_cast<std::size_t>(y * 16)];
            }
            auto const c = chi_square(o, std::vector<double>(256, n / 256.0));
            CAPTURE(q.what);
            INFO(c);
            CHECK(c.p >= alpha);
        }
}

TEST_CASE("each sampler is uniform over paths and passes") {
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(6);
    for (Sequence const& s : sequences(7)) {
        std::vector<double> one(1000);
        std::vector<double> two(32 * 32);
        for (int k = 0; k < n; ++k) {
            PathSampler p(s, 0, static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(k) % 37);
            float const x = p.next_1d();
            Vec2 const u = p.next_2d();
            REQUIRE((x >= 0 && x < 1 && u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
            ++one[static_cast<std::size_t>(x * 1000)];
            ++two[static_cast<std::size_t>(u.x * 32) * 32 + static_cast<std::size_t>(u.y * 32)];
        }
        auto const a = chi_square(one, std::vector<double>(1000, n / 1000.0));
        auto const b = chi_square(two, std::vector<double>(1024, n / 1024.0));
        INFO(a);
        CHECK(a.p >= alpha);
        INFO(b);
        CHECK(b.p >= alpha);
    }
}

TEST_CASE("stratified passes: each block fills each cell once, and draws are shuffled differently") {
    for (auto const& [nx, ny] : {std::pair{4u, 4u}, {3u, 5u}, {1u, 1u}, {16u, 1u}, {7u, 9u}})
        for (bool const jitter : {true, false}) {
            Sequence s;
            s.kind = SequenceKind::Stratified;
            s.x_strata = nx, s.y_strata = ny, s.jitter = jitter;
            std::uint32_t const n = nx * ny;
            std::set<std::vector<std::uint32_t>> orders;
            for (std::uint64_t path = 0; path < 3; ++path)
                for (std::uint64_t block = 0; block < 3; ++block)
                    for (std::uint32_t d = 0; d < 3; ++d) {
                        std::vector<int> cells(n), bins(n);
                        std::vector<std::uint32_t> order;
                        for (std::uint32_t i = 0; i < n; ++i) {
                            PathSampler p(s, 0, path, block * n + i);
                            p.at(2 * d);
                            float const x = p.next_1d();
                            Vec2 const u = p.next_2d();
                            float const fx = u.x * static_cast<float>(nx), fy = u.y * static_cast<float>(ny);
                            std::uint32_t const cell =
                                static_cast<std::uint32_t>(fy) * nx + static_cast<std::uint32_t>(fx);
                            REQUIRE(cell < n);
                            ++cells[cell];
                            ++bins[std::min(n - 1, static_cast<std::uint32_t>(x * static_cast<float>(n)))];
                            order.push_back(cell);
                            if (!jitter) CHECK(std::abs(fx - std::floor(fx) - 0.5f) < 1e-4f);
                        }
                        for (std::uint32_t i = 0; i < n; ++i) CHECK(cells[i] == 1);
                        for (std::uint32_t i = 0; i < n; ++i) CHECK(bins[i] == 1);
                        orders.insert(order);
                    }
            if (n > 8) CHECK(orders.size() == 27);
        }
}

TEST_CASE("permutation_element is a permutation, and all of them are about as likely") {
    Random r(3);
    for (std::uint32_t const n : {1u, 2u, 3u, 7u, 16u, 100u, 1000u})
        for (int t = 0; t < 20; ++t) {
            auto const key = static_cast<std::uint32_t>(r.bits());
            std::vector<char> seen(n, 0);
            bool good = true;
            for (std::uint32_t i = 0; i < n; ++i) {
                std::uint32_t const e = permutation_element(i, n, key);
                good = good && e < n && !seen[e]++;
            }
            CHECK(good);
        }
    // Where element i goes, over keys.
    std::vector<double> o(8 * 8);
    int const m = 100'000;
    for (int k = 0; k < m; ++k) {
        auto const key = static_cast<std::uint32_t>(r.bits());
        std::uint32_t const i = static_cast<std::uint32_t>(k) % 8;
        ++o[i * 8 + permutation_element(i, 8, key)];
    }
    CHECK(chi_square(o, std::vector<double>(64, m / 64.0)).p >= 0.001);
}

TEST_CASE("the error of a mean: Sobol' and stratified points beat independent ones on a smooth integrand") {
    auto const f = [](Vec2 u) {
        double const x = static_cast<double>(u.x), y = static_cast<double>(u.y);
        return std::exp(x) * std::sin(1.5 * y + 0.3);
    };
    double const exact = (std::exp(1.0) - 1) * (std::cos(0.3) - std::cos(1.8)) / 1.5;
    int const batches = 256;
    double mse[3][2] = {};
    int const counts[2] = {64, 1024};
    for (int k = 0; k < 3; ++k) {
        Sequence const s = sequences(9)[static_cast<std::size_t>(k)];
        for (int j = 0; j < 2; ++j) {
            Mean means;
            for (int b = 0; b < batches; ++b) {
                double sum = 0;
                for (int i = 0; i < counts[j]; ++i) {
                    PathSampler p(s, 0, static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(i));
                    sum += f(p.next_2d());
                }
                means.add(sum / counts[j]);
                mse[k][j] += std::pow(sum / counts[j] - exact, 2) / batches;
            }
            auto const a = agrees(means, exact, 0.02, sidak(6));
            INFO(a);
            CHECK(a);
        }
    }
    // Independent: variance / n, here Var f by quadrature.
    double f2 = 0;
    for (int i = 0; i < 200; ++i)
        for (int j = 0; j < 200; ++j)
            f2 +=
                std::pow(f({(static_cast<float>(i) + 0.5f) / 200, (static_cast<float>(j) + 0.5f) / 200}), 2) /
                40000;
    double const variance = f2 - exact * exact;
    for (int j = 0; j < 2; ++j) CHECK(mse[2][j] * counts[j] / variance == doctest::Approx(1).epsilon(0.35));
    // Scrambled nets: n^-3 for smooth integrands (Owen 1997); 16 times the points, 4096 times less, but for logarithms.
    CHECK(mse[0][0] < mse[2][0] / 100);
    CHECK(mse[0][1] < mse[2][1] / 3000);
    CHECK(mse[0][0] / mse[0][1] > 1000);
    // A 4x4 block gains its stratification and no more.
    CHECK(mse[1][0] < mse[2][0] / 4);
    CHECK(mse[1][0] / mse[1][1] == doctest::Approx(16).epsilon(0.5));
}

TEST_CASE("a draw of many paths at once is what each draws by itself, bit for bit") {
    Random r(9);
    for (Sequence const& s : sequences(3))
        for (std::size_t n = 0; n <= 20; ++n) {
            std::vector<PathSampler> together, alone;
            for (std::size_t i = 0; i < n; ++i) together.emplace_back(s, 1, r.bits(), r.bits() >> 28);
            alone = together;
            std::vector<PathSampler*> paths;
            for (PathSampler& p : together) paths.push_back(&p);
            std::vector<Vec2> drawn(n + 1, Vec2{-1, -1});
            draw_2d(paths, 17, drawn.data());
            for (std::size_t i = 0; i < n; ++i) {
                alone[i].at(17);
                CHECK(drawn[i] == alone[i].next_2d());
                CHECK(together[i].dimension() == alone[i].dimension());
            }
            CHECK(drawn[n] == Vec2{-1, -1});
            std::vector<float> single(n + 1, -1.0f);
            draw_1d(paths, 11, single.data());
            for (std::size_t i = 0; i < n; ++i) {
                alone[i].at(11);
                CHECK(single[i] == alone[i].next_1d());
                CHECK(together[i].dimension() == alone[i].dimension());
            }
            CHECK(single[n] == -1.0f);
        }
}

TEST_CASE("a pass of the stratified sampler that was rendered last does not change the first") {
    // Nothing knows how many passes there will be: a number is named by its pass alone.
    for (Sequence const& s : sequences(1)) {
        auto const first = draws(s, 0, 5, 3);
        for (std::uint64_t pass = 4; pass < 100; ++pass) draws(s, 0, 5, pass);
        CHECK(draws(s, 0, 5, 3) == first);
    }
}
