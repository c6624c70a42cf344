// A light as eight receivers see it at once.
#pragma once

#include "spectrum/runtime.h"
#include "world/ray_packet.h"

namespace nephroid {

struct Vec2Lanes {
    FloatLanes x{}, y{};

    [[nodiscard]] Vec2 operator[](std::size_t lane) const { return {x[lane], y[lane]}; }
    void set(std::size_t lane, Vec2 v) { x[lane] = v.x, y[lane] = v.y; }
};

/// Surfaces that want light from one side: the normals' (Receiver).
struct ReceiverLanes {
    Vec3Lanes p, n;
};

/// A point of the light for each (LightSample). pdf 0: nothing of it reaches the receiver.
struct LightSampleLanes {
    Vec3Lanes p, wi;
    FloatLanes pdf{};
    // The same for all.
    Vec3 p_error{0, 0, 0}, n{0, 0, 1};
    RuntimeSpectrum const* radiance = nullptr;
};

}  // namespace nephroid
