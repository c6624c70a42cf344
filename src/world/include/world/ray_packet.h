// Rays side by side, as the intersector wants them.
#pragma once

#include "math/lanes.h"
#include "math/ray.h"

#include <cstddef>

namespace nephroid {

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
