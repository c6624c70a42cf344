// Hashes: bijections that avalanche, sequences of keys that do not collide.
#include "sampling/hash.h"

#include "statistics.h"

#include <doctest/doctest.h>

#include <set>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Each input bit flips each output bit with probability 1/2: the largest deviation over all pairs.
template <class T, class F>
double avalanche_fault(F const& f, int n) {
    constexpr int bits = 8 * sizeof(T);
    std::vector<double> flips(bits * bits);
    Random r(1);
    for (int i = 0; i < n; ++i) {
        T const x = static_cast<T>(r.bits());
        T const h = f(x);
        for (int b = 0; b < bits; ++b) {
            T const d = h ^ f(static_cast<T>(x ^ (T{1} << b)));
            for (int o = 0; o < bits; ++o) flips[static_cast<std::size_t>(b * bits + o)] += (d >> o) & 1;
        }
    }
    double worst = 0;
    for (double const k : flips) worst = std::max(worst, std::abs(k / n - 0.5));
    return worst;
}

}  // namespace

TEST_CASE("one flipped bit flips half of the others") {
    int const n = 20'000;
    // 5.5 standard deviations of a fair coin over n throws.
    double const limit = 5.5 * 0.5 / std::sqrt(n);
    CHECK(avalanche_fault<std::uint64_t>([](std::uint64_t x) { return mix64(x); }, n) < limit);
    // mix32 has a known small bias of its own (0.17 of 100 on average), so it is given a percent.
    CHECK(avalanche_fault<std::uint32_t>([](std::uint32_t x) { return mix32(x); }, n) < 0.03);
    CHECK(avalanche_fault<std::uint64_t>([](std::uint64_t x) { return hash_keys(x, 3); }, n) < limit);
    CHECK(avalanche_fault<std::uint64_t>([](std::uint64_t x) { return hash_keys(3, x, 7); }, n) < limit);
    CHECK(avalanche_fault<std::uint64_t>([](std::uint64_t x) { return x * 0x9e3779b97f4a7c15ull; }, 1000) >
          0.4);  // control
}

TEST_CASE("mixers are bijections") {
    std::set<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < 200'000; ++i) seen.insert(mix32(i));
    CHECK(seen.size() == 200'000);
    std::set<std::uint64_t> seen64;
    for (std::uint64_t i = 0; i < 200'000; ++i) seen64.insert(mix64(i));
    CHECK(seen64.size() == 200'000);
}

TEST_CASE("the order and the number of keys matter") {
    CHECK(hash_keys(1, 2) != hash_keys(2, 1));
    CHECK(hash_keys(1, 2, 3) != hash_keys(1, 3, 2));
    CHECK(hash_keys(0) != hash_keys(0, 0));
    CHECK(hash_keys(0, 0) != hash_keys(0, 0, 0));
    std::set<std::uint64_t> seen;
    for (std::uint64_t a = 0; a < 60; ++a)
        for (std::uint64_t b = 0; b < 60; ++b)
            for (std::uint64_t c = 0; c < 60; ++c) seen.insert(hash_keys(a, b, c));
    CHECK(seen.size() == 60 * 60 * 60);
}

TEST_CASE("to_unit_float never reaches 1") {
    CHECK(to_unit_float(0) == 0);
    CHECK(to_unit_float(0xffffffffu) == 1 - 0x1p-24f);
    CHECK(to_unit_float(0x80000000u) == 0.5f);
    CHECK(to_unit_double(0) == 0);
    CHECK(to_unit_double(~0ull) == 1 - 0x1p-53);
    CHECK(to_unit_double(1ull << 63) == 0.5);
}

TEST_CASE("reverse_bits") {
    CHECK(reverse_bits(1u) == 0x80000000u);
    CHECK(reverse_bits(0x12345678u) == 0x1e6a2c48u);
    Random r(2);
    for (int i = 0; i < 1000; ++i) {
        auto const x = static_cast<std::uint32_t>(r.bits());
        CHECK(reverse_bits(reverse_bits(x)) == x);
        for (int b = 0; b < 32; ++b) CHECK((reverse_bits(x) >> b & 1u) == (x >> (31 - b) & 1u));
    }
}
