// The figures of docs/report that no other page shows, in their order. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void path_schematic(Lab const& lab);

}  // namespace nephroid::experiment
