// Windows bitmaps: 1, 4 or 8 bits a pixel by a palette; 16, 24 or 32 bits in fixed places or by masks; rows from below or above.
// Run lengths are not read.
#include "codecs.h"

#include <algorithm>
#include <array>
#include <bit>

namespace nephroid::codec {

namespace {

struct Header {
    std::int64_t data_at = 0, width = 0, height = 0;
    int bits = 0;
    bool top_to_bottom = false;
    std::array<std::uint32_t, 4> masks{};  // red, green, blue, alpha
    std::vector<std::array<std::uint8_t, 3>> palette;
};

std::uint32_t little_endian(Cursor& in, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::uint32_t{in.byte()} << (8 * i);
    return value;
}

void read_palette(Cursor& in, Header& h, std::uint32_t used, std::size_t entry, std::string const& path) {
    std::uint32_t const most = 1u << h.bits;
    if (used > most) fail(path, "the BMP palette is damaged (" + std::to_string(used) + " colours)");
    h.palette.resize(used == 0 ? most : used);
    for (auto& colour : h.palette) {
        Bytes const raw = in.take(entry);
        for (std::size_t c = 0; c < 3; ++c) colour[c] = static_cast<std::uint8_t>(raw[2 - c]);
    }
}

Header read_header(Cursor& in, std::string const& path) {
    Header h;
    in.take(2);  // "BM"
    in.take(8);  // the file's size, which many writers get wrong, and nothing
    h.data_at = little_endian(in, 4);
    std::uint32_t const size = little_endian(in, 4);
    bool const core = size == 12;  // OS/2's
    if (!core && (size < 40 || size > 1024)) fail(path, "is no BMP file, or a damaged one");
    auto const side = [&] {
        if (core) return std::int64_t{little_endian(in, 2)};
        return std::int64_t{static_cast<std::int32_t>(little_endian(in, 4))};
    };
    h.width = side();
    h.height = side();
    if (h.height < 0) h.top_to_bottom = true, h.height = -h.height;
    in.take(2);  // planes
    h.bits = static_cast<int>(little_endian(in, 2));
    std::uint32_t compression = 0, used = 0;
    if (!core) {
        compression = little_endian(in, 4);
        in.take(12);  // the size of the data, the resolution
        used = little_endian(in, 4);
        in.take(4);
    }
    bool const masked = compression == 3 || compression == 6;
    if (compression != 0 && !masked)
        fail(path, "BMP compression " + std::to_string(compression) + " is not read; save it uncompressed");
    bool const by_palette = h.bits == 1 || h.bits == 4 || h.bits == 8;
    if (!by_palette && h.bits != 24 && h.bits != 32 && h.bits != 16)
        fail(path, "is no BMP file, or a damaged one (" + std::to_string(h.bits) + " bits a pixel)");
    if (h.bits == 16) h.masks = {0x7c00, 0x3e0, 0x1f, 0};
    if (h.bits == 24 || h.bits == 32) h.masks = {0xff0000, 0xff00, 0xff, 0};
    std::size_t rest = core ? 0 : size - 40;
    if (masked && !by_palette) {
        // In the header of later versions, behind that of the first.
        std::size_t const count = rest >= 16 || compression == 6 ? 4 : 3;
        for (std::size_t c = 0; c < count; ++c) h.masks[c] = little_endian(in, 4);
        rest -= std::min(rest, 4 * count);
    }
    in.take(rest);
    if (by_palette) read_palette(in, h, used, core ? 3 : 4, path);
    return h;
}

/// The bits of a mask as 0 to 255.
std::uint8_t channel(std::uint32_t pixel, std::uint32_t mask) {
    if (mask == 0) return 0;
    int const shift = std::countr_zero(mask);
    std::uint64_t const value = (pixel & mask) >> shift;
    std::uint64_t const top = mask >> shift;
    return static_cast<std::uint8_t>((value * 255 + top / 2) / top);
}

}  // namespace

Image decode_bmp(Bytes file, std::string const& path, std::optional<Encoding> override_encoding) {
    Cursor in(file, path);
    Header const h = read_header(in, path);
    int const channels = h.masks[3] != 0 ? 4 : 3;
    check_size(path, h.width, h.height, channels, 1);
    auto const width = static_cast<std::size_t>(h.width), height = static_cast<std::size_t>(h.height);
    auto const bits = static_cast<std::size_t>(h.bits);
    std::size_t const row_bytes = (width * bits + 31) / 32 * 4;
    auto const data_at = static_cast<std::size_t>(h.data_at);
    // Refuse a huge image of nothing before making room for it.
    if (data_at < in.at() || data_at > file.size() || (file.size() - data_at) / row_bytes < height)
        fail(path, "the file is truncated; get a complete copy");

    Image image(PixelFormat::U8, static_cast<int>(width), static_cast<int>(height),
                default_channel_names(channels), override_encoding.value_or(Encoding::srgb()));
    auto& out = image.u8();
    for (std::size_t row = 0; row < height; ++row) {
        Bytes const raw = file.subspan(data_at + row * row_bytes, row_bytes);
        int const y = static_cast<int>(h.top_to_bottom ? row : height - 1 - row);
        for (std::size_t x = 0; x < width; ++x) {
            std::size_t const at = image.index(static_cast<int>(x), y, 0);
            if (h.palette.empty()) {
                std::uint32_t pixel = 0;
                for (std::size_t b = 0; b < bits / 8; ++b)
                    pixel |= std::to_integer<std::uint32_t>(raw[x * bits / 8 + b]) << (8 * b);
                for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
                    out[at + c] = channel(pixel, h.masks[c]);
            } else {
                std::size_t const shift = 8 - bits - x * bits % 8;  // the first pixel is in the highest bits
                std::size_t const index =
                    (std::to_integer<std::size_t>(raw[x * bits / 8]) >> shift) & ((1u << bits) - 1);
                if (index >= h.palette.size())
                    fail(path, "a BMP pixel names a colour that the palette lacks");
                for (std::size_t c = 0; c < 3; ++c) out[at + c] = h.palette[index][c];
            }
        }
    }
    return image;
}

}  // namespace nephroid::codec
