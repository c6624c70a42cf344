// Contact sheets: pictures of one size in rows and columns, with words above and beside them, as one PNG.
#pragma once

#include "measure.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::experiment {

struct SheetRow {
    std::string label;              // its words one below the other
    std::vector<Picture> pictures;  // one a column, all of one size
    double exposure = 1;
};
/// sRGB, 8 bits; one channel when there are no colours. Labels: small letters, digits and . - / , + % ( ) =.
void write_sheet(std::filesystem::path const& path, std::vector<std::string> const& columns,
                 std::vector<SheetRow> const& rows);

/// What leaves this share of the picture's pixels below white.
double exposure_for(Picture const& p, double share = 0.99);

}  // namespace nephroid::experiment
