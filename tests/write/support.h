// Shorthand of the tests of writing: a folder of one's own, and the way there and back.
#pragma once

#include "read/read.h"
#include "write/write.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace nephroid::test {

/// Made anew, and gone at the end.
class Folder {
  public:
    Folder()
        : path_(std::filesystem::temp_directory_path() / ("nephroid-write-" + std::to_string(::getpid()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;
    std::filesystem::path operator/(std::string const& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

inline std::string contents(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// What the written scene is read as.
inline Scene there_and_back(Scene const& scene, std::filesystem::path const& path, bool portable = false) {
    write_pbrt(scene, path, {.portable = portable});
    return read_scene(path);
}

inline std::string notes(Scene const& scene) {
    std::string out;
    for (Note const& n : scene.notes) out += scene.locate(n.where) + ": " + n.text + "\n";
    return out;
}

}  // namespace nephroid::test
