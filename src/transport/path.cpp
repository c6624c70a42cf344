// Path tracing (Kajiya 1986) with next-event estimation and multiple importance sampling; PBRT 4th ed., 13.4.
#include "walk.h"

namespace nephroid {

SeenLight radiance(PathIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov) {
    EmissionWeight const weight = !p.sample_lights    ? EmissionWeight::All
                                  : p.sample_bsdf_mis ? EmissionWeight::Mis
                                                      : EmissionWeight::SpecularOnly;
    SeenLight seen;
    Walk walk = Walk::from_camera(c, ray);
    Vertex v;
    for (;;) {
        // The ray finds a surface, and what that surface (or the environment) emits.
        if (!advance(c, walk, weight, v, seen[walk.path_class.ends_on_light()])) break;
        bool const scatters = prepare(c, walk, v);
        if (aov) record_first_hit(c, walk, scatters, v, aov);
        // A path of max_depth bounces has max_depth + 1 segments; emission at its end is in already.
        if (!scatters || walk.vertex >= static_cast<std::uint32_t>(p.max_depth)) break;
        // Next-event estimation: one more segment, aimed at a light.
        if (p.sample_lights && !v.is.delta) add_direct(c, walk, v, p.sample_bsdf_mis, seen);
        // The path goes on by scattering, and ends by chance.
        if (!scatter(c, walk, v) || !survives(c, walk, p.roulette)) break;
    }
    return seen;
}

}  // namespace nephroid
