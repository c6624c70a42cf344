#include "world/floor.h"

#include "ray_caster.h"

namespace nephroid {

TraceSums trace_only(World const& world, std::span<RecordedRay const> rays) {
    RayCaster const& caster = *world.caster_;
    TraceSums sums;
    for (RecordedRay const& r : rays) {
        if (r.kind == RayKind::Shadow) {
            sums.occluded += caster.any(r.ray, r.t_max);
        } else {
            RawHit hit;
            if (!caster.nearest(r.ray, r.t_max, hit)) continue;
            ++sums.nearest_hits;
            sums.distance += static_cast<double>(hit.t);
        }
    }
    return sums;
}

}  // namespace nephroid
