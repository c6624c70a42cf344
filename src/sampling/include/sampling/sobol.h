// Owen-scrambled Sobol' points in two dimensions, padded: every draw of a path has a scramble and a shuffle of its own.
//
// Two Sobol' dimensions make a (0,2)-sequence: each run of 2^k points, from a multiple of 2^k on, is stratified over every
// elementary interval, so that any prefix is good and nothing needs to know how many passes there will be. Owen's nested
// uniform scrambling is done by a hash on reversed bits (Laine & Karras 2011; Burley 2020, "Practical Hash-based Owen
// Scrambling", section 3.2); the same hash, applied to the index, decorrelates the draws.
#pragma once

#include "math/vec.h"
#include "sampling/hash.h"

#include <array>
#include <cstdint>

namespace nephroid {

/// Nested uniform scramble of a number whose bits stand reversed (lowest bit first): each bit may depend only on lower ones.
/// Constants by N. Vegdahl's improvement of Laine & Karras' hash.
constexpr std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
    return reverse_bits(owen_scramble_reversed(reverse_bits(x), seed));
}

namespace detail {
/// Sobol' direction numbers of the second dimension, as tables over the bytes of a *bit-reversed* … see sobol_second.
constexpr std::array<std::uint32_t, 32> sobol_second_directions() {
    // Dimension 2: primitive polynomial x + 1, m = 1; v_k = v_{k-1} ^ (v_{k-1} >> 1). The matrix is Pascal's triangle mod 2.
    std::array<std::uint32_t, 32> v{};
    v[0] = 0x80000000u;
    for (std::size_t k = 1; k < 32; ++k) v[k] = v[k - 1] ^ (v[k - 1] >> 1);
    return v;
}
constexpr std::array<std::array<std::uint32_t, 256>, 4> sobol_second_tables() {
    std::array<std::array<std::uint32_t, 256>, 4> t{};
    auto const v = sobol_second_directions();
    for (std::size_t byte = 0; byte < 4; ++byte)
        for (std::size_t i = 0; i < 256; ++i) {
            std::uint32_t x = 0;
            for (std::size_t bit = 0; bit < 8; ++bit)
                if (i >> bit & 1u) x ^= v[8 * byte + bit];
            // Stored bit-reversed: the scramble works on reversed bits anyway.
            t[byte][i] = reverse_bits(x);
        }
    return t;
}
inline constexpr auto kSobolSecond = sobol_second_tables();
}  // namespace detail

/// Second Sobol' dimension of index i, with its bits reversed. (The first, reversed, is i itself: van der Corput.)
constexpr std::uint32_t sobol_second_reversed(std::uint32_t i) {
    return detail::kSobolSecond[0][i & 255u] ^ detail::kSobolSecond[1][i >> 8 & 255u] ^
           detail::kSobolSecond[2][i >> 16 & 255u] ^ detail::kSobolSecond[3][i >> 24];
}

/// Point `index` of the scrambled and shuffled sequence named by `key`; the index comes with its bits reversed, since a path
/// draws many numbers at one index.
inline std::uint32_t sobol_1d_bits(std::uint32_t reversed_index, std::uint64_t key) {
    auto const shuffle = static_cast<std::uint32_t>(key);
    auto const scramble = static_cast<std::uint32_t>(key >> 32);
    std::uint32_t const i = reverse_bits(owen_scramble_reversed(reversed_index, shuffle));
    return reverse_bits(owen_scramble_reversed(i, scramble));
}
inline float sobol_1d(std::uint32_t reversed_index, std::uint64_t key) {
    return to_unit_float(sobol_1d_bits(reversed_index, key));
}
inline Vec2 sobol_2d(std::uint32_t reversed_index, std::uint64_t key) {
    auto const shuffle = static_cast<std::uint32_t>(key);
    auto const scramble = static_cast<std::uint32_t>(key >> 32);
    std::uint32_t const i = reverse_bits(owen_scramble_reversed(reversed_index, shuffle));
    std::uint64_t const x = owen_scramble_reversed(i, scramble);
    std::uint64_t const y = owen_scramble_reversed(sobol_second_reversed(i), mix32(scramble));
    // Both turned round at once, which also swaps them.
    std::uint64_t const both = reverse_bits(y << 32 | x);
    return {to_unit_float(static_cast<std::uint32_t>(both >> 32)),
            to_unit_float(static_cast<std::uint32_t>(both))};
}

}  // namespace nephroid
