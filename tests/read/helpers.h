// Shorthand of the tests of reading.
#pragma once

#include "read/read.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace nephroid::test {

/// A scene of `text` alone, called t.pbrt.
inline Scene read(std::string const& text) { return read_pbrt_string(text, "t.pbrt", "."); }
/// A scene of `text` after WorldBegin, which is line 1: the text begins on line 2.
inline Scene read_world(std::string const& text) { return read("WorldBegin\n" + text); }

/// The message of the error that reading throws; "no error" where it does not.
template <class F>
std::string error_of(F const& f) {
    try {
        f();
    } catch (Error const& e) {
        return e.what();
    }
    return "no error";
}
inline std::string error_in(std::string const& text) {
    return error_of([&] { read(text); });
}
inline std::string error_in_world(std::string const& text) {
    return error_of([&] { read_world(text); });
}

/// All notes, each as "file:line: text\n".
inline std::string notes(Scene const& scene) {
    std::string out;
    for (auto const& n : scene.notes) out += scene.locate(n.where) + ": " + n.text + "\n";
    return out;
}
inline bool contains(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

template <class T>
T const& shape_of(Scene const& scene, std::size_t object = 0) {
    REQUIRE(scene.world().objects.size() > object);
    auto const* shape = std::get_if<T>(&scene.world().objects[object].shape);
    REQUIRE(shape != nullptr);
    return *shape;
}
template <class T>
T const& material_of(Scene const& scene, std::size_t object = 0) {
    REQUIRE(scene.world().objects.size() > object);
    auto const* kind = std::get_if<T>(&scene[scene.world().objects[object].material].kind);
    REQUIRE(kind != nullptr);
    return *kind;
}
template <class T>
T const& texture_of(Scene const& scene, TextureId id) {
    REQUIRE(id.value < scene.textures.size());
    auto const* kind = std::get_if<T>(&scene[id].kind);
    REQUIRE(kind != nullptr);
    return *kind;
}
template <class T, class Variant>
T const& as(Variant const& v) {
    auto const* p = std::get_if<T>(&v);
    REQUIRE(p != nullptr);
    return *p;
}

/// A folder of its own, gone with the object.
class Folder {
  public:
    Folder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "nephroid-read-XXXXXX").string();
        REQUIRE(mkdtemp(pattern.data()) != nullptr);
        path_ = pattern;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;

    std::filesystem::path write(std::string const& name, std::string const& bytes) const {
        auto const path = path_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }
    [[nodiscard]] std::filesystem::path const& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// The folder of shared data, or an empty path, said aloud.
inline std::filesystem::path shared_data() {
    char const* const env = std::getenv("NEPHROID_SHARED");
    std::filesystem::path const root =
        env ? std::filesystem::path(env) : std::filesystem::path(NEPHROID_SOURCE_DIR) / ".." / "shared";
    if (std::filesystem::is_directory(root / "data")) return root / "data";
    MESSAGE("SKIPPED: no shared data at ", root.string(), "; set NEPHROID_SHARED");
    return {};
}

}  // namespace nephroid::test
