// Near misses: which known word did the user mean?
#pragma once

#include <string>
#include <vector>

namespace nephroid::cli {

/// The known word with the fewest edits.
std::string nearest(std::string const& word, std::vector<std::string> const& known);

}  // namespace nephroid::cli
