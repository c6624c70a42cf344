// Checkpoints: a film on disk in two generations, so that whenever the program or the machine dies, one of them is whole.
#pragma once

#include "film/film.h"

#include <filesystem>
#include <string>

namespace nephroid {

/// Writes the film to `path`; the film that was there becomes `<path>.previous`. Throws Error(Io), and then `path` or
/// `<path>.previous` is what it was.
void write_checkpoint(std::filesystem::path const& path, Film const& film);

/// Which file a checkpoint came from.
struct CheckpointSource {
    std::filesystem::path file;
    std::string problem;  // why it is not the newest one; empty when it is
};
/// The newest generation that is whole. Throws the error of `path` itself when none is.
Film read_checkpoint(std::filesystem::path const& path, CheckpointSource* source = nullptr);

}  // namespace nephroid
