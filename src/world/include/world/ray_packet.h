// Rays side by side, as the intersector wants them, and the arithmetic of their ends. Loops over lanes call the very functions that
// single rays use: without branches, the compiler makes one instruction of eight, and the bits are the same.
#pragma once

#include "math/lanes.h"
#include "math/ray.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// One bit a lane.
using LaneMask = std::uint32_t;

using FloatLanes = std::array<float, kLanes>;

/// Eight vectors, by coordinates.
struct alignas(32) Vec3Lanes {
    FloatLanes x{}, y{}, z{};

    [[nodiscard]] Vec3 operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
    void set(std::size_t lane, Vec3 v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

/// Up to eight rays; the lanes of `used` are in use, and what the others hold has no meaning.
struct RayPacket {
    Vec3Lanes o, d;
    FloatLanes t_max{};  // in lengths of the direction
    LaneMask used = 0;

    void set(std::size_t lane, Ray const& ray, float until) {
        o.set(lane, ray.o);
        d.set(lane, ray.d);
        t_max[lane] = until;
        used |= 1u << lane;
    }
    [[nodiscard]] Ray ray(std::size_t lane) const { return {o[lane], d[lane]}; }
};

}  // namespace nephroid
