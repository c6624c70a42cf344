#include "photon_view.h"

namespace nephroid {

namespace {

constexpr std::uint32_t kAnyLength = ~0u;

/// Radiance of a diffuse surface of the same albedo in the light that was precomputed.
Spectrum precomputed(PathContext& c, Walk const& walk, Vertex const& v) {
    PhotonMaps const& maps = *c.photons;
    Vec3 const n = dot(walk.ray.d, v.hit.s.ng) < 0.0f ? v.hit.s.ng : -v.hit.s.ng;
    return albedo(v.bsdf, v.wo_local) * maps.irradiance.at(v.hit.s.p, n, *c.nearest) * kInvPi;
}

}  // namespace

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
                seen[LightClass::Caustic] +=
                    walk.beta * reflected(c, walk, v, maps.caustic, maps.caustic_rule, kAnyLength).radiance;
            if (view == PhotonView::Radiance)
                seen[LightClass::Indirect] += walk.beta * precomputed(c, walk, v);
        }
        if (walk.vertex >= static_cast<std::uint32_t>(max_depth) || !scatter(c, walk, v) ||
            !walk.path_class.all_specular())
            break;
    }
    return seen;
}

}  // namespace nephroid
