// The RGB colour spaces that a pbrt file may name. A Scene knows linear sRGB only.
#pragma once

#include "math/vec.h"
#include "spectrum/spd.h"

#include <optional>
#include <string_view>

namespace nephroid {

enum class FileColorSpace : unsigned char {
    Srgb,
    DciP3,
    Rec2020,
    Aces2065,
    SrgbAcesD60  // ours: numbers are sRGB's, the white of lights is that of Aces2065
};

/// pbrt's names: "srgb", "dci-p3", "rec2020", "aces2065-1", and our "srgb-acesd60", in capitals or not.
std::optional<FileColorSpace> file_color_space(std::string_view name);
/// The same colour in linear sRGB, white to white; outside its gamut there are negative components.
Vec3 to_srgb(Vec3 rgb, FileColorSpace from);
/// The space's white: what a light is where nothing is said, and what an emission given as rgb is a share of.
RgbWhite white_of(FileColorSpace space);

}  // namespace nephroid
