// `--set key=value`: any setting that a scene file can make, from the command line.
#pragma once

#include "scene/settings.h"

#include <string>

namespace nephroid::cli {

/// Names are those of scene files. Throws Error(Input) for an unknown key (with the nearest known one) or a bad value.
void apply_override(Settings& settings, std::string const& assignment);
/// "path", "whitted", "direct", "photonmap", "sppm", "lightpath"; the colours follow where nobody chose them. Throws Error(Input)
/// for another name.
void set_integrator(Settings& settings, std::string const& name);
/// All keys with a word on each, for --help.
std::string override_help();

}  // namespace nephroid::cli
