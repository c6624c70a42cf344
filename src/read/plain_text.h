// Scene files are text: what is none is refused before anybody looks for words in it.
#pragma once

#include "scene/scene.h"

#include <string_view>

namespace nephroid {

/// `text` without a UTF-8 byte order mark. Fails, with the line, for UTF-16 and NUL bytes.
std::string_view plain_text(Scene const& scene, std::uint32_t file, std::string_view text);

}  // namespace nephroid
