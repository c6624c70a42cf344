// Direct light alone: emission seen, and light that scatters once, found by light sampling, by BSDF sampling or by both
// (Veach 1997, 9.3).
// Mirrors and glass are followed by chance until the first surface that is neither.
#include "walk.h"

namespace nephroid {

SeenLight radiance(DirectIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov) {
    bool const sample_lights = p.strategy != DirectStrategy::Bsdf;
    bool const mis = p.strategy == DirectStrategy::Mis;
    EmissionWeight const weight = mis             ? EmissionWeight::Mis
                                  : sample_lights ? EmissionWeight::SpecularOnly
                                                  : EmissionWeight::All;
    SeenLight seen;
    Walk walk = Walk::from_camera(c, ray);
    bool scattered = false;
    Vertex v;
    for (;;) {
        if (!advance(c, walk, weight, v, seen[walk.path_class.ends_on_light()]) || scattered) break;
        bool const scatters = prepare(c, walk, v);
        if (aov) record_first_hit(c, walk, scatters, v, aov);
        if (!scatters || walk.vertex >= static_cast<std::uint32_t>(p.max_depth)) break;
        if (!v.is.delta) {
            if (sample_lights) add_direct(c, walk, v, mis, seen);
            scattered = true;  // one more segment, to meet emission by scattering
        }
        if (!scatter(c, walk, v)) break;
    }
    return seen;
}

}  // namespace nephroid
