// The figures of docs/report that no other page shows, in their order. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void path_schematic(Lab const& lab);       // Figure 1
void creature_in_the_box(Lab const& lab);  // 12 and 13
void faulty_basis(Lab const& lab);         // 14 and 15

}  // namespace nephroid::experiment
