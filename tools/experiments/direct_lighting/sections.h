// The sections of docs/experiments/direct-lighting.md, in their order. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void soft_shadows(Lab const& lab);
void box_light(Lab const& lab);
void strategies(Lab const& lab);
void samplers(Lab const& lab);
void light_shapes(Lab const& lab);
void many_lights(Lab const& lab);
void picture_light(Lab const& lab);

}  // namespace nephroid::experiment
