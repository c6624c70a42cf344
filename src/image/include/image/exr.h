// An OpenEXR file as it is: named planes of halves, floats or unsigned integers, text attributes, windows.
// Films and checkpoints are kept in this form; read_image() is for pictures and textures.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
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

/// All channels of the first part, without loss. Deep files and subsampled channels are refused.
ExrFile read_exr(std::filesystem::path const& path);
/// ZIP-compressed scanlines; the same struct makes the same bytes. Halves: finite numbers too large become the largest.
void write_exr(std::filesystem::path const& path, ExrFile const& file);

}  // namespace nephroid
