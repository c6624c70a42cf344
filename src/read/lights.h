// Lights, and the emission of shapes.
#pragma once

#include "params.h"

namespace nephroid {

LightKind make_light(std::string const& type, Params& params);
AreaLight make_area_light(std::string const& type, Params& params);

}  // namespace nephroid
