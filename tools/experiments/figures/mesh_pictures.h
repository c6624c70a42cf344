// A mesh as mirror and as glass, at 10 and 50 samples a pixel.
#pragma once

#include "lab.h"
#include "measure.h"

#include <cstdint>
#include <string>

namespace nephroid::experiment {

struct MeshFigure {
    std::string sheet, alt;    // the picture's name on the page, and what it shows
    Setup mirror, glass;       // of one size
    std::uint64_t half = 320;  // samples of each of the two renders that make the limit
};
/// The sheet, with pictures in the limit beside, and a table of errors and times.
void mesh_pictures(Lab const& lab, MeshFigure const& figure);

}  // namespace nephroid::experiment
