// Names of files as messages and written scenes spell them.
#pragma once

#include <filesystem>

namespace nephroid {

/// The file `path` without the detours "." and "..". "a/../b" is "b", unless a is a link: the system leaves
/// a link's folder by ".." where that folder really lies, and the path is then given from there. What is not
/// there counts as a plain folder.
std::filesystem::path without_detours(std::filesystem::path const& path);

}  // namespace nephroid
