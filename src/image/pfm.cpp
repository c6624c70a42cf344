// Portable float map: "PF" (RGB) or "Pf" (gray), "width height", a scale whose sign tells the byte order (negative:
// little-endian), one white space, then floats, the bottom row first.
#include "codecs.h"
#include "image/file.h"
#include "image/write.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

namespace nephroid {

namespace codec {

namespace {

/// One word of the header. A single white space ends it and is consumed: what follows the last word is data.
std::string word(Cursor& in, std::string const& path) {
    auto is_space = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
    char c = static_cast<char>(in.byte());
    while (is_space(c)) c = static_cast<char>(in.byte());
    std::string text;
    while (!is_space(c)) {
        text += c;
        if (text.size() > 64) fail(path, "the PFM header is damaged");
        c = static_cast<char>(in.byte());
    }
    return text;
}

template <class T>
T number(std::string const& text, std::string const& path) {
    T value{};
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        fail(path, "the PFM header is damaged: '" + text + "' is no number");
    return value;
}

std::uint32_t swap_bytes(std::uint32_t v) {
    return (v >> 24) | ((v >> 8) & 0xff00u) | ((v << 8) & 0xff0000u) | (v << 24);
}

}  // namespace

Image decode_pfm(Bytes file, std::string const& path) {
    Cursor in(file, path);
    int const channels = word(in, path) == "PF" ? 3 : 1;
    auto const width = number<std::int64_t>(word(in, path), path);
    auto const height = number<std::int64_t>(word(in, path), path);
    auto const scale = number<double>(word(in, path), path);
    if (scale == 0.0 || !std::isfinite(scale)) fail(path, "the PFM scale must be a number other than 0");
    check_size(path, width, height, channels, 4);
    auto const row_values = static_cast<std::size_t>(width * channels);
    if (in.left() < row_values * 4 * static_cast<std::size_t>(height))
        fail(path, "the file is truncated; get a complete copy");

    Image image(PixelFormat::Float, static_cast<int>(width), static_cast<int>(height),
                default_channel_names(channels));
    bool const file_is_little = scale < 0.0;
    bool const swap = file_is_little != (std::endian::native == std::endian::little);
    auto const factor = static_cast<float>(std::abs(scale));
    for (int y = image.height() - 1; y >= 0; --y) {
        float* const row = image.floats().data() + image.index(0, y, 0);
        std::memcpy(row, in.take(row_values * 4).data(), row_values * 4);
        for (std::size_t i = 0; i < row_values; ++i) {
            if (swap) row[i] = std::bit_cast<float>(swap_bytes(std::bit_cast<std::uint32_t>(row[i])));
            if (factor != 1.0f) row[i] *= factor;
        }
    }
    return image;
}

}  // namespace codec

void write_pfm(std::filesystem::path const& path, Image const& image) {
    if (image.empty()) codec::fail(path.string(), "cannot write an empty image");
    int const channels = image.channels() >= 3 ? 3 : 1;
    std::string const header = (channels == 3 ? "PF\n" : "Pf\n") + std::to_string(image.width()) + " " +
                               std::to_string(image.height()) + "\n-1.0\n";
    std::vector<std::byte> out(header.size());
    std::memcpy(out.data(), header.data(), header.size());
    out.reserve(header.size() + 4 * static_cast<std::size_t>(image.width()) *
                                    static_cast<std::size_t>(image.height()) *
                                    static_cast<std::size_t>(channels));
    for (int y = image.height() - 1; y >= 0; --y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < channels; ++c) {
                auto const bits = std::bit_cast<std::uint32_t>(image.get(x, y, c));
                for (int shift = 0; shift < 32; shift += 8)
                    out.push_back(static_cast<std::byte>(bits >> shift));
            }
    write_file_atomically(path, out);
}

}  // namespace nephroid
