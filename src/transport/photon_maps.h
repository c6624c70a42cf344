// The maps of one pass, ready to be asked.
#pragma once

#include "density.h"
#include "irradiance.h"

namespace nephroid {

struct PhotonMaps {
    PhotonMap global, caustic;
    IrradianceMap irradiance;  // of the global map; where the integrator gathers
    EstimateRule global_rule, caustic_rule;
    float shortest_gather =
        0;  // a gather ray that is no longer goes on as a path: about as far as photons are spread
};

}  // namespace nephroid
