// A mesh as mirror and as glass, at 10 and 50 samples a pixel.
#pragma once

#include "lab.h"
#include "measure.h"

#include <string>

namespace nephroid::experiment {

struct MeshFigure {
    std::string sheet, alt;  // the picture's name on the page, and what it shows
    Setup mirror, glass;     // of one size
    std::string limit = {};  // directives of what comes closer to the limit than paths do; else paths, many
};
/// The sheet, with pictures in the limit beside, and a table of errors and times.
void mesh_pictures(Lab const& lab, MeshFigure const& figure);

}  // namespace nephroid::experiment
