// Films into files, one after the other: one that fails does not cost the others.
#pragma once

#include "film/develop.h"

#include <functional>
#include <string>
#include <vector>

namespace nephroid::cli {

/// Writes what can be written, and prints the path of each file that was. Returns the errors; `note` is told what was
/// written in another way than asked for.
std::vector<std::string> write_outputs(std::vector<std::string> const& outputs, Film const& film,
                                       DevelopSettings const& develop,
                                       std::function<void(std::string const&)> const& note);

/// What makes a picture that is not to be trusted, in words; empty for a good one.
std::string taint(Film const& film);

}  // namespace nephroid::cli
