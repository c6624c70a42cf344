#include "portable.h"
#include "writer.h"

#include "image/file.h"

#include <span>
#include <system_error>
#include <utility>
#include <vector>

namespace nephroid {

namespace {

/// Parts that are put in place one by one: any number, of which one is open. Those that were not there before
/// are gone again unless keep() is called.
class NewParts {
  public:
    NewParts() = default;
    ~NewParts() {
        std::error_code ignored;
        for (std::filesystem::path const& path : made_) std::filesystem::remove(path, ignored);
    }
    NewParts(NewParts const&) = delete;
    NewParts& operator=(NewParts const&) = delete;

    void add(SceneText::File const& part) {
        std::error_code error;
        auto const found = std::filesystem::symlink_status(part.path, error).type();
        if (found == std::filesystem::file_type::not_found) made_.push_back(part.path);
        write_file_atomically(part.path, std::as_bytes(std::span(part.bytes)));
    }
    void keep() { made_.clear(); }

  private:
    std::vector<std::filesystem::path> made_;
};

/// A folder that is gone again unless something was put into it.
class NewFolder {
  public:
    explicit NewFolder(std::filesystem::path path) : path_(std::move(path)) {
        if (path_.empty()) return;
        std::error_code error;
        made_ = std::filesystem::create_directory(path_, error);
        if (error)
            throw Error(ErrorKind::Io,
                        path_.string() + ": cannot make the folder of the scene's parts: " + error.message());
    }
    ~NewFolder() {
        std::error_code ignored;
        if (made_) std::filesystem::remove(path_, ignored);  // only where it is empty
    }
    NewFolder(NewFolder const&) = delete;
    NewFolder& operator=(NewFolder const&) = delete;

  private:
    std::filesystem::path path_;
    bool made_ = false;
};

}  // namespace

SceneText pbrt_text(Scene const& scene, std::filesystem::path const& path, WriteOptions const& options) {
    // What nobody can see is no reason to refuse a scene; it stays in the text all the same, for the text
    // to be of that scene.
    Scene visible = scene;
    visible.notes.clear();
    drop_degenerate(visible);
    validate(visible);
    if (!options.portable) return Writer(scene, path, false).write();
    Scene const portable = portable_scene(std::move(visible));
    SceneText text = Writer(portable, path, true).write();
    text.notes = portable.notes;
    return text;
}

void write_files(SceneText const& text) {
    NewFolder const folder(text.parts.empty() ? std::filesystem::path{} : text.parts[0].path.parent_path());
    NewParts parts;
    for (SceneText::File const& part : text.parts) parts.add(part);
    // The scene last: where it is, its parts are.
    write_file_atomically(text.scene.path, std::as_bytes(std::span(text.scene.bytes)));
    parts.keep();
}

std::vector<Note> write_pbrt(Scene const& scene, std::filesystem::path const& path,
                             WriteOptions const& options) {
    SceneText text = pbrt_text(scene, path, options);
    write_files(text);
    return std::move(text.notes);
}

}  // namespace nephroid
