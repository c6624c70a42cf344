// Checkpoints: a film on disk in two generations, so that whenever the program or the machine dies, one of them is whole.
#pragma once

#include "film/film.h"

#include <filesystem>
#include <string>

namespace nephroid {

/// Writes the film to `path`; the film that was there becomes `<path>.previous`, unless it is damaged: a whole generation
/// never makes way for one that is not. `newest_is_whole`: the caller wrote `path` himself, so that there is no need to
/// read it. Throws Error(Io); whatever failed, one generation is whole, as `path`, `<path>.previous` or `<path>.next`.
void write_checkpoint(std::filesystem::path const& path, Film const& film, bool newest_is_whole = false);

/// The film at `path`. When it is missing or damaged, the error says which other generation could serve: that is for the
/// user to decide, because passes are lost.
Film read_checkpoint(std::filesystem::path const& path);

/// The generation beside `path` that is whole and has the most passes; of the render of `like`, if that is given. Empty
/// when there is none.
std::filesystem::path other_generation(std::filesystem::path const& path, FilmHeader const* like = nullptr);

}  // namespace nephroid
