// Files that a command is going to write, held against the file system, against each other and against what it reads,
// before hours of work.
#pragma once

#include "math/vec.h"

#include <array>
#include <string>
#include <vector>

namespace nephroid::cli {

enum class FileRole { Input, FilmInput, Output, FilmOutput };
struct NamedFile {
    std::string option, path;
    FileRole role;
};

/// "a.film.exr"
bool is_film_name(std::string const& path);
/// ".exr", in lower case
std::string extension_of(std::string const& path);

/// Throws Error(Io) when `file` could not be written in the end: no folder, no regular file, a name that is too long (a
/// checkpoint also has names with suffixes).
void check_target(std::string const& option, std::string const& file, bool checkpoint = false);
/// The same for pictures and films, whose extension must be known. `replay`: a path could be written as well, and the message
/// says so.
void check_outputs(std::vector<std::string> const& outputs, bool replay = false);
/// Throws Error(Limit) for a picture that its format cannot hold.
void check_output_size(std::vector<std::string> const& outputs, std::array<int, 4> crop);
/// Throws Error(Input) when a file is written twice, or written and read. A film may take the place of one that it
/// contains.
void check_conflicts(std::vector<NamedFile> const& files);

/// Where a written file is, on stdout.
void print_written(std::string const& file);

/// The outputs by their roles.
void add_outputs(std::vector<NamedFile>& files, std::vector<std::string> const& outputs);

}  // namespace nephroid::cli
