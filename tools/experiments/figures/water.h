// Water in the Cornell box, as the report had it.
#pragma once

#include <string>

namespace nephroid::experiment {

/// Up to about 180 mm deep, behind a pane of its own at the open side; waves that lie flat where they meet the pane.
std::string water_in_the_box();

}  // namespace nephroid::experiment
