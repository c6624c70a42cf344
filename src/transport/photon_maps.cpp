#include "photon_maps.h"

namespace nephroid {

Spectrum from_global_map(PathContext& c, Walk const& walk, Vertex const& v) {
    PhotonMaps const& maps = *c.photons;
    // Precomputed irradiance does not know which of it is the hero's alone.
    if (auto const* diffuse = std::get_if<DiffuseBsdf>(&v.bsdf); diffuse && !walk.hero_only)
        return diffuse->reflectance * maps.irradiance.at(v.hit.s.p, facing_normal(walk, v), *c.nearest) *
               kInvPi;  // L = rho E / pi
    return reflected(c, walk, v, maps.global, maps.global_rule, kAnyLength).radiance;
}

Estimate from_indirect(PathContext& c, Walk const& walk, Vertex const& v, std::uint32_t most_bounces) {
    PhotonMaps const& maps = *c.photons;
    Estimate e = reflected(c, walk, v, maps.global, maps.global_rule, most_bounces);
    if (maps.further.size() == 0) return e;
    Estimate const further = reflected(c, walk, v, maps.further, maps.further_rule, most_bounces);
    return {e.radiance + further.radiance, max(e.radius, further.radius), e.photons + further.photons};
}

Estimate from_caustics(PathContext& c, Walk const& walk, Vertex const& v, std::uint32_t most_bounces) {
    PhotonMaps const& maps = *c.photons;
    return reflected(c, walk, v, maps.caustics_from_global ? maps.global : maps.caustic, maps.caustic_rule,
                     most_bounces);
}

}  // namespace nephroid
