// Sheen of fibres that stand up from the surface: the "Charlie" lobe (Conty Estevez & Kulla 2017, "Production
// Friendly Microfacet Sheen BRDF"; KHR_materials_sheen). D = (2 + 1/a) sin(theta_h)^(1/a) / 2 pi; shadowing
// is fitted.
//
// The fit lets more light out than came in where a < 0.07 and the view grazes (2.9 times as much for a =
// 0.005), so f is divided by what each of its two directions has too much, which keeps it reciprocal; for a
// >= 0.07 it is the paper's.
#pragma once

#include "math/vec.h"

namespace nephroid {

/// Below it the lobe is a line along the horizon that no float resolves: glTF's sheen roughness 0.07 and
/// less.
inline constexpr float kSheenAlphaMin = 0.005f;

/// Of white fibres, directions above the surface; the cosine is not contained. alpha in [kSheenAlphaMin, 1].
float sheen_brdf(float alpha, Vec3 wo, Vec3 wi);
/// Its directional albedo from cosine mu > 0, tabulated: at most 1, and never less than what sheen_brdf
/// scatters (to 0.01; tests).
float sheen_albedo(float alpha, float mu);

}  // namespace nephroid
