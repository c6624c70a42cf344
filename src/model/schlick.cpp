// Albedos of Schlick's microfacets, by quadrature once.
#include "model/schlick.h"

#include "model/angle_table.h"
#include "model/microfacet.h"

namespace nephroid {

namespace {

constexpr float kSmooth = 1e-3f;

SchlickAlbedo mirror(float mu) { return {1.0f, schlick_weight(mu)}; }

/// Mean over visible normals of G / G1 (PBRT 4th ed., 9.6.5), each with the F of its kind. The azimuth is periodic and even, where
/// equal steps converge fastest.
SchlickAlbedo integrate(float mu, float alpha) {
    if (alpha < kSmooth) return mirror(mu);
    constexpr int kAzimuths = 8, kHeights = 32;
    Microfacets const m{alpha, alpha};
    Vec3 const wo{std::sqrt(1.0f - mu * mu), 0.0f, mu};
    float const g1 = microfacet_g1(m, wo);
    SchlickAlbedo sum{0, 0};
    for (int i = 0; i < kAzimuths; ++i)
        for (int k = 0; k < kHeights; ++k) {
            Vec2 const u{(static_cast<float>(i) + 0.5f) / (2.0f * kAzimuths),
                         (static_cast<float>(k) + 0.5f) / kHeights};
            Vec3 const wm = sample_microfacet(m, wo, u);
            float const c = dot(wo, wm);
            Vec3 const wi = wm * (2.0f * c) - wo;
            if (!(wi.z > 0.0f)) continue;
            float const weight = microfacet_g(m, wo, wi) / g1;
            sum = sum + SchlickAlbedo{weight, weight * schlick_weight(c)};
        }
    return sum * (1.0f / (kAzimuths * kHeights));
}

AngleTable<SchlickAlbedo> const kTable(0.0f, [](float mu, float roughness) {
    return integrate(mu, sqr(roughness));
});

}  // namespace

SchlickAlbedo schlick_albedo(float mu, float alpha) {
    return alpha < kSmooth ? mirror(mu) : kTable(mu, std::sqrt(alpha));
}
SchlickAlbedo schlick_average(float alpha) {
    return alpha < kSmooth ? SchlickAlbedo{1.0f, 1.0f / 21.0f} : kTable.average(std::sqrt(alpha));
}

}  // namespace nephroid
