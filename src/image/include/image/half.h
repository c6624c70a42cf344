// Half floats as their 16 bits: conversion to and from float, round to nearest even, as IEEE 754 binary16.
#pragma once

#include <bit>
#include <cstdint>

#ifdef __F16C__
#include <immintrin.h>
#endif

namespace nephroid {

inline constexpr float kLargestHalf = 65504.0f;

/// The definition, in integer arithmetic; kept reachable because the tests hold the instruction against it.
inline float half_to_float_portable(std::uint16_t h) {
    std::uint32_t const sign = static_cast<std::uint32_t>(h & 0x8000u) << 16;
    std::uint32_t const exponent = (h >> 10) & 31u;
    std::uint32_t const mantissa = h & 1023u;
    if (exponent == 31u) {
        // A signalling NaN becomes quiet, as the conversion instruction does it.
        std::uint32_t const quiet = mantissa != 0 ? 0x400000u : 0u;
        return std::bit_cast<float>(sign | 0x7f800000u | quiet | (mantissa << 13));
    }
    if (exponent == 0) {
        float const magnitude = static_cast<float>(mantissa) * 0x1p-24f;  // zero and subnormals, exact
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(magnitude) | sign);
    }
    return std::bit_cast<float>(sign | ((exponent + 112u) << 23) | (mantissa << 13));
}

inline std::uint16_t float_to_half_portable(float f) {
    std::uint32_t const bits = std::bit_cast<std::uint32_t>(f);
    auto const sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000u);
    std::uint32_t const magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u)
        return static_cast<std::uint16_t>(sign | 0x7e00u | ((magnitude >> 13) & 1023u));  // NaN
    if (magnitude >= 0x477ff000u) return static_cast<std::uint16_t>(sign | 0x7c00u);      // rounds past 65504
    if (magnitude < 0x38800000u) {
        // Below 2^-14: adding one half makes the float unit round the subnormal for us.
        float const shifted = std::bit_cast<float>(magnitude) + 0.5f;
        return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3f000000u));
    }
    std::uint32_t const odd = (magnitude >> 13) & 1u;
    return static_cast<std::uint16_t>(sign | ((magnitude - 0x38000000u + 0xfffu + odd) >> 13));
}

inline float half_to_float(std::uint16_t h) {
#ifdef __F16C__
    return _cvtsh_ss(h);
#else
    return half_to_float_portable(h);
#endif
}

inline std::uint16_t float_to_half(float f) {
#ifdef __F16C__
    return static_cast<std::uint16_t>(_cvtss_sh(f, _MM_FROUND_TO_NEAREST_INT));
#else
    return float_to_half_portable(f);
#endif
}

}  // namespace nephroid
