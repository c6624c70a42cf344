// Reading scenes: one entry for every format. What comes back has been checked for syntax, types and references;
// validate() (scene/scene.h) checks the rest.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace nephroid {

/// Reads a scene by its file's extension: .pbrt, .ray (SBT-raytracer), .ply, .obj, each also with .gz behind it. A bare mesh
/// file becomes a scene of a gray mesh under a constant sky, with a camera that frames it.
/// Throws Error(Input) as "file:line: what, and what to do", Error(Limit) for files beyond the limits of bytes.h and
/// Error(Io) when the file itself cannot be read.
Scene read_scene(std::filesystem::path const& path);

/// The same for a pbrt scene in memory. `name` is what messages call it, `folder` is where the files it names are.
Scene read_pbrt_string(std::string_view text, std::string name, std::filesystem::path folder);

}  // namespace nephroid
