// Truevision TGA: true-colour and gray, raw or run-length encoded, 8, 16 (5-5-5), 24 or 32 bits a pixel, any origin.
#include "codecs.h"

#include <array>

namespace nephroid::codec {

namespace {

struct Header {
    std::size_t id_length = 0, map_bytes = 0;
    int type = 0, width = 0, height = 0, bits = 0, alpha_bits = 0;
    bool right_to_left = false, top_to_bottom = false;
    [[nodiscard]] bool gray() const { return type == 3 || type == 11; }
    [[nodiscard]] bool runs() const { return type >= 9; }
    [[nodiscard]] int channels() const {
        if (gray()) return bits == 16 ? 2 : 1;
        return bits == 32 && alpha_bits > 0 ? 4 : 3;
    }
};

Header read_header(Cursor& in, std::string const& path) {
    auto word = [&] {
        int const low = in.byte();
        return low | (in.byte() << 8);
    };
    Header h;
    h.id_length = in.byte();
    int const map_type = in.byte();
    h.type = in.byte();
    (void)word();  // the colour map's first entry
    int const map_length = word();
    int const map_bits = in.byte();
    (void)word();
    (void)word();  // the origin on a screen
    h.width = word();
    h.height = word();
    h.bits = in.byte();
    int const descriptor = in.byte();
    h.alpha_bits = descriptor & 15;
    h.right_to_left = (descriptor & 16) != 0;
    h.top_to_bottom = (descriptor & 32) != 0;
    if (map_type == 1)  // some writers add a map to true-colour images: skip it
        h.map_bytes = static_cast<std::size_t>(map_length) * static_cast<std::size_t>((map_bits + 7) / 8);
    if (h.type != 2 && h.type != 3 && h.type != 10 && h.type != 11)
        fail(path, "TGA type " + std::to_string(h.type) + " is not read; save it as true colour or gray");
    bool const legal = h.gray() ? (h.bits == 8 || h.bits == 16)
                                : (h.bits == 15 || h.bits == 16 || h.bits == 24 || h.bits == 32);
    if (!legal || map_type > 1 || (descriptor & 0xc0) != 0)
        fail(path, "is no TGA file, or a damaged one (" + std::to_string(h.bits) + " bits a pixel)");
    return h;
}

using Pixel = std::array<std::uint8_t, 4>;

Pixel to_pixel(Bytes raw, Header const& h) {
    auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(raw[i]); };
    if (h.gray()) return {at(0), h.bits == 16 ? at(1) : std::uint8_t{255}, 0, 0};
    if (h.bits <= 16) {
        int const v = at(0) | (at(1) << 8);
        auto five = [](int x) { return static_cast<std::uint8_t>((x & 31) * 255 / 31); };
        return {five(v >> 10), five(v >> 5), five(v), 255};
    }
    return {at(2), at(1), at(0), h.bits == 32 ? at(3) : std::uint8_t{255}};
}

}  // namespace

Image decode_tga(Bytes file, std::string const& path, std::optional<Encoding> override_encoding) {
    Cursor in(file, path);
    Header const h = read_header(in, path);
    int const channels = h.channels();
    check_size(path, h.width, h.height, channels, 1);
    in.take(h.id_length);
    in.take(h.map_bytes);
    auto const count = static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height);
    std::size_t const each = static_cast<std::size_t>(h.bits + 7) / 8;
    // A run of at most 128 pixels takes 1 + each bytes: refuse a huge image of nothing before making room for it.
    std::size_t const least = h.runs() ? (count + 127) / 128 * (1 + each) : count * each;
    if (in.left() < least) fail(path, "the file is truncated; get a complete copy");

    Image image(PixelFormat::U8, h.width, h.height, default_channel_names(channels),
                override_encoding.value_or(Encoding::srgb()));
    auto put = [&](std::size_t i, Pixel const& pixel) {
        int const x = static_cast<int>(i % static_cast<std::size_t>(h.width));
        int const y = static_cast<int>(i / static_cast<std::size_t>(h.width));
        std::size_t const at =
            image.index(h.right_to_left ? h.width - 1 - x : x, h.top_to_bottom ? y : h.height - 1 - y, 0);
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) image.u8()[at + c] = pixel[c];
    };
    for (std::size_t i = 0; i < count;) {
        if (!h.runs()) {
            put(i++, to_pixel(in.take(each), h));
            continue;
        }
        int const packet = in.byte();
        std::size_t const n = static_cast<std::size_t>(packet & 127) + 1;
        if (n > count - i) fail(path, "the TGA run-length code is damaged");
        bool const run = (packet & 128) != 0;
        Pixel pixel{};
        for (std::size_t k = 0; k < n; ++k) {
            if (!run || k == 0) pixel = to_pixel(in.take(each), h);
            put(i++, pixel);
        }
    }
    return image;
}

}  // namespace nephroid::codec
