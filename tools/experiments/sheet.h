// Contact sheets: pictures of one size in rows and columns, with words above and beside them, as one PNG.
#pragma once

#include "lab.h"
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

/// The same as a picture of the page, reduced by lab.enlarge; where lab.full is set, each picture goes there too, in full size and
/// with links on the page as a browser shows it.
void show_sheet(Lab const& lab, std::string const& name, std::string const& alt,
                std::vector<std::string> const& columns, std::vector<SheetRow> const& rows);
/// Each so many pixels along an edge become one.
Picture reduced(Picture const& p, int by);

/// Marks whose colours are already times their coverage (R G B A), over a picture.
Picture over(Image const& marks, Picture under);

/// What leaves this share of the picture's pixels below white.
double exposure_for(Picture const& p, double share = 0.99);

}  // namespace nephroid::experiment
