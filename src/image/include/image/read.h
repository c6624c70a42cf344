// Reading pictures. The format is told by the file's content; only TGA, which has no mark, needs its extension.
// Every failure is an Error that names the file; whatever the bytes are, nothing crashes, hangs or prints.
#pragma once

#include "image/exr.h"
#include "image/image.h"

#include <filesystem>
#include <optional>

namespace nephroid {

/// PNG, JPEG, EXR, Radiance HDR, PFM, TGA. Bytes are kept as bytes, sRGB-encoded unless `encoding` says otherwise.
/// 16-bit PNGs are decoded (by sRGB or `encoding`) to floats. Formats that store light (EXR, HDR, PFM) ignore `encoding`.
/// Numbers that are not finite are kept; see sanitize().
Image read_image(std::filesystem::path const& path, std::optional<Encoding> encoding = std::nullopt);

/// Does the file store light itself, so that `encoding` is nothing to it (EXR, HDR, PFM)? False for what cannot be read.
bool stores_light(std::filesystem::path const& path);

}  // namespace nephroid
