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
#include <cmath>
#include <cstdint>

namespace nephroid {

/// Nested uniform scramble of a number whose bits stand reversed (lowest bit first): each bit may depend only on lower ones.
/// Constants by N. Vegdahl's improvement of Laine & Karras' hash. The first step knows nothing of the seed: a path takes it once
/// for all its draws.
template <class Bits>  // of 32, or vectors of them
constexpr Bits owen_scramble_begin(Bits x) {
    return x ^ x * 0x3d20adeau;
}
template <class Bits>
constexpr Bits owen_scramble_end(Bits x, Bits seed) {
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
template <class Bits>
constexpr Bits owen_scramble_reversed(Bits x, Bits seed) {
    return owen_scramble_end(owen_scramble_begin(x), seed);
}
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
    return reverse_bits(owen_scramble_reversed(reverse_bits(x), seed));
}

/// Second Sobol' dimension of index i. (The first is reverse_bits(i): van der Corput.) Primitive polynomial x + 1, m = 1:
/// v_k = v_{k-1} ^ (v_{k-1} >> 1); the matrix is Pascal's triangle mod 2.
constexpr std::uint32_t sobol_second(std::uint32_t i) {
    std::uint32_t x = 0;
    for (std::uint32_t v = 0x80000000u; i; i >>= 1, v ^= v >> 1)
        if (i & 1u) x ^= v;
    return x;
}

namespace detail {
/// Of an index with its bits reversed: the index (low half), and its second Sobol' dimension with bits reversed (high half), for
/// the scramble works on reversed bits. Both are linear in the bits, so they are sums (xor) over the four bytes.
constexpr std::array<std::array<std::uint64_t, 256>, 4> sobol_tables() {
    std::array<std::array<std::uint64_t, 256>, 4> t{};
    for (std::uint32_t byte = 0; byte < 4; ++byte)
        for (std::uint32_t b = 0; b < 256; ++b) {
            std::uint32_t const index = reverse_bits(b << 8 * byte);
            t[byte][b] = std::uint64_t{reverse_bits(sobol_second(index))} << 32 | index;
        }
    return t;
}
inline constexpr auto kSobol = sobol_tables();

/// A byte with its bits reversed, as a binary fraction.
constexpr std::array<float, 256> reversed_fractions() {
    std::array<float, 256> f{};
    for (std::uint32_t b = 0; b < 256; ++b) f[b] = static_cast<float>(reverse_bits(b)) * 0x1p-32f;
    return f;
}
inline constexpr auto kReversedFraction = reversed_fractions();

constexpr std::uint64_t sobol_of_reversed(std::uint32_t r) {
    return kSobol[0][r & 255u] ^ kSobol[1][r >> 8 & 255u] ^ kSobol[2][r >> 16 & 255u] ^ kSobol[3][r >> 24];
}
}  // namespace detail

/// to_unit_float(reverse_bits(x)), digit by digit in base 256: three digits fill a float, so that no step rounds.
inline float reversed_to_unit_float(std::uint32_t x) {
    auto const& digit = detail::kReversedFraction;
    return std::fma(std::fma(digit[x >> 16 & 255u], 0x1p-8f, digit[x >> 8 & 255u]), 0x1p-8f, digit[x & 255u]);
}

/// The index of a point, as those who draw many numbers at one index keep it.
class SobolIndex {
  public:
    SobolIndex() = default;
    explicit constexpr SobolIndex(std::uint32_t i) : begun_(owen_scramble_begin(reverse_bits(i))) {}
    /// Shuffled: owen_scramble(i, seed) in the low half, its second Sobol' dimension, with bits reversed, in the high half.
    [[nodiscard]] constexpr std::uint64_t shuffled(std::uint32_t seed) const {
        return detail::sobol_of_reversed(owen_scramble_end(begun_, seed));
    }
    /// owen_scramble_begin of the index with its bits reversed.
    [[nodiscard]] constexpr std::uint32_t begun() const { return begun_; }

  private:
    std::uint32_t begun_ = 0;
};

/// Point `index` of the scrambled and shuffled sequence named by `key`:
///   i = owen_scramble(index, shuffle), x = owen_scramble(reverse_bits(i), scramble), y = owen_scramble(sobol_second(i), …).
namespace detail {
inline std::uint32_t sobol_1d_reversed(SobolIndex index, std::uint64_t key) {
    auto const i = static_cast<std::uint32_t>(index.shuffled(static_cast<std::uint32_t>(key)));
    return owen_scramble_reversed(i, static_cast<std::uint32_t>(key >> 32));
}
}  // namespace detail
inline std::uint32_t sobol_1d_bits(SobolIndex index, std::uint64_t key) {
    return reverse_bits(detail::sobol_1d_reversed(index, key));
}
inline float sobol_1d(SobolIndex index, std::uint64_t key) {
    return reversed_to_unit_float(detail::sobol_1d_reversed(index, key));
}
inline Vec2 sobol_2d(SobolIndex index, std::uint64_t key) {
    auto const scramble = static_cast<std::uint32_t>(key >> 32);
    std::uint64_t const i = index.shuffled(static_cast<std::uint32_t>(key));
    std::uint32_t const x = owen_scramble_reversed(static_cast<std::uint32_t>(i), scramble);
    std::uint32_t const y = owen_scramble_reversed(static_cast<std::uint32_t>(i >> 32), mix32(scramble));
    return {reversed_to_unit_float(x), reversed_to_unit_float(y)};
}

}  // namespace nephroid
