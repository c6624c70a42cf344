// Lamps as laboratories measure them: IESNA LM-63 of 1986, 1991, 1995, 2002 (and 2019, which writes the numbers alike).
// Photometric type C; TILT=NONE, or INCLUDE, whose factors are for lamps that are mounted tilted and are not applied.
#pragma once

#include "scene/light.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

struct IesFile {
    IntensityTable
        table;  // multiplier and ballast factors applied; all the way around, whatever symmetry the file uses
    double lamp_lumens =
        -1;  // of all lamps together, as the file says; below 0: not said (absolute photometry)
    std::vector<std::string> notes;  // "name:line: text"
};

/// Throws Error(Input) or Error(Limit) with "name:line: what, and what to do".
IesFile parse_ies(std::string_view text, std::string const& name);

}  // namespace nephroid
