#include "world/floor.h"

#include "ray_caster.h"

#include <bit>

namespace nephroid {

TraceSums trace_only(World const& world, std::span<RecordedRay const> rays) {
    RayCaster const& caster = *world.caster_;
    TraceSums sums;
    auto const met = [&](RawHit const& hit) {
        sums.nearest_hits += static_cast<std::uint64_t>(hit.found);
        if (hit.found) sums.distance += static_cast<double>(hit.t);
    };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        RecordedRay const& r = rays[i];
        bool const shadow = r.kind == RayKind::Shadow;
        if (r.lane < 0) {
            RawHit hit;
            if (shadow)
                sums.occluded += caster.any(r.ray, r.t_max);
            else if (caster.nearest(r.ray, r.t_max, hit))
                met(hit);
            continue;
        }
        RayPacket packet;
        packet.set(0, r.ray, r.t_max);
        while (i + 1 < rays.size() && rays[i + 1].lane > 0) {
            ++i;
            packet.set(static_cast<std::size_t>(rays[i].lane), rays[i].ray, rays[i].t_max);
        }
        LaneMask const lanes = RayCaster::acceptable(packet);
        if (shadow) {
            sums.occluded += static_cast<std::uint64_t>(std::popcount(caster.any(packet, lanes)));
        } else {
            std::array<RawHit, kLanes> hits;
            caster.nearest(packet, lanes, hits);
            for (RawHit const& hit : hits) met(hit);
        }
    }
    return sums;
}

}  // namespace nephroid
