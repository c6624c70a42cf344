// A light as eight receivers see it at once.
#pragma once

#include "math/lanes.h"
#include "spectrum/runtime.h"

namespace nephroid {

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

/// Receivers that see the light at a wide angle wait, until there are eight of them; then their samples are filled.
struct WaitingReceivers {
    struct Place {
        LightSampleLanes* samples;
        std::size_t lane;
    };
    ReceiverLanes to;
    Vec2Lanes u;
    std::array<Place, kLanes> places;
    std::size_t count = 0;
};

/// Rays that the light sends out (LightRay). pdf 0: none.
struct EmittedLanes {
    Vec3Lanes o, d;             // o: moved off the light
    FloatLanes pdf{};           // of the direction, by solid angle
    FloatLanes per_radiance{};  // power / radiance
    RuntimeSpectrum const* radiance = nullptr;
};

}  // namespace nephroid
