// From a material and a hit to a small scattering value: its textures are evaluated once, here.
#pragma once

#include "model/bsdf.h"
#include "model/texture.h"

#include <optional>

namespace nephroid {

/// Follows mixes down to one material: `u` in [0,1) decides, and is stretched on for the next level.
MaterialId resolve_mix(Assets const& assets, MaterialId id, TexturePoint const& at, float u);

/// Nothing for an interface: light goes on. `id` must not be a mix (see resolve_mix).
std::optional<Bsdf> make_bsdf(Assets const& assets, MaterialId id, TexturePoint const& at,
                              Wavelengths const& lambda);

}  // namespace nephroid
