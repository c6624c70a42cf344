// The sections of docs/experiments/photon-mapping.md that are not figures of the report, in their order. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void bias_and_noise(Lab const& lab);
void kernels(Lab const& lab);
void aimed_paths(Lab const& lab);
void progressive_passes(Lab const& lab);
void equal_time(Lab const& lab);

}  // namespace nephroid::experiment
