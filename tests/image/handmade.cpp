// Pictures written byte by byte, from the formats' descriptions.
#include "support.h"

#include "image/read.h"

#include <doctest/doctest.h>

#include <limits>

using namespace nephroid;
using namespace std::string_literals;
using test::error_of;

namespace {

Image read_bytes(std::string_view name, std::string const& content) {
    test::Folder const folder;
    return read_image(test::write(folder, name, content));
}
std::optional<ErrorKind> refusal(std::string_view name, std::string const& content) {
    std::string message;
    auto const kind = error_of([&] { read_bytes(name, content); }, &message);
    if (kind) CHECK(message.find(std::string(name) + ": ") != std::string::npos);
    return kind;
}

std::string const kHdrHead = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

}  // namespace

TEST_CASE("PFM: both byte orders, bottom row first, scale") {
    // 1.0 is 3f800000, 2.0 is 40000000
    Image const big = read_bytes("a.pfm", "Pf\n1 2\n1\n\x3f\x80\0\0\x40\0\0\0"s);
    CHECK(big.channels() == 1);
    CHECK(big.get(0, 1, 0) == 1.0f);
    CHECK(big.get(0, 0, 0) == 2.0f);
    Image const little = read_bytes("a.pfm", "PF\n1 1\n-0.5\n\0\0\x80\x3f\0\0\0\x40\0\0\0\0"s);
    CHECK(little.channels() == 3);
    CHECK(little.get(0, 0, 0) == 0.5f);
    CHECK(little.get(0, 0, 1) == 1.0f);
    CHECK(refusal("a.pfm", "PF\n1 1\n-1\n\0\0\x80\x3f"s) == ErrorKind::Input);
    CHECK(refusal("a.pfm", "PF\n100000 1\n-1\n"s) == ErrorKind::Limit);
    CHECK(refusal("a.pfm", "PF\n1 1\ninf\n\0\0\x80\x3f"s) == ErrorKind::Input);
}

TEST_CASE("HDR: flat, both run-length codes, exposure") {
    Image const flat =
        read_bytes("a.hdr", kHdrHead + "EXPOSURE=2\nEXPOSURE= 2\n\n-Y 1 +X 2\n\x80\x40\x20\x81\0\0\0\0"s);
    CHECK(flat.get(0, 0, 0) == 0.25f);
    CHECK(flat.get(0, 0, 1) == 0.125f);
    CHECK(flat.get(0, 0, 2) == 0.0625f);
    CHECK(flat.get(1, 0, 0) == 0.0f);
    // (1,1,1,n) repeats; a second repeat counts in 256s: 1 + 3 + 1*256
    Image const old_rle = read_bytes("a.hdr", kHdrHead + "\n-Y 1 +X 260\n\x80\x40\x20\x81\1\1\1\3\1\1\1\1"s);
    CHECK(old_rle.get(259, 0, 1) == 0.5f);
    CHECK(refusal("a.hdr", kHdrHead + "\n-Y 1 +X 3\n\x80\x40\x20\x81\1\1\1\3"s) == ErrorKind::Input);
    CHECK(refusal("a.hdr", kHdrHead + "\n-Y 1 +X 3\n\1\1\1\3\x80\x40\x20\x81"s) == ErrorKind::Input);
    Image const new_rle =
        read_bytes("a.hdr", kHdrHead + "\n-Y 1 +X 8\n\2\2\0\x08\x88\x80\2\x40\x20\x86\x10\x88\0\x88\x81"s);
    CHECK(new_rle.get(7, 0, 0) == 1.0f);
    CHECK(new_rle.get(0, 0, 1) == 0.5f);
    CHECK(new_rle.get(1, 0, 1) == 0.25f);
    CHECK(new_rle.get(2, 0, 1) == 0.125f);
    CHECK(refusal("a.hdr", kHdrHead + "EXPOSURE=0\n\n-Y 1 +X 1\n\x80\x40\x20\x81"s) == ErrorKind::Input);
    CHECK(refusal("a.hdr", "#?RADIANCE\nFORMAT=ascii\n\n-Y 1 +X 1\n\x80\x40\x20\x81"s) == ErrorKind::Input);
}

TEST_CASE("HDR: each of the eight orientations puts the first pixels where it says") {
    struct Case {
        char const* resolution;
        int width, height, x0, y0, x1, y1;  // of the first and the second pixel in the file
    };
    // 2 x 3 scanlines for Y first; X first means that scanlines are columns.
    Case const cases[] = {{"-Y 3 +X 2", 2, 3, 0, 0, 1, 0}, {"-Y 3 -X 2", 2, 3, 1, 0, 0, 0},
                          {"+Y 3 +X 2", 2, 3, 0, 2, 1, 2}, {"+Y 3 -X 2", 2, 3, 1, 2, 0, 2},
                          {"+X 3 -Y 2", 3, 2, 0, 0, 0, 1}, {"-X 3 -Y 2", 3, 2, 2, 0, 2, 1},
                          {"+X 3 +Y 2", 3, 2, 0, 1, 0, 0}, {"-X 3 +Y 2", 3, 2, 2, 1, 2, 0}};
    for (Case const& c : cases) {
        CAPTURE(c.resolution);
        std::string data = "\x80\0\0\x81\x40\0\0\x81"s + std::string(16, '\0');
        Image const image = read_bytes("a.hdr", kHdrHead + "\n" + c.resolution + "\n" + data);
        CHECK(image.width() == c.width);
        CHECK(image.height() == c.height);
        CHECK(image.get(c.x0, c.y0, 0) == 1.0f);
        CHECK(image.get(c.x1, c.y1, 0) == 0.5f);
    }
}

TEST_CASE("HDR: XYZE becomes linear Rec. 709") {
    // D65's XYZ is about (0.95, 1, 1.09): white.
    Image const image =
        read_bytes("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\x7a\x80\x8b\x81"s);
    for (int c = 0; c < 3; ++c) CHECK(image.get(0, 0, c) == doctest::Approx(1).epsilon(0.02));
}

namespace {

std::string tga(int type, int width, int height, int bits, int descriptor, std::string const& data) {
    std::string head(18, '\0');
    head[2] = static_cast<char>(type);
    head[12] = static_cast<char>(width);
    head[14] = static_cast<char>(height);
    head[16] = static_cast<char>(bits);
    head[17] = static_cast<char>(descriptor);
    return head + data;
}

}  // namespace

TEST_CASE("TGA: raw and run-length encoded, all depths and origins") {
    // Bottom-up BGR: red below green.
    Image const rgb = read_bytes("a.tga", tga(2, 1, 2, 24, 0, "\0\0\xff\0\xff\0"s));
    CHECK(rgb.channels() == 3);
    CHECK(rgb.get(0, 1, 0) == 1.0f);
    CHECK(rgb.get(0, 0, 1) == 1.0f);
    Image const top_down = read_bytes("a.tga", tga(2, 1, 2, 24, 0x20, "\0\0\xff\0\xff\0"s));
    CHECK(top_down.get(0, 0, 0) == 1.0f);
    Image const mirrored = read_bytes("a.tga", tga(3, 2, 1, 8, 0x30, "\x00\xff"s));
    CHECK(mirrored.channels() == 1);
    CHECK(mirrored.get(0, 0, 0) == 1.0f);
    Image const alpha = read_bytes("a.tga", tga(10, 3, 1, 32, 0x28, "\x81\0\0\xff\x80\0\xff\0\0\xff"s));
    CHECK(alpha.channels() == 4);
    CHECK(alpha.get(1, 0, 0) == 1.0f);
    CHECK(alpha.get(1, 0, 3) == doctest::Approx(128 / 255.0));
    CHECK(alpha.get(2, 0, 2) == 1.0f);
    Image const five = read_bytes("a.tga", tga(2, 1, 1, 16, 0x20, "\x00\x7c"s));
    CHECK(five.get(0, 0, 0) == 1.0f);
    CHECK(five.get(0, 0, 1) == 0.0f);
    CHECK(read_bytes("a.tga", tga(11, 4, 1, 8, 0x20, "\x83\xff"s)).get(3, 0, 0) == 1.0f);
    CHECK(refusal("a.tga", tga(11, 4, 1, 8, 0x20, "\x84\xff"s)) == ErrorKind::Input);
    CHECK(refusal("a.tga", tga(2, 4, 1, 24, 0x20, "\x84\xff"s)) == ErrorKind::Input);
    CHECK(refusal("a.tga", tga(1, 4, 1, 8, 0x20, "\x84\xff"s)) == ErrorKind::Input);
    CHECK(refusal("a.xyz", tga(3, 1, 1, 8, 0x20, "\xff"s)) ==
          ErrorKind::Input);  // nothing but the name tells TGA
}

namespace {

std::string little(std::uint32_t x, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i, x >>= 8) out += static_cast<char>(x & 0xFF);
    return out;
}
/// `tables`: masks and palette, between the header and the rows.
std::string bmp(int width, int height, int bits, std::uint32_t compression, std::uint32_t used,
                std::string const& tables, std::string const& rows) {
    auto const at = static_cast<std::uint32_t>(54 + tables.size());
    return "BM" + little(0, 8) + little(at, 4) + little(40, 4) +
           little(static_cast<std::uint32_t>(width), 4) + little(static_cast<std::uint32_t>(height), 4) +
           little(1, 2) + little(static_cast<std::uint32_t>(bits), 2) + little(compression, 4) +
           little(0, 12) + little(used, 4) + little(0, 4) + tables + rows;
}

}  // namespace

TEST_CASE("BMP: all depths, rows from below and from above, palettes and masks") {
    // BGR, rows of a multiple of four bytes, the lowest first: red below green.
    Image const rgb = read_bytes("a.bmp", bmp(1, 2, 24, 0, 0, "", "\0\0\xff\0\0\xff\0\0"s));
    CHECK(rgb.channels() == 3);
    CHECK(rgb.get(0, 1, 0) == 1.0f);
    CHECK(rgb.get(0, 0, 1) == 1.0f);
    CHECK(read_bytes("a.bmp", bmp(1, -2, 24, 0, 0, "", "\0\0\xff\0\0\xff\0\0"s)).get(0, 0, 0) == 1.0f);
    std::string const palette = "\0\0\xff\0\0\xff\0\0"s;  // red, green
    Image const one = read_bytes("a.bmp", bmp(9, 1, 1, 0, 2, palette, "\x40\x80\0\0"s));
    for (int x = 0; x < 9; ++x) CHECK(one.get(x, 0, 1) == (x == 1 || x == 8 ? 1.0f : 0.0f));
    Image const four = read_bytes("a.bmp", bmp(3, 1, 4, 0, 2, palette, "\x01\x10\0\0"s));
    CHECK(four.get(0, 0, 0) == 1.0f);
    CHECK(four.get(1, 0, 1) == 1.0f);
    CHECK(four.get(2, 0, 1) == 1.0f);
    CHECK(read_bytes("a.bmp", bmp(2, 1, 8, 0, 2, palette, "\0\1\0\0"s)).get(1, 0, 1) == 1.0f);
    // 5-5-5, and 5-6-5 by masks.
    CHECK(read_bytes("a.bmp", bmp(1, 1, 16, 0, 0, "", "\x00\x7c\0\0"s)).get(0, 0, 0) == 1.0f);
    std::string const masks = "\x00\xf8\0\0\xe0\x07\0\0\x1f\0\0\0"s;
    CHECK(read_bytes("a.bmp", bmp(1, 1, 16, 3, 0, masks, "\xe0\x07\0\0"s)).get(0, 0, 1) == 1.0f);
    Image const alpha = read_bytes(
        "a.bmp", bmp(1, 1, 32, 6, 0, "\xff\0\0\0\0\xff\0\0\0\0\xff\0\0\0\0\xff"s, "\xff\0\0\x80"s));
    CHECK(alpha.channels() == 4);
    CHECK(alpha.get(0, 0, 0) == 1.0f);
    CHECK(alpha.get(0, 0, 3) == doctest::Approx(128 / 255.0));
    CHECK(read_bytes("a.bmp", bmp(1, 1, 32, 0, 0, "", "\xff\0\0\0"s)).get(0, 0, 2) == 1.0f);
    // OS/2's header has 16-bit sizes and palettes of three bytes.
    CHECK(read_bytes("a.bmp", "BM" + little(0, 8) + little(32, 4) + little(12, 4) + little(1, 2) +
                                  little(1, 2) + little(1, 2) + little(1, 2) + "\0\0\xff\0\xff\0\x80\0\0\0"s)
              .get(0, 0, 1) == 1.0f);
}

TEST_CASE("BMP: what is refused") {
    auto const rows = std::string(8, '\0');
    for (auto const& file : {
             bmp(1, 2, 24, 0, 0, "", rows.substr(1)),            // truncated
             bmp(20000, 20000, 24, 0, 0, "", rows),              // much more than there is
             bmp(0, 2, 24, 0, 0, "", rows),                      // no pixels
             bmp(1, 2, 8, 1, 0, std::string(1024, '\0'), rows),  // run lengths
             bmp(1, 2, 7, 0, 0, "", rows),                       // no such depth
             bmp(2, 1, 8, 0, 300, std::string(1200, '\0'), rows),
             bmp(2, 1, 8, 0, 2, rows, "\2\0\0\0"s),  // colour 2 of 2
             "BM"s,
             "BM" + std::string(40, '\xff'),
         })
        CHECK(refusal("a.bmp", file) == ErrorKind::Input);
    CHECK(refusal("a.bmp", bmp(70000, 1, 24, 0, 0, "", rows)) == ErrorKind::Limit);
    CHECK(refusal("a.bmp", bmp(1, std::numeric_limits<int>::min(), 24, 0, 0, "", rows)) == ErrorKind::Limit);
}

TEST_CASE("the content tells the format, not the name") {
    CHECK(read_bytes("lies.png", "Pf\n1 1\n1\n\x3f\x80\0\0"s).get(0, 0, 0) == 1.0f);
    CHECK(refusal("empty.png", "") == ErrorKind::Input);
    CHECK(refusal("a.png", "hello") == ErrorKind::Input);
}
