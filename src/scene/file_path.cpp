#include "scene/file_path.h"

#include <algorithm>
#include <system_error>

namespace nephroid {

namespace fs = std::filesystem;

fs::path without_detours(fs::path const& path) {
    fs::path plain = path.lexically_normal();
    if (std::find(path.begin(), path.end(), "..") == path.end()) return plain;
    // Of the folder alone: a file that is itself a link keeps its name.
    std::error_code error;
    auto const folder = [&](fs::path const& p) {
        return fs::weakly_canonical(fs::absolute(p, error).parent_path(), error);
    };
    fs::path const real = folder(path);
    return real.empty() || real == folder(plain) ? plain : real / path.filename();
}

}  // namespace nephroid
