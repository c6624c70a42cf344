// A box that shines above a floor, and the ways to draw points on it.
#pragma once

#include "lab.h"
#include "measure.h"

#include <array>
#include <string>

namespace nephroid::experiment {

/// All ways; the last one is wrong.
inline constexpr std::array<char const*, 5> kBoxShapes{"area", "visiblearea", "projected", "solidangle",
                                                       "visibleunweighed"};
/// Independent light samples.
std::string box_samples(std::string const& shapes);
/// Receivers on the line y = 0.2, from under the box's middle to 2.5 sides beyond its edge.
Setup line_under_box(int pixels);

/// The floor at 4 samples, in all ways, and their errors (Figures 6 to 8).
void box_light_pictures(Lab const& lab);
/// Means along the line against the closed form.
void box_light_means(Lab const& lab);

}  // namespace nephroid::experiment
