// Writing scenes: a Scene as files that other programs read.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid {

struct WriteOptions {
    /// Only what pbrt-v4 itself knows: shapes, materials and settings of ours are replaced by the nearest thing, with a note.
    /// Otherwise everything is kept, and reading the file gives a scene of the same hash.
    bool portable = false;
};

/// Writes `scene`, settings and all, as pbrt-v4 text. Large meshes become PLY files in a folder beside it, named like it; pictures and
/// other files are named where they are. Returns what was replaced. All or nothing: throws Error(Io), or Error(Input) for what has no form in pbrt's language.
std::vector<Note> write_pbrt(Scene const& scene, std::filesystem::path const& path,
                             WriteOptions const& options = {});

}  // namespace nephroid
