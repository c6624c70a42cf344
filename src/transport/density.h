// Density estimates: from photons to what a surface reflects (Jensen 2001, 7.2).
//
//   L(x, wo) = sum over photons of f(x, wo, wi) dPhi K(d / r) / r^2                                       (1)
//
// with a kernel K that integrates to 1 over the unit disk, and r either given or the distance of the k-th nearest photon, which then
// does not count. That it must not: squared distances are the arrivals of a Poisson process of some rate; given the k-th arrival T, the
// k - 1 before it lie as independent draws of that rate over [0, T], so that m accepted ones among them, whatever the others are
// rejected for, have the mean (k - 1) Lambda_a(T) / Lambda(T); Lambda(T) is distributed as Gamma(k), for which the mean of
// (k - 1) / Lambda is 1. Hence (1) has no bias on an even field, also where photons of other surfaces make up part of the k, and
// also within a fixed share of the radius (`shrink`).
//
// A photon is accepted where it landed on the same side of much the same plane: normals within 60 degrees, and no farther from the
// tangent plane than a quarter of the radius.
#pragma once

#include "transport/photon_map.h"
#include "walk.h"

namespace nephroid {

/// For most_bounces: what maps hold was cut when it was shot.
inline constexpr std::uint32_t kAnyLength = ~0u;

/// How a map is asked.
struct EstimateRule {
    Kernel kernel = Kernel::Epanechnikov;
    std::uint32_t k =
        0;  // the nearest k, of which the last gives the radius and does not count; 0 = all within the radius
    float radius = 0;  // at most; scene units
    float shrink = 1;  // of the radius that the k-th gives: how passes after the first look closer
    bool edge_correction = false;
    bool only_caustics = false;  // of a map that holds others as well
};
struct Estimate {
    Spectrum radiance;          // towards v.wo
    float radius = 0;           // that was used; 0 where the map is empty
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

/// Irradiance on the side of n at p, from photons that landed on that side: `radiance` is W/m^2 (per nm) here. Those in the hero lane
/// alone count for all lanes. `thinned` > 1: photons 0, thinned, 2 thinned … of the map do not count, and the others stand for them. That
/// is for places that were chosen from the photons: a place tells that a photon lies there, and to be the nearest place of somebody that
/// few others do; with them in it, an estimate by 50 photons is some percent too bright or too dark. Those that are no places know nothing.
Estimate irradiance(World const& world, PhotonMap const& map, Vec3 p, Vec3 n, EstimateRule const& rule,
                    NearestPhotons& nearest, RayStats& stats, std::uint32_t thinned = 0);

/// How much of the disk about p is surface with a normal like n that p sees: found by probing it with rays (64 places; 8 along the rim
/// tell whether the others are needed).
struct Coverage {
    float share = 1;       // weighed by the kernel
    Vec3 centre{0, 0, 0};  // of what is there: in its direction, of no particular length; 0 where all is
};
Coverage coverage(World const& world, Vec3 p, Vec3 n, float radius, Kernel kernel, RayStats& stats);

}  // namespace nephroid
