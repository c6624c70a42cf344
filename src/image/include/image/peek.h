// How large a picture is, from its first bytes: to know what reading it would cost.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace nephroid {

/// Width and height as a picture file claims them; nothing for what is no picture and for files that cannot be read.
/// Never throws, never reads the pixels.
std::optional<std::array<std::int64_t, 2>> peek_size(std::filesystem::path const& path);

}  // namespace nephroid
