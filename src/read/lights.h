// Lights, and the emission of shapes.
#pragma once

#include "params.h"
#include "textures.h"

namespace nephroid {

LightKind make_light(std::string const& type, Params& params);
/// Its "L" may be a texture that was defined before it.
AreaLight make_area_light(std::string const& type, Params& params, Textures& textures);

}  // namespace nephroid
