// The sections of docs/experiments/surfaces.md, in their order. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void material_balls(Lab const& lab);
void mesh_figure(Lab const& lab);
void roughness_sweep(Lab const& lab);
void white_furnace(Lab const& lab);
void prism(Lab const& lab);
void nested_dielectrics(Lab const& lab);

}  // namespace nephroid::experiment
