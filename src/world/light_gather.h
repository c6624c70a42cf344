// Finds everything that emits in a scene and makes its light table.
#pragma once

#include "light_table.h"
#include "world_parts.h"

namespace nephroid {

/// What the object emits; returns its index. Throws Error with the light's place for emission that floats cannot hold.
std::uint32_t add_emitter(Scene const& scene, Assets& assets, LightTable& lights, ObjectRecord const& record);

/// Fills the table from all appearances of emitting objects and from the lights without a surface. Notes what was left out.
void gather_lights(Scene& scene, Assets& assets, WorldParts& parts, LightTable& lights,
                   BoundingSphere const& sphere);

}  // namespace nephroid
