// The floor of a render: what the intersector alone needs for the rays of a pass (bench/, docs/performance.md).
#pragma once

#include "world/world.h"

#include <cstdint>
#include <span>

namespace nephroid {

/// What tracing found; also keeps the compiler from leaving it out.
struct TraceSums {
    std::uint64_t nearest_hits = 0;  // camera and bounce rays that met something
    std::uint64_t occluded = 0;      // shadow rays that met something
    double distance = 0;             // sum of t over nearest hits
};

/// Traces recorded rays in their order, packets as packets, and does nothing else: no surface is looked at.
TraceSums trace_only(World const& world, std::span<RecordedRay const> rays);

}  // namespace nephroid
