// Writing pictures. All writers are deterministic (no dates, no machine names) and replace files atomically (file.h).
#pragma once

#include "image/exr.h"
#include "image/image.h"

#include <filesystem>

namespace nephroid {

/// sRGB-encoded, 8 or 16 bits; Y, YA, RGB or RGBA. Numbers are clamped to [0, 1], NaN becomes 0; alpha stays linear.
void write_png(std::filesystem::path const& path, Image const& image, int bits = 8);
/// sRGB-encoded, no chroma subsampling; alpha is dropped. Quality 1 to 100.
void write_jpeg(std::filesystem::path const& path, Image const& image, int quality = 95);
/// 32-bit little-endian floats; one or three channels, alpha is dropped.
void write_pfm(std::filesystem::path const& path, Image const& image);
/// Radiance RGBE, run-length encoded; negative numbers and NaN become 0.
void write_hdr(std::filesystem::path const& path, Image const& image);
/// Half for Half images, else Float, under the image's channel names.
void write_exr(std::filesystem::path const& path, Image const& image);
/// By extension: exr, png, jpg/jpeg, pfm, hdr. Throws Error(Input) that lists them for any other.
void write_image(std::filesystem::path const& path, Image const& image);

}  // namespace nephroid
