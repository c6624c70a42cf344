#include "casts.h"

#include "model/microfacet.h"
#include "scene/match.h"

#include <cmath>

namespace nephroid {

namespace {

/// The least value of a float texture, as far as one can tell without a place: 0 where it varies.
float least(Assets const& assets, TextureId id, float otherwise) {
    if (!id.valid()) return otherwise;
    TextureData const& t = assets.data(id);
    return t.flat ? clamp(t.value, 0.0f, 1.0f) : 0.0f;
}
/// … and whether it may be above 0.
bool may_be_positive(Assets const& assets, TextureId id, float otherwise) {
    if (!id.valid()) return otherwise > 0.0f;
    TextureData const& t = assets.data(id);
    return !t.flat || t.value > 0.0f;
}

/// Facets as narrow as they get, as MaterialPoint::facets makes them.
Microfacets narrowest(Assets const& assets, Roughness const& r) {
    Microfacets m;
    if (!r.u.valid() && !r.v.valid()) return m;
    auto const alpha = [&](float x) { return r.remap ? std::sqrt(x) : x; };
    m.ax = alpha(least(assets, r.u.valid() ? r.u : r.v, 0.0f));
    m.ay = r.u.valid() && r.v.valid() ? alpha(least(assets, r.v, 0.0f)) : m.ax;
    return m;
}

/// An index of 1 somewhere lets light pass unbent, however rough the surface is.
bool may_be_unbent(Spd const& eta) {
    auto const* constant = std::get_if<ConstantSpd>(&eta);
    return !constant || constant->value == 1.0f;
}

bool specular(Assets const& assets, MetallicRoughnessMaterial const& m) {
    Microfacets facets;
    facets.ay = sqr(least(assets, m.roughness, 1.0f));
    facets.ax = lerp(sqr(least(assets, m.anisotropy.strength, 0.0f)), facets.ay, 1.0f);
    float const coat = sqr(least(assets, m.clearcoat.roughness, 0.0f));
    bool const coated = may_be_positive(assets, m.clearcoat.factor, 0.0f);
    bool const transmits = may_be_positive(assets, m.transmission.factor, 0.0f);
    // All of it metal or glass, without a diffuse part beside.
    bool const bare = transmits || may_be_positive(assets, m.metallic, 1.0f);
    return facets.smooth() || (bare && facets.near_specular()) || (coated && coat < 1e-3f) ||
           (transmits &&
            (m.index.dispersion > 0.0f || std::abs(m.index.ior - 1.0f) < 1e-2f || m.index.ior < 1.0f));
}

}  // namespace

bool may_be_specular(Assets const& assets, MaterialKind const& kind) {
    return match(
        kind, [](ThinDielectricMaterial const&) { return true; },
        [&](DielectricMaterial const& m) {
            return narrowest(assets, m.roughness).near_specular() || may_be_unbent(m.eta) ||
                   m.interior.priority > 0;  // nested bodies may have the same index
        },
        [&](ConductorMaterial const& m) { return narrowest(assets, m.roughness).near_specular(); },
        [&](CoatedDiffuseMaterial const& m) { return narrowest(assets, m.coat.roughness).smooth(); },
        [&](CoatedConductorMaterial const& m) {
            Microfacets const coat = narrowest(assets, m.coat.roughness);
            return coat.smooth() ||
                   (coat.near_specular() && narrowest(assets, m.conductor.roughness).near_specular());
        },
        [&](PlasticMaterial const& m) { return narrowest(assets, m.roughness).smooth(); },
        [&](MetallicRoughnessMaterial const& m) { return specular(assets, m); },
        [](auto const&) { return false; });
}

}  // namespace nephroid
