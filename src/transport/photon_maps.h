// The maps of one pass, ready to be asked.
#pragma once

#include "density.h"
#include "irradiance.h"

namespace nephroid {

struct PhotonMaps {
    PhotonMap global, caustic;
    IrradianceMap irradiance;  // of the global map; where the integrator gathers
    EstimateRule global_rule, caustic_rule;
};

}  // namespace nephroid
