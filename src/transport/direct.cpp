// Direct light alone: emission seen, and light that scatters once, each found by light and by BSDF sampling (Veach 1997, 9.3).
// Mirrors and glass are followed by chance until the first surface that is neither.
#include "walk.h"

namespace nephroid {

Spectrum radiance(DirectIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov) {
    Spectrum radiance;
    Walk walk = Walk::from_camera(ray, c.lambda);
    bool scattered = false;
    Vertex v;
    for (;;) {
        if (!advance(c, walk, EmissionWeight::Mis, v, radiance) || scattered) break;
        bool const scatters = prepare(c, walk, v);
        if (aov) record_first_hit(c, walk, scatters, v, aov);
        if (!scatters || walk.vertex >= static_cast<std::uint32_t>(p.max_depth)) break;
        if (!is_delta(v.bsdf)) {
            radiance += walk.beta * sample_direct(c, walk, v, true);
            scattered = true;  // one more segment, to meet emission by scattering
        }
        if (!scatter(c, walk, v)) break;
    }
    return radiance;
}

}  // namespace nephroid
