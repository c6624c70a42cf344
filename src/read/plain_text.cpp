#include "plain_text.h"

#include <algorithm>

namespace nephroid {

std::string_view plain_text(Scene const& scene, std::uint32_t file, std::string_view text) {
    if (text.starts_with("\xfe\xff") || text.starts_with("\xff\xfe"))
        scene.fail({file, 1}, "the file is UTF-16; save it as UTF-8");
    if (auto const nul = text.find('\0'); nul != std::string_view::npos) {
        auto const line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
        scene.fail({file, static_cast<std::uint32_t>(line)}, "a NUL byte; scene files are text");
    }
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return text;
}

}  // namespace nephroid
