// Points on emitting surfaces as a receiver sees them: drawn, and the density of those that a ray has found.
#pragma once

#include "light_table.h"
#include "scene/settings.h"
#include "world_parts.h"

namespace nephroid {

/// False where nothing of the emitter can be seen from there. Fills all of s but its radiance; pdf without the choice of the
/// light.
bool sample_emitter(LightTable const& lights, WorldParts const& parts, LightEntry const& e,
                    Receiver const& to, ShapeSampling how, Vec2 u, LightSample& s);

/// The density with which sample_emitter finds the point that a ray along the unit vector w has found.
float emitter_pdf(LightTable const& lights, WorldParts const& parts, LightEntry const& e, Receiver const& to,
                  ShapeSampling how, SurfaceHit const& hit, Vec3 w);

}  // namespace nephroid
