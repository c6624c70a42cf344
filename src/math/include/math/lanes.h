// Many of a kind at once. Loops over lanes call the very functions that are used for one: without branches, the compiler makes one
// instruction of eight, and the bits are the same.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// How many are done at once: what AVX2, which every build asks for, holds of floats.
inline constexpr std::size_t kLanes = 8;

/// One bit a lane.
using LaneMask = std::uint32_t;

using FloatLanes = std::array<float, kLanes>;

/// Eight vectors, by coordinates.
struct Vec2Lanes {
    FloatLanes x{}, y{};

    [[nodiscard]] Vec2 operator[](std::size_t lane) const { return {x[lane], y[lane]}; }
    void set(std::size_t lane, Vec2 v) { x[lane] = v.x, y[lane] = v.y; }
};
struct alignas(32) Vec3Lanes {
    FloatLanes x{}, y{}, z{};

    [[nodiscard]] Vec3 operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
    void set(std::size_t lane, Vec3 v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

}  // namespace nephroid
