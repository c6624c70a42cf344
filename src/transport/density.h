// Density estimates: from photons to what a surface reflects (Jensen 2001, 7.2).
//
//   L(x, wo) = sum over photons of f(x, wo, wi) dPhi K(d / r) / r^2
//
// with a kernel K that integrates to 1 over the unit disk.
#pragma once

#include "transport/photon_map.h"
#include "walk.h"

namespace nephroid {

/// How a map is asked.
struct EstimateRule {
    Kernel kernel = Kernel::Epanechnikov;
    std::uint32_t k =
        0;  // the nearest k, of which the last gives the radius and does not count; 0 = all within the radius
    float radius = 0;  // at most; scene units
    bool edge_correction = false;
};
struct Estimate {
    Spectrum radiance;          // towards v.wo
    float radius = 0;           // that was used
    std::uint32_t photons = 0;  // that counted
};

/// For the layers: the radius and the number of photons that a sample's first estimates took, from both maps.
inline void record_estimates(Estimate const& caustic, Estimate const& global, AovSample& aov) {
    if (aov.estimated) return;
    aov.estimated = true;
    aov.radius = max(caustic.radius, global.radius);
    aov.photons = static_cast<float>(caustic.photons) + static_cast<float>(global.photons);
}

/// Radiance that v reflects of the light that the photons of `map` brought. Those that would make the path longer than
/// `most_bounces` do not count (photon's bounces + 1 + `walk.vertex`).
Estimate reflected(PathContext& c, Walk const& walk, Vertex const& v, PhotonMap const& map,
                   EstimateRule const& rule, std::uint32_t most_bounces);

/// Irradiance on the side of n at p, from photons that landed on that side. W/m^2 (per nm).
Spectrum irradiance(World const& world, PhotonMap const& map, Vec3 p, Vec3 n, EstimateRule const& rule,
                    NearestPhotons& nearest, RayStats& stats);

}  // namespace nephroid
