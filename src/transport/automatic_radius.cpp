#include "photon_plan.h"

namespace nephroid {

float automatic_radius(RenderJob const& job, PhotonPlan const&, bool) {
    Bounds3 const& b = job.world().bounds();
    return 0.01f * length(b.hi - b.lo);
}

}  // namespace nephroid
