// Eight floats at a time, as much of them as searching for photons needs. Each lane is plain IEEE arithmetic, so that a test of
// eight says what eight tests would.
#pragma once

#include "math/vec.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace nephroid {

typedef float Float8 __attribute__((vector_size(32)));

inline Float8 all8(float x) { return Float8{x, x, x, x, x, x, x, x}; }

inline Float8 load8(float const* from) {
    Float8 lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

/// Bit i: lane i of a is less than lane i of b; not set where one is NaN.
inline std::uint32_t less8(Float8 a, Float8 b) {
#ifdef __AVX__
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)));
#else
    std::uint32_t bits = 0;
    for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint32_t>(a[i] < b[i]) << i;
    return bits;
#endif
}
/// a where a > b, else b.
inline Float8 max8(Float8 a, Float8 b) {
#ifdef __AVX__
    return _mm256_max_ps(a, b);
#else
    Float8 most{};
    for (int i = 0; i < 8; ++i) most[i] = a[i] > b[i] ? a[i] : b[i];
    return most;
#endif
}

/// Writes those lanes of `from` whose bits are set to `to`, one after the other, and their numbers plus `first` to `numbers`.
/// Room for eight is needed. Returns how many.
std::uint32_t pack8(std::uint32_t bits, Float8 from, std::uint32_t first, float* to, std::uint32_t* numbers);

/// Eight points.
struct Points8 {
    Float8 x, y, z;

    /// Squared distances to p, with the very rounding of dot(q - p, q - p).
    [[nodiscard]] Float8 distance2(Points8 const& p) const {
        Float8 const dx = x - p.x, dy = y - p.y, dz = z - p.z;
        return dx * dx + dy * dy + dz * dz;
    }
    void set(std::uint32_t lane, Vec3 p) { x[lane] = p.x, y[lane] = p.y, z[lane] = p.z; }
};
inline Points8 all8(Vec3 p) { return {all8(p.x), all8(p.y), all8(p.z)}; }

/// Eight boxes.
struct Boxes8 {
    Points8 lo, hi;

    /// Squared distances to p, 0 inside. Rounding is monotonic, so none is greater than what distance2() says of a point in
    /// that box.
    [[nodiscard]] Float8 distance2(Points8 const& p) const {
        Float8 const dx = max8(max8(lo.x - p.x, p.x - hi.x), Float8{});
        Float8 const dy = max8(max8(lo.y - p.y, p.y - hi.y), Float8{});
        Float8 const dz = max8(max8(lo.z - p.z, p.z - hi.z), Float8{});
        return dx * dx + dy * dy + dz * dz;
    }
};

/// Calls f(i) for each bit i that is set, from the lowest.
template <class F>
void each_bit(std::uint32_t bits, F&& f) {
    for (; bits != 0; bits &= bits - 1) f(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

inline constexpr auto kLanesOfBits = [] {
    std::array<std::uint64_t, 256> lanes{};  // a byte for each bit that is set
    for (std::uint32_t bits = 0; bits < 256; ++bits)
        for (std::uint32_t lane = 0, n = 0; lane < 8; ++lane)
            if (bits >> lane & 1u) lanes[bits] |= std::uint64_t{lane} << 8u * n++;
    return lanes;
}();

inline std::uint32_t pack8(std::uint32_t bits, Float8 from, std::uint32_t first, float* to,
                           std::uint32_t* numbers) {
#ifdef __AVX2__
    __m256i const lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kLanesOfBits[bits])));
    _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(from, lanes));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(numbers),
                        _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(first))));
#else
    std::uint64_t lanes = kLanesOfBits[bits];
    for (int i = 0; i < std::popcount(bits); ++i, lanes >>= 8) {
        auto const lane = static_cast<std::uint32_t>(lanes & 7u);
        to[i] = from[lane], numbers[i] = first + lane;
    }
#endif
    return static_cast<std::uint32_t>(std::popcount(bits));
}

}  // namespace nephroid
