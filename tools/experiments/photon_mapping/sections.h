// The sections of docs/experiments/photon-mapping.md, in their order. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void whitted_and_paths(Lab const& lab);
void photons_and_paths(Lab const& lab);
void estimates_shown(Lab const& lab);
void pictures_of_the_report(Lab const& lab);
void bias_and_noise(Lab const& lab);
void kernels(Lab const& lab);
void aimed_paths(Lab const& lab);
void progressive_passes(Lab const& lab);
void equal_time(Lab const& lab);

}  // namespace nephroid::experiment
