// The RGB colour spaces that a pbrt file may name. A Scene knows linear sRGB only.
#pragma once

#include "math/vec.h"

#include <optional>
#include <string_view>

namespace nephroid {

enum class FileColorSpace : unsigned char { Srgb, DciP3, Rec2020, Aces2065 };

/// pbrt's names: "srgb", "dci-p3", "rec2020", "aces2065-1".
std::optional<FileColorSpace> file_color_space(std::string_view name);
/// The same colour in linear sRGB, white to white; outside its gamut there are negative components.
Vec3 to_srgb(Vec3 rgb, FileColorSpace from);

}  // namespace nephroid
