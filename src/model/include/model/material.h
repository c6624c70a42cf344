// From a material and a hit to a small scattering value: its textures are evaluated once, here.
#pragma once

#include "model/bsdf.h"
#include "model/texture.h"

namespace nephroid {

/// Follows mixes down to one material: `u` in [0,1) decides, and is stretched to be fresh for the next level, or for the caller.
MaterialId resolve_mix(Assets const& assets, MaterialId id, TexturePoint const& at, double& u);
/// The probability with which resolve_mix ends at an interface: the share of light that passes as if nothing were there.
float interface_share(Assets const& assets, MaterialId id, TexturePoint const& at);

/// The probability with which it ends at a surface that is not near-specular (BsdfTraits): where photons stay.
float spreading_share(Assets const& assets, MaterialId id, TexturePoint const& at, Wavelengths const& lambda);

/// Fills `bsdf` in place. False for an interface: light goes on. `id` must not be a mix (see resolve_mix).
bool make_bsdf(Assets const& assets, MaterialId id, TexturePoint const& at, Wavelengths const& lambda,
               Bsdf& bsdf);

/// The same for a material that is plain (MaterialData), by its reflectance.
inline void make_plain_bsdf(RuntimeSpectrum const& reflectance, Wavelengths const& lambda, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{clamp(reflectance.sample(lambda), 0.0f, 1.0f)});
}

/// Indices of refraction by lane. In rgb mode one index serves all lanes, the middle one: a glass has no colour of its own.
inline Spectrum index_lanes(RuntimeSpectrum const& eta, Wavelengths const& lambda) {
    return lambda.is_rgb() ? Spectrum(eta.rgb().y) : eta.sample(lambda);
}

}  // namespace nephroid
