// The repository's scenes as experiments use them: read faithfully, or written as text around what scenes/include holds.
#pragma once

#include "measure.h"

#include <filesystem>
#include <string>

namespace nephroid::experiment {

/// scenes/, for meshes and includes.
std::filesystem::path scenes_folder();

/// prepare(), for scenes that mean what they say: throws Error(Input) with the first note that the reader had.
Setup faithful(std::string const& pbrt, std::filesystem::path const& folder);
/// The same for a file of scenes/.
Setup prepare_file(std::string const& name);
/// … all of whose notes, of which there is one at least, say this.
Setup prepare_noted(std::string const& name, std::string const& note);

/// The empty Cornell box with its camera (folder: scenes_folder()), in what was measured: mm.
std::string cornell(int pixels);

}  // namespace nephroid::experiment
