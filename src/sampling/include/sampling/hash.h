// Keyed randomness: every number is a hash of what it is for, never the state of a generator.
#pragma once

#include <bit>
#include <cstdint>

namespace nephroid {

/// A bijection of 64 bits with good avalanche: the finaliser of SplitMix64 (Steele et al. 2014; constants by D. Stafford, mix 13).
constexpr std::uint64_t mix64(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}
/// A bijection of 32 bits (C. Wellons' search, "lowbias32").
template <class Bits>  // of 32, or vectors of them
constexpr Bits mix32(Bits x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}
/// Hash of a sequence of keys; the order matters.
constexpr std::uint64_t hash_keys(std::uint64_t a) { return mix64(a + 0x9e3779b97f4a7c15ull); }
template <class... Rest>
constexpr std::uint64_t hash_keys(std::uint64_t a, std::uint64_t b, Rest... rest) {
    return hash_keys(hash_keys(a) ^ b, static_cast<std::uint64_t>(rest)...);
}

/// 32 random bits to [0, 1): the top 24 bits, so that 1 is never reached.
constexpr float to_unit_float(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

/// 53 random bits to [0, 1).
constexpr double to_unit_double(std::uint64_t x) { return static_cast<double>(x >> 11) * 0x1p-53; }

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

}  // namespace nephroid
