#include "photon_view.h"

namespace nephroid {

SeenLight show_photons(PhotonView view, int max_depth, PathContext& c, Ray const& ray, AovSample* aov) {
    PhotonMaps const& maps = *c.photons;
    SeenLight seen;
    Spectrum unseen;
    Walk walk = Walk::from_camera(c, ray);
    Vertex v;
    while (advance(c, walk, EmissionWeight::None, v, unseen)) {
        bool const scatters = prepare(c, walk, v);
        if (aov) record_first_hit(c, walk, scatters, v, aov);
        if (!scatters) break;
        if (!v.is.near_specular) {
            if (view == PhotonView::Global || view == PhotonView::Both)
                seen[LightClass::Indirect] +=
                    walk.beta * reflected(c, walk, v, maps.global, maps.global_rule, kAnyLength).radiance;
            if (view == PhotonView::Caustic || view == PhotonView::Both)
                seen[LightClass::Caustic] += walk.beta * from_caustics(c, walk, v, kAnyLength).radiance;
            if (view == PhotonView::Radiance)
                seen[LightClass::Indirect] += walk.beta * from_global_map(c, walk, v);
        }
        if (walk.vertex >= static_cast<std::uint32_t>(max_depth) || !scatter(c, walk, v) ||
            !walk.path_class.all_specular())
            break;
    }
    return seen;
}

}  // namespace nephroid
