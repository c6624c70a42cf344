#include "image/read.h"

#include "codecs.h"
#include "image/file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <new>
#include <string_view>

namespace nephroid {

namespace codec {

void fail(std::string const& path, std::string const& what, ErrorKind kind) {
    throw Error(kind, path + ": " + what);
}

void check_size(std::string const& path, std::int64_t width, std::int64_t height, std::int64_t channels,
                std::int64_t bytes_per_channel) {
    if (width <= 0 || height <= 0) fail(path, "the image has no pixels; the file is damaged");
    std::string const size = std::to_string(width) + " x " + std::to_string(height);
    if (width > kMaxImageSide || height > kMaxImageSide)
        fail(path, "the image has " + size + " pixels; at most 65536 a side are read, scale it down",
             ErrorKind::Limit);
    if (channels <= 0 || width * height > kMaxImageBytes / (channels * bytes_per_channel))
        fail(path, "the image has " + size + " pixels, more than 2 GiB; scale it down", ErrorKind::Limit);
}

std::string Cursor::line(std::size_t longest) {
    std::string text;
    for (;;) {
        char const c = static_cast<char>(byte());
        if (c == '\n') return text;
        text += c;
        if (text.size() > longest) fail(*path_, "the header is damaged (a line without end)");
    }
}

}  // namespace codec

namespace {

using codec::Bytes;

bool starts_with(Bytes file, std::string_view magic) {
    return file.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), file.begin(),
                      [](char m, std::byte b) { return static_cast<std::byte>(m) == b; });
}

bool has_extension(std::filesystem::path const& path, std::string_view extension) {
    std::string actual = path.extension().string();
    std::transform(actual.begin(), actual.end(), actual.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return actual == extension;
}

// The first bytes of the formats; TGA has none.
constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n", kJpeg = "\xff\xd8\xff", kExr = "\x76\x2f\x31\x01",
                           kHdr = "#?", kPfm = "PF", kGrayPfm = "Pf", kBmp = "BM";

Image decode_by_content(Bytes file, std::filesystem::path const& path, std::optional<Encoding> encoding) {
    std::string const name = path.string();
    if (file.empty()) codec::fail(name, "the file is empty");
    if (starts_with(file, kPng)) return codec::decode_png(file, name, encoding);
    if (starts_with(file, kJpeg)) return codec::decode_jpeg(file, name, encoding);
    if (starts_with(file, kExr)) return codec::decode_exr(file, name);
    if (starts_with(file, kHdr)) return codec::decode_hdr(file, name);
    if (starts_with(file, kPfm) || starts_with(file, kGrayPfm)) return codec::decode_pfm(file, name);
    // Two letters are little: a TGA file that begins with them would be one with a colour map of an unknown type.
    if (starts_with(file, kBmp)) return codec::decode_bmp(file, name, encoding);
    if (has_extension(path, ".tga")) return codec::decode_tga(file, name, encoding);
    codec::fail(name, "is no image of a known format; PNG, JPEG, EXR, HDR, PFM, BMP and TGA are read");
}

}  // namespace

Image read_image(std::filesystem::path const& path, std::optional<Encoding> encoding) {
    std::vector<std::byte> const file = read_file(path);
    try {
        return decode_by_content(file, path, encoding);
    } catch (std::bad_alloc const&) {
        codec::fail(path.string(), "the image does not fit in memory; scale it down", ErrorKind::Limit);
    }
}

bool stores_light(std::filesystem::path const& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;
    std::array<std::byte, 4> head{};
    std::ifstream in(path, std::ios::binary);
    in.read(reinterpret_cast<char*>(head.data()), head.size());
    Bytes const bytes(head.data(), static_cast<std::size_t>(in.gcount()));
    return starts_with(bytes, kExr) || starts_with(bytes, kHdr) || starts_with(bytes, kPfm) ||
           starts_with(bytes, kGrayPfm);
}

}  // namespace nephroid
