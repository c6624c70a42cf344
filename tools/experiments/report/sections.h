// The figures of docs/report that no other page shows, in their order. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void path_schematic(Lab const& lab);             // Figure 1
void three_spheres(Lab const& lab);              // 2
void interreflection(Lab const& lab);            // 3
void emissive_shapes(Lab const& lab);            // 4
void furnace_table(Lab const& lab);              // the report's furnace
void soft_shadow_trials(Lab const& lab);         // 6
void box_light_wrong_and_right(Lab const& lab);  // 7, 8
void stratified_points(Lab const& lab);          // 11
void creature_in_the_box(Lab const& lab);        // 12, 13
void faulty_basis(Lab const& lab);               // 14, 15
void hemispheres_shown(Lab const& lab);          // what it left to do

}  // namespace nephroid::experiment
