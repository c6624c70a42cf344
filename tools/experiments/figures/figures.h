// Figures of the report that more than one page shows. Each renders, measures and writes.
#pragma once

#include "lab.h"

namespace nephroid::experiment {

void naive_or_direct(Lab const& lab);         // Figure 5
void mirrors_and_glass(Lab const& lab);       // Figures 9 and 10
void whitted_and_paths(Lab const& lab);       // 16
void photons_and_paths(Lab const& lab);       // 17 to 19
void estimates_shown(Lab const& lab);         // 20 to 22
void pictures_of_the_report(Lab const& lab);  // 23 to 25
void hemispheres(Lab const& lab);             // uniform or by the cosine, which the report left to do

}  // namespace nephroid::experiment
