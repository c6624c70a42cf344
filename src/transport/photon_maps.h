// The maps of one pass, ready to be asked.
#pragma once

#include "density.h"
#include "irradiance.h"

namespace nephroid {

struct PhotonMaps {
    PhotonMap global, caustic;
    PhotonMap further;                  // what caustic paths left further on, where the global map has it not
    bool caustics_from_global = false;  // none were shot by themselves
    IrradianceMap irradiance;           // of the global map; where the integrator gathers
    EstimateRule global_rule, caustic_rule, further_rule;
    float shortest_gather =
        0;  // a gather ray that is no longer goes on as a path: about as far as photons are spread
};

/// What v reflects of all light, by the global map. Irradiance that was precomputed says what a diffuse surface does with it; others are
/// asked by direction.
Spectrum from_global_map(PathContext& c, Walk const& walk, Vertex const& v);
/// What v reflects of light that came neither straight nor as a caustic, by the maps that are read at what the camera sees.
Estimate from_indirect(PathContext& c, Walk const& walk, Vertex const& v, std::uint32_t most_bounces);
/// What v reflects of caustics, from whichever map has them.
Estimate from_caustics(PathContext& c, Walk const& walk, Vertex const& v, std::uint32_t most_bounces);

}  // namespace nephroid
