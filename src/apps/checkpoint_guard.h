// Hours of work lie in a checkpoint. Before a render writes one, what is there already must be its own; before it goes on
// from one, that must be of the same render. Both refuse with Error(Input) that says what differs and what to do.
#pragma once

#include "film/film.h"

#include <string>

namespace nephroid::cli {

/// Reads the film of --resume and adds it to the job's empty film.
void resume(std::string const& file, Film& film);

/// `film` is what the render starts from: the file may hold no pass that is not in it. `resumed` is the file of --resume, or
/// empty.
void guard_checkpoint(std::string const& file, std::string const& resumed, Film const& film);

}  // namespace nephroid::cli
