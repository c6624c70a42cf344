#include "density.h"

#include "model/adjoint.h"

namespace nephroid {

namespace {
/// Epanechnikov, the others are to come.
float kernel(Kernel, float x2) { return 2.0f * kInvPi * (1.0f - x2); }
}  // namespace

Estimate reflected(PathContext&, Walk const& walk, Vertex const& v, PhotonMap const& map,
                   EstimateRule const& rule, std::uint32_t most_bounces) {
    Estimate e;
    e.radius = rule.radius;
    map.within(v.hit.s.p, rule.radius, [&](std::uint32_t i, float d2) {
        Photon const& photon = map[i];
        if (photon.bounces() + 1 + walk.vertex > most_bounces) return;
        Vec3 const wi = photon.wi();
        float const cosine = abs_dot(wi, v.hit.s.ng);
        if (!(cosine > 0.0f)) return;
        Spectrum const f = evaluate(v.bsdf, v.wo_local, v.frame.to_local(wi), Mode::Radiance);
        float const hero = walk.hero_only && photon.hero_only() ? 0.25f : 1.0f;
        e.radiance += f * photon.power() *
                      (hero * abs_dot(wi, v.hit.s.ns) / cosine * kernel(rule.kernel, d2 / sqr(rule.radius)) /
                       sqr(rule.radius));
        ++e.photons;
    });
    return e;
}

Spectrum irradiance(World const&, PhotonMap const&, Vec3, Vec3, EstimateRule const&, NearestPhotons&,
                    RayStats&) {
    return {};
}

}  // namespace nephroid
