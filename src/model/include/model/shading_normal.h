// Normals that are not the surface's own: pictures of normals, and bumps.
#pragma once

#include "model/assets.h"
#include "model/surface.h"
#include "model/texture.h"

namespace nephroid {

/// Turns s.ns, and s.dpdu and s.dpdv with it, as the material's normal map or displacement says; the new normal stays on the side
/// of the old one. `s` must have tangents. A surface without a usable frame stays as it is.
void perturb_normal(Assets const& assets, MaterialId id, TexturePoint const& at, SurfacePoint& s);

}  // namespace nephroid
