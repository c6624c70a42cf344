// A small parser of OpenEXR's headers (openexr.com, "OpenEXR File Layout"), only to refuse what must not reach the
// library: see check_exr_headers() in exr_stream.h.
#include "exr_stream.h"

#include <algorithm>
#include <array>

namespace nephroid::codec {

namespace {

constexpr std::uint32_t kMultiPart = 0x1000, kDeep = 0x800;

std::uint32_t u32(Cursor& in) {
    std::uint32_t v = 0;
    for (int shift = 0; shift < 32; shift += 8) v |= static_cast<std::uint32_t>(in.byte()) << shift;
    return v;
}
std::int32_t i32(Cursor& in) { return static_cast<std::int32_t>(u32(in)); }

std::string name(Cursor& in, std::string const& path) {
    std::string text;
    for (char c = static_cast<char>(in.byte()); c != '\0'; c = static_cast<char>(in.byte())) {
        text += c;
        if (text.size() > 255) fail(path, "the EXR header is damaged (a name without end)");
    }
    return text;
}

struct Part {
    std::array<std::int32_t, 4> data{}, display{};  // x0 y0 x1 y1
    bool has_data = false, has_display = false, tiled = false;
    std::int64_t tile_width = 0, tile_height = 0;
    std::int64_t bytes_per_pixel = 0;
    int compression = -1;
};

void read_channels(Cursor in, Part& part, std::string const& path) {
    for (int count = 0;; ++count) {
        if (count > 4096) fail(path, "the EXR file has more than 4096 channels", ErrorKind::Limit);
        std::string const channel = name(in, path);
        if (channel.empty()) break;
        std::int32_t const type = i32(in);
        in.take(4);
        std::int32_t const x_sampling = i32(in), y_sampling = i32(in);
        if (type < 0 || type > 2) fail(path, "channel '" + channel + "' has an unknown pixel type");
        if (x_sampling < 1 || y_sampling < 1 || x_sampling > 64 || y_sampling > 64)
            fail(path, "channel '" + channel + "' has an impossible sampling rate");
        part.bytes_per_pixel += type == 1 ? 2 : 4;
    }
}

void read_attribute(Cursor& in, Part& part, std::string const& attribute, std::string const& path) {
    std::string const type = name(in, path);
    std::uint32_t const size = u32(in);
    if (size > in.left()) fail(path, "the EXR header is damaged (attribute '" + attribute + "' is too long)");
    Bytes const content = in.take(size);
    Cursor value(content, path);
    if (attribute == "channels" && type == "chlist") {
        read_channels(value, part, path);
    } else if ((attribute == "dataWindow" || attribute == "displayWindow") && type == "box2i") {
        bool const data = attribute == "dataWindow";
        for (std::int32_t& v : data ? part.data : part.display) v = i32(value);
        (data ? part.has_data : part.has_display) = true;
    } else if (attribute == "tiles" && type == "tiledesc") {
        part.tiled = true;
        part.tile_width = u32(value);
        part.tile_height = u32(value);
    } else if (attribute == "compression" && type == "compression") {
        part.compression = value.byte();
    } else if (attribute == "type" && type == "string") {
        std::string const text(reinterpret_cast<char const*>(content.data()), content.size());
        if (text.starts_with("deep")) fail(path, "is a deep EXR file; flatten it first");
    }
}

/// What compression can shrink at most, generously; beyond it the data cannot be there. DWA has no useful bound.
std::int64_t largest_ratio(int compression) { return compression >= 8 ? 1 << 20 : 4096; }

/// Lines that one chunk holds; unknown methods as many as any.
std::int64_t lines_per_chunk(int compression) {
    constexpr std::array<std::int64_t, 10> kLines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return compression >= 0 && compression < static_cast<int>(kLines.size())
               ? kLines[static_cast<std::size_t>(compression)]
               : 256;
}

void check_part(Part const& part, std::uint64_t bytes_left, std::int64_t most_bytes,
                std::string const& path) {
    if (!part.has_data || !part.has_display) fail(path, "the EXR header names no data or display window");
    for (auto const& window : {part.data, part.display})
        for (std::int32_t const v : window)
            if (v < -(1 << 30) || v > (1 << 30))
                fail(path, "the EXR header's windows are out of range", ErrorKind::Limit);
    std::int64_t const width = std::int64_t{part.data[2]} - part.data[0] + 1;
    std::int64_t const height = std::int64_t{part.data[3]} - part.data[1] + 1;
    if (part.bytes_per_pixel == 0) fail(path, "the EXR file has no channels");
    check_size(path, width, height, 1, 1);
    // The lines of a chunk are unpacked at once, whatever the whole picture may take.
    std::int64_t const lines = std::min(height, lines_per_chunk(part.compression));
    if (width * lines > kMaxImageBytes / part.bytes_per_pixel)
        fail(path,
             std::to_string(lines) + " lines of " + std::to_string(width) + " pixels of " +
                 std::to_string(part.bytes_per_pixel) +
                 " bytes, which are compressed as one, take more than " +
                 std::to_string(kMaxImageBytes >> 30) + " GiB; compress it line by line (ZIPS or RLE)",
             ErrorKind::Limit);
    if (width * height > most_bytes / part.bytes_per_pixel)
        fail(path,
             "the image has " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                 std::to_string(part.bytes_per_pixel) + " bytes, more than " +
                 std::to_string(most_bytes >> 30) + " GiB; scale it down",
             ErrorKind::Limit);
    auto const left = static_cast<std::int64_t>(bytes_left);
    std::int64_t chunks = (height + 255) / 256;  // DWAB packs 256 lines, nothing packs more
    if (part.tiled) {
        if (part.tile_width < 1 || part.tile_height < 1 || part.tile_width > kMaxImageSide ||
            part.tile_height > kMaxImageSide)
            fail(path, "the EXR file has an impossible tile size");
        check_size(path, part.tile_width, part.tile_height, part.bytes_per_pixel, 1);
        chunks = ((width + part.tile_width - 1) / part.tile_width) *
                 ((height + part.tile_height - 1) / part.tile_height);
    }
    // Each chunk has an 8-byte entry in the table of offsets and an 8-byte header of its own.
    if (chunks * 16 > left) fail(path, "the file is truncated; get a complete copy");
    if (width * height * part.bytes_per_pixel / largest_ratio(part.compression) > left)
        fail(path, "the file is truncated; get a complete copy");
}

}  // namespace

void check_exr_headers(Bytes head, std::uint64_t size, std::int64_t most_bytes, std::string const& path) {
    Cursor in(head, path);
    in.take(4);  // the magic number, seen already
    std::uint32_t const version = u32(in);
    if ((version & 0xffu) != 2) fail(path, "has an unknown version of OpenEXR");
    if ((version & kDeep) != 0) fail(path, "is a deep EXR file; flatten it first");
    bool const multi = (version & kMultiPart) != 0;
    std::vector<Part> parts;
    do {
        if (parts.size() > 1024) fail(path, "the EXR file has more than 1024 parts", ErrorKind::Limit);
        Part part;
        std::string attribute = name(in, path);
        if (multi && attribute.empty()) break;  // an empty header ends the list
        for (; !attribute.empty(); attribute = name(in, path)) read_attribute(in, part, attribute, path);
        parts.push_back(part);
    } while (multi);
    if (parts.empty()) fail(path, "the EXR file has no parts");
    for (Part const& part : parts) check_part(part, size - in.at(), most_bytes, path);
}

}  // namespace nephroid::codec
