// The points of the unit square that samplers make, as a plot.
#pragma once

#include "page.h"
#include "sampling/path_sampler.h"

#include <string>
#include <vector>

namespace nephroid::experiment {

struct NamedSequence {
    std::string name;
    Sequence sequence;
    int cells;  // of the grid that is drawn, along an edge
};
std::vector<NamedSequence> const& shown_sequences();
/// Of a pixel's first two-dimensional draw.
std::vector<Vec2> first_points(Sequence const& sequence, std::uint64_t pixel, int count);

/// 64 points of each (Figure 11).
void points_shown(Page& page);

}  // namespace nephroid::experiment
