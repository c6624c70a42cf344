// Pictures written byte by byte, from the formats' descriptions.
#include "support.h"

#include "image/read.h"

#include <doctest/doctest.h>

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

TEST_CASE("the content tells the format, not the name") {
    CHECK(read_bytes("lies.png", "Pf\n1 1\n1\n\x3f\x80\0\0"s).get(0, 0, 0) == 1.0f);
    CHECK(refusal("empty.png", "") == ErrorKind::Input);
    CHECK(refusal("a.png", "hello") == ErrorKind::Input);
}
