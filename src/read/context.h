// What every part of a reader shares: the scene being filled, where its files are, and how it complains.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

class Context {
  public:
    Scene scene;

    /// Registers a file that locations may point into. `folder` is where the names it mentions start.
    std::uint32_t add_file(std::string const& shown, std::filesystem::path folder);
    /// The path of a file that is named at `where`: relative to the first file, as in pbrt, or, where nothing is there,
    /// to the file that names it.
    [[nodiscard]] std::filesystem::path resolve(SourceLocation where, std::string const& name) const;
    /// Contents of a file named at `where`; fails there, with `what` ("Include", "spectrum"), when it cannot be read.
    [[nodiscard]] std::string read_named(SourceLocation where, std::string_view what,
                                         std::filesystem::path const& path) const;

    [[noreturn]] void fail(SourceLocation where, std::string const& message) const {
        scene.fail(where, message);
    }
    /// A note; the same text is said a few times only, and the rest is counted.
    void note(SourceLocation where, std::string const& text);
    /// Adds the counts of what note() left out. Call once, at the end.
    void finish_notes();

  private:
    struct Repeats {
        int said = 0, dropped = 0;
        SourceLocation last;
    };
    std::vector<std::filesystem::path> folders_;  // parallel to scene.files
    std::map<std::string, Repeats, std::less<>> repeats_;
};

}  // namespace nephroid
