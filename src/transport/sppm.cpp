// Progressive photon mapping (Hachisuka et al. 2008) in its probabilistic form (Knaus & Zwicker 2011): a pass sees each pixel once
// and reads what its own photons say there, within a radius that depends on the pass's number alone. Many paths in step.
#include "in_step.h"
#include "photon_maps.h"
#include "photon_view.h"

namespace nephroid {

namespace {

/// What photons say at the vertex, unless it is for others to follow the path on.
void estimate(PathInFlight& path, std::uint32_t most) {
    auto& [c, walk, met, v, seen, aov] = path;
    if (v.is.near_specular) return;
    if (v.in_lanes) orient(walk, v);
    Estimate const caustic = from_caustics(c, walk, v, most);
    Estimate const global = from_indirect(c, walk, v, most);
    seen[LightClass::Caustic] += walk.beta * caustic.radiance;
    seen[LightClass::Indirect] += walk.beta * global.radiance;
    if (aov) record_estimates(caustic, global, *aov);
}

/// Emission that scattering finds (MIS) after all else has been estimated.
void find_emission(PathInFlight& path) {
    if (path.c.world.may_meet_emission(path.walk.ray))
        advance(path.c, path.walk, EmissionWeight::Mis, path.v, path.seen[LightClass::Direct]);
}

}  // namespace

void follow_paths(SppmIntegrator const& p, std::span<PathInFlight*> paths) {
    if (paths.empty()) return;
    if (p.visualize != PhotonView::None) {
        for (PathInFlight* path : paths)
            path->seen = show_photons(p.visualize, p.max_depth, path->c, path->walk.ray, path->aov);
        return;
    }
    auto const most = static_cast<std::uint32_t>(p.max_depth);
    bool const lanes = goes_in_lanes(paths.front()->c);
    auto const photons = [&](PathInFlight& path) { estimate(path, most); };
    for (std::uint32_t vertex = 0; !paths.empty(); ++vertex) {
        trace_rays(paths);
        // Emission is seen by specular chains, and by near-specular ones as light sampling at their last vertex left it.
        paths = keep(paths, [&](PathInFlight& path) {
            return arrive(path, EmissionWeight::Mis, lanes) && vertex < most;
        });
        auto const [together, singly] = split(paths);
        paths = joined({scatter_together(together, {}, photons), scatter_singly(singly, {}, photons)});
        // A delta part of the surface is followed; the rest has been estimated.
        paths = keep(paths, [&](PathInFlight& path) {
            if (path.walk.path_class.all_specular()) return true;
            find_emission(path);
            return false;
        });
    }
}

}  // namespace nephroid
