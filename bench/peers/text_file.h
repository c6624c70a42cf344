// A text file, written at once.
#pragma once

#include "math/error.h"

#include <filesystem>
#include <fstream>
#include <string>

namespace nephroid::peers {

inline std::filesystem::path write_text(std::filesystem::path const& path, std::string const& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw Error(ErrorKind::Io, path.string() + ": could not be written");
    return path;
}

}  // namespace nephroid::peers
