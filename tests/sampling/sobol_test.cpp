// Owen-scrambled Sobol' points: nets, and scrambles that know nothing of each other.
#include "sampling/sobol.h"

#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Does each elementary interval of area 2^-k hold exactly one of the 2^k points from `first` on?
bool is_net(int k, std::uint32_t first, std::uint64_t key) {
    std::uint32_t const n = 1u << k;
    for (int a = 0; a <= k; ++a) {
        std::uint32_t const nx = 1u << a;
        std::uint32_t const ny = n / nx;
        std::vector<char> hit(n, 0);
        for (std::uint32_t i = 0; i < n; ++i) {
            Vec2 const p = sobol_2d(SobolIndex(first + i), key);
            auto const x = static_cast<std::uint32_t>(p.x * static_cast<float>(nx));
            auto const y = static_cast<std::uint32_t>(p.y * static_cast<float>(ny));
            if (x >= nx || y >= ny || hit[y * nx + x]++) return false;
        }
    }
    return true;
}

}  // namespace

TEST_CASE("every aligned run of 2^k points is a (0,2)-net, whatever the key") {
    Random r(1);
    for (int k = 0; k <= 10; ++k)
        for (int t = 0; t < 40; ++t) {
            std::uint64_t const key = r.bits();
            std::uint32_t const first = t == 0 ? 0 : static_cast<std::uint32_t>(r.bits()) >> k << k;
            CAPTURE(k);
            CAPTURE(key);
            CAPTURE(first);
            CHECK(is_net(k, first, key));
        }
}

TEST_CASE("control: runs that are not aligned, and independent points, are no nets") {
    int misaligned = 0;
    for (std::uint64_t key = 0; key < 20; ++key) misaligned += is_net(6, 13, hash_keys(key));
    CHECK(misaligned < 5);
}

TEST_CASE("one-dimensional runs are stratified") {
    Random r(2);
    for (int k = 0; k <= 12; ++k)
        for (int t = 0; t < 30; ++t) {
            std::uint32_t const n = 1u << k;
            std::uint64_t const key = r.bits();
            std::uint32_t const first = static_cast<std::uint32_t>(r.bits()) >> k << k;
            std::vector<char> hit(n, 0);
            bool good = true;
            for (std::uint32_t i = 0; i < n; ++i) {
                auto const x =
                    static_cast<std::uint32_t>(sobol_1d(SobolIndex(first + i), key) * static_cast<float>(n));
                good = good && x < n && !hit[x]++;
            }
            CHECK(good);
        }
}

TEST_CASE("the second dimension is Sobol's") {
    // Unscrambled: 0, 1/2, 3/4, 1/4, 5/8, 1/8, 3/8, 7/8.
    float const expected[8] = {0, 0.5f, 0.75f, 0.25f, 0.625f, 0.125f, 0.375f, 0.875f};
    for (std::uint32_t i = 0; i < 8; ++i) CHECK(to_unit_float(sobol_second(i)) == expected[i]);
}

TEST_CASE("points are what their definition says, bit for bit") {
    Random r(4);
    for (int t = 0; t < 100'000; ++t) {
        auto const index = static_cast<std::uint32_t>(r.bits());
        std::uint64_t const key = r.bits();
        auto const shuffle = static_cast<std::uint32_t>(key);
        auto const scramble = static_cast<std::uint32_t>(key >> 32);
        std::uint32_t const i = owen_scramble(index, shuffle);
        std::uint32_t const x = owen_scramble(reverse_bits(i), scramble);
        std::uint32_t const y = owen_scramble(sobol_second(i), mix32(scramble));
        Vec2 const p = sobol_2d(SobolIndex(index), key);
        REQUIRE(p.x == to_unit_float(x));
        REQUIRE(p.y == to_unit_float(y));
        REQUIRE(sobol_1d(SobolIndex(index), key) == to_unit_float(x));
        REQUIRE(sobol_1d_bits(SobolIndex(index), key) == x);
    }
}

TEST_CASE("an Owen scramble is nested: equal leading bits stay equal, the next one flips by them alone") {
    Random r(3);
    for (int t = 0; t < 2000; ++t) {
        auto const seed = static_cast<std::uint32_t>(r.bits());
        auto const x = static_cast<std::uint32_t>(r.bits());
        auto const b = static_cast<int>(r.below(31)) + 1;  // leading bits in common
        std::uint32_t const tail = 0xffffffffu >> b;
        std::uint32_t const y = (x & ~tail) | (static_cast<std::uint32_t>(r.bits()) & tail);
        CHECK(((owen_scramble(x, seed) ^ owen_scramble(y, seed)) & ~tail) == 0);
    }
}

TEST_CASE("each point alone is uniform over scrambles") {
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(3);
    for (std::uint32_t const index : {0u, 1u, 77777u}) {
        std::vector<double> o(32 * 32);
        for (int k = 0; k < n; ++k) {
            Vec2 const p = sobol_2d(SobolIndex(index), hash_keys(static_cast<std::uint64_t>(k), 5));
            ++o[static_cast<std::size_t>(p.x * 32) * 32 + static_cast<std::size_t>(p.y * 32)];
        }
        std::vector<double> const e(o.size(), n / 1024.0);
        auto const c = chi_square(o, e);
        INFO(index, ": ", c);
        CHECK(c.p >= alpha);
    }
}

TEST_CASE("scrambles of different keys are independent") {
    // Means of 16 points each under two keys are uncorrelated, and so are single points: t = r sqrt(n) is normal.
    int const n = 20'000;
    for (std::uint64_t const distance : {std::uint64_t{1}, std::uint64_t{1} << 32}) {
        double sxy = 0, sxx = 0, syy = 0;
        for (int k = 0; k < n; ++k) {
            std::uint64_t const key = hash_keys(static_cast<std::uint64_t>(k));
            double a = 0, b = 0;
            for (std::uint32_t i = 0; i < 7; ++i) {
                a += static_cast<double>(sobol_1d(SobolIndex(i), key)) - 0.5;
                b += static_cast<double>(sobol_1d(SobolIndex(i), mix64(key + distance))) - 0.5;
            }
            sxy += a * b, sxx += a * a, syy += b * b;
        }
        CHECK(std::abs(sxy / std::sqrt(sxx * syy)) * std::sqrt(n) < 3.9);
    }
    // Joint uniformity of the same index under neighbouring keys.
    std::vector<double> o(16 * 16);
    int const m = 200'000;
    for (int k = 0; k < m; ++k) {
        float const a = sobol_1d(SobolIndex(3u), mix64(static_cast<std::uint64_t>(k)));
        float const b =
            sobol_1d(SobolIndex(3u), mix64(static_cast<std::uint64_t>(k) + 0x9e3779b97f4a7c15ull));
        ++o[static_cast<std::size_t>(a * 16) * 16 + static_cast<std::size_t>(b * 16)];
    }
    CHECK(chi_square(o, std::vector<double>(256, m / 256.0)).p >= 0.001);
}
