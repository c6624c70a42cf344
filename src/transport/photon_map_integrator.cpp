// Photon mapping (Jensen 1996; 2001, chapter 9). Light that a surface reflects is split so that each kind is found in the way that
// suits it, and no path is found twice:
//
//   L D          direct      lights are sampled, and found by scattering (MIS)
//   L S+ D       caustic     estimated from the caustic map                             (Jensen 2001, 9.3.3)
//   L ... D D    indirect    gather rays, which end in the light of the global map       (9.3.4)
//   ... S        specular    followed: what the ray finds next is split in the same way  (9.3.2)
//
// A gather ray looks up irradiance that was precomputed at photons (Christensen 1999). One that is shorter than the photons'
// spacing would see their blotches, so it goes on as a path: at its end, too, lights are sampled and caustics estimated.
#include "photon_maps.h"
#include "photon_view.h"
#include "walk.h"

namespace nephroid {

namespace {

/// L ... D D: what a gather ray, which has just left the first D, brings.
void gather(PhotonMapIntegrator const& p, PathContext& c, Walk walk, SeenLight& seen) {
    PhotonMaps const& maps = *c.photons;
    Vertex v;
    Spectrum unseen;
    float since_diffuse = 0;  // distance from the last D
    for (;;) {
        // Light that the last D could be lit by directly was sampled there as well; what came by S is in its caustic map.
        bool const straight = !walk.path_class.specular_since();
        Spectrum& found = straight ? seen[walk.path_class.ends_on_light()] : unseen;
        float const before = walk.cone;
        if (!advance(c, walk, straight ? EmissionWeight::Mis : EmissionWeight::None, v, found)) return;
        if (!prepare(c, walk, v)) return;
        bool const last = walk.vertex >= static_cast<std::uint32_t>(p.max_depth);
        since_diffuse += walk.cone - before + v.hit.t;
        if (!v.is.near_specular) {
            if (last || since_diffuse > maps.shortest_gather) {
                seen[LightClass::Indirect] += walk.beta * from_global_map(c, walk, v);
                // The global map leaves out what a delta part of this surface shows.
                if (last || std::holds_alternative<DiffuseBsdf>(v.bsdf) || !scatter(c, walk, v) ||
                    !walk.path_class.specular_since())
                    return;
                continue;
            }
            seen[LightClass::Indirect] += walk.beta * (sample_direct(c, walk, v, true) +
                                                       from_caustics(c, walk, v, kAnyLength).radiance);
        }
        if (last || !scatter(c, walk, v) || !survives(c, walk, {})) return;
        if (!walk.path_class.specular_since()) since_diffuse = 0;
    }
}

/// Along specular chains to the first D, and all light that it reflects.
void look(PhotonMapIntegrator const& p, PathContext& c, Walk walk, std::uint32_t gather_rays, AovSample* aov,
          SeenLight& seen) {
    auto const most = static_cast<std::uint32_t>(p.max_depth);  // mirrors and glass in a row
    Vertex v;
    for (;;) {
        if (!advance(c, walk, EmissionWeight::Mis, v, seen[walk.path_class.ends_on_light()])) return;
        bool const scatters = prepare(c, walk, v);
        if (aov) record_first_hit(c, walk, scatters, v, aov);
        if (!scatters) return;
        if (!v.is.delta) add_direct(c, walk, v, true, seen);
        if (!v.is.near_specular) break;
        if (walk.vertex >= most || !scatter(c, walk, v)) return;
    }
    Estimate const caustic = from_caustics(c, walk, v, kAnyLength);
    seen[LightClass::Caustic] += walk.beta * caustic.radiance;
    Estimate global;
    if (!p.final_gather) {
        global = from_indirect(c, walk, v, kAnyLength);
        seen[LightClass::Indirect] += walk.beta * global.radiance;
        gather_rays = 1;  // for lights that scattering finds, and for delta parts
    }
    if (aov) record_estimates(caustic, global, *aov);
    SeenLight brought;
    for (std::uint32_t s = 0; s < gather_rays; ++s) {
        PathSampler sampler = c.sampler.branch(s, gather_rays);
        PathContext branch = c.with(sampler);
        Walk next = walk;
        if (!scatter(branch, next, v)) {
            c.tainted = c.tainted || branch.tainted;
            continue;
        }
        if (next.path_class.all_specular() && next.vertex > most) continue;
        if (next.path_class.all_specular())
            look(p, branch, next, 1, nullptr, brought);
        else if (p.final_gather)
            gather(p, branch, next, brought);
        else if (c.world.may_meet_emission(next.ray))
            advance(branch, next, EmissionWeight::Mis, v, brought[LightClass::Direct]);
        c.tainted = c.tainted || branch.tainted;
    }
    brought *= 1.0f / static_cast<float>(gather_rays);
    seen += brought;
}

}  // namespace

SeenLight radiance(PhotonMapIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov) {
    if (p.visualize != PhotonView::None) return show_photons(p.visualize, p.max_depth, c, ray, aov);
    SeenLight seen;
    look(p, c, Walk::from_camera(c, ray), static_cast<std::uint32_t>(p.gather_samples), aov, seen);
    return seen;
}

}  // namespace nephroid
