#include "portable.h"
#include "writer.h"

#include "image/file.h"

#include <list>
#include <span>
#include <system_error>

namespace nephroid {

namespace {

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
    drop_degenerate(visible);
    validate(visible);
    if (!options.portable) return Writer(scene, path, false).write();
    visible.notes.clear();
    Scene const portable = portable_scene(std::move(visible));
    SceneText text = Writer(portable, path, true).write();
    text.notes = portable.notes;
    return text;
}

void write_files(SceneText const& text) {
    NewFolder const folder(text.parts.empty() ? std::filesystem::path{} : text.parts[0].path.parent_path());
    std::list<NewFile> files;
    auto const begin = [&](SceneText::File const& f) {
        NewFile& file = files.emplace_back(f.path);
        if (!file.write(std::as_bytes(std::span(f.bytes)))) file.commit();  // which says why
    };
    for (SceneText::File const& part : text.parts) begin(part);
    begin(text.scene);
    // The scene last: where it is, its parts are.
    for (NewFile& file : files) file.commit();
}

std::vector<Note> write_pbrt(Scene const& scene, std::filesystem::path const& path,
                             WriteOptions const& options) {
    SceneText text = pbrt_text(scene, path, options);
    write_files(text);
    return std::move(text.notes);
}

}  // namespace nephroid
