// An OpenEXR file as it is: named planes of halves, floats or unsigned integers, text attributes, windows.
// Films and checkpoints are kept in this form; read_image() is for pictures and textures.
#pragma once

#include "image/image.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid {

struct ExrChannel {
    enum class Type { Half, Float, Uint };

    std::string name;
    Type type = Type::Float;
    std::vector<float> data = {};           // of Half and Float; row by row, width x height
    std::vector<std::uint32_t> uints = {};  // of Uint
};

struct ExrFile {
    int width = 0, height = 0;     // of the data window
    int data_x0 = 0, data_y0 = 0;  // its upper left corner
    int display_x0 = 0, display_y0 = 0;
    int display_width = 0, display_height = 0;  // of the display window; 0 means that of the data
    std::vector<ExrChannel> channels = {};      // OpenEXR keeps them sorted by name
    std::map<std::string, std::string> attributes = {};
    std::optional<Chromaticities> chromaticities = std::nullopt;

    [[nodiscard]] ExrChannel const* find(std::string const& name) const;
};

/// A plane in memory that belongs to someone else: pixel i, row by row, lies at base + i * stride.
template <class Byte>
struct ExrPlaneAt {
    std::string name;
    ExrChannel::Type type = ExrChannel::Type::Float;  // Half means 16 bits
    Byte* base = nullptr;
    std::size_t stride = 4;
};
using ExrSourcePlane = ExrPlaneAt<std::byte const>;
using ExrTargetPlane = ExrPlaneAt<std::byte>;

enum class ExrCompression {
    Zip,  // 16 lines at a time: small files
    Fast  // run lengths: for numbers whose last bits are noise anyway, and that must be on disk soon
};

/// All channels of the first part, without loss. Deep files and subsampled channels are refused.
ExrFile read_exr(std::filesystem::path const& path);
/// Everything but the pixels: the channels are there without their data, and may be subsampled.
ExrFile read_exr_header(std::filesystem::path const& path);
/// Reads planes of up to 64 GiB in all straight to where they belong. `places` is shown the header and answers with the
/// planes that it wants; it may throw. The others are left out.
ExrFile read_exr(std::filesystem::path const& path,
                 std::function<std::vector<ExrTargetPlane>(ExrFile const& header)> const& places);
/// Compressed scanlines; the same struct makes the same bytes. Halves: finite numbers too large become the largest.
/// `more` are planes beside those of `file`, written from where they lie.
void write_exr(std::filesystem::path const& path, ExrFile const& file,
               std::span<ExrSourcePlane const> more = {}, ExrCompression compression = ExrCompression::Zip);

}  // namespace nephroid
