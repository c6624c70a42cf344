// Writing scenes: a Scene as files that other programs read.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid {

struct WriteOptions {
    /// Only what pbrt-v4 itself knows: shapes, materials and settings of ours are replaced by the nearest
    /// thing, with a note. Otherwise everything is kept, and reading the file gives a scene of the same
    /// hash; but meshes without a face, which compile() leaves out and the language cannot say, are left
    /// out, with a note.
    bool portable = false;
};

/// A scene as files in the making.
struct SceneText {
    struct File {
        std::filesystem::path path;
        std::string bytes;
    };
    /// What lies beside the scene, in a folder named like it: meshes and measured lamps. Their names say
    /// what is in them, so that a file of that name which is there already is the same.
    std::vector<File> parts;
    File scene;
    std::vector<Note> notes;  // what was replaced or left out
};

/// `scene`, settings and all, as pbrt-v4 text that is to be called `path`. Large meshes go into PLY files;
/// pictures and other files are named where they are. Throws what validate() throws, and Error(Input) for
/// what has no form in the language.
SceneText pbrt_text(Scene const& scene, std::filesystem::path const& path, WriteOptions const& options = {});
/// All of it or nothing: throws Error(Io), and parts that were not there before are gone again. The scene
/// comes last: who sees it has its parts.
void write_files(SceneText const& text);

/// Both.
std::vector<Note> write_pbrt(Scene const& scene, std::filesystem::path const& path,
                             WriteOptions const& options = {});

}  // namespace nephroid
