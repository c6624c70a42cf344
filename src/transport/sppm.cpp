// Progressive photon mapping (Hachisuka et al. 2008) in its probabilistic form (Knaus & Zwicker 2011): a pass sees each pixel once
// and reads what its own photons say there, within a radius that depends on the pass's number alone.
#include "photon_maps.h"
#include "photon_view.h"
#include "walk.h"

namespace nephroid {

SeenLight radiance(SppmIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov) {
    if (p.visualize != PhotonView::None) return show_photons(p.visualize, p.max_depth, c, ray, aov);
    SeenLight seen;
    Walk walk = Walk::from_camera(c, ray);
    Vertex v;
    auto const most = static_cast<std::uint32_t>(p.max_depth);
    for (;;) {
        // Emission is seen by specular chains, and by near-specular ones as light sampling at their last vertex left it.
        if (!advance(c, walk, EmissionWeight::Mis, v, seen[walk.path_class.ends_on_light()])) break;
        bool const scatters = prepare(c, walk, v);
        if (aov) record_first_hit(c, walk, scatters, v, aov);
        if (!scatters || walk.vertex >= most) break;
        if (!v.is.delta) add_direct(c, walk, v, true, seen);
        if (!v.is.near_specular) {
            PhotonMaps const& maps = *c.photons;
            Estimate const caustic = from_caustics(c, walk, v, most);
            Estimate const global = reflected(c, walk, v, maps.global, maps.global_rule, most);
            seen[LightClass::Caustic] += walk.beta * caustic.radiance;
            seen[LightClass::Indirect] += walk.beta * global.radiance;
            if (aov) record_estimates(caustic, global, *aov);
        }
        // A delta part of the surface is followed; the rest has been estimated, but for emission that scattering finds (MIS).
        if (!scatter(c, walk, v)) break;
        if (!walk.path_class.all_specular()) {
            if (c.world.may_meet_emission(walk.ray))
                advance(c, walk, EmissionWeight::Mis, v, seen[LightClass::Direct]);
            break;
        }
    }
    return seen;
}

}  // namespace nephroid
