// Files of pictures: read once, kept in their own format, and refused by name and place.
#include "model/pictures.h"

#include "image/read.h"
#include "image/write.h"
#include "model/texture.h"
#include "support.h"

#include <doctest/doctest.h>

#include <fstream>

using namespace nephroid;
using namespace nephroid::test;
namespace fs = std::filesystem;

namespace {

/// Noise of bytes in linear light, of default channels.
Image noise(PixelFormat format, int width, int height, int channels) {
    Image image(format, width, height, default_channel_names(channels));
    Random r(7);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) image.set(x, y, c, static_cast<float>(r.below(256)) / 255.0f);
    return image;
}

Scene scene_of(std::vector<std::pair<std::string, std::string>> const& files) {
    Scene s;
    s.files = {"scene.pbrt"};
    std::uint32_t line = 1;
    for (auto const& [path, encoding] : files) s.add(ImageFile{path, encoding, {0, line++}});
    return s;
}

std::string error_of(Scene const& s) {
    try {
        Pictures const pictures(s);
    } catch (Error const& e) {
        return e.what();
    }
    return "no error";
}

void write(std::string const& path, std::string const& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string big_endian(std::uint32_t v) {
    std::string s;
    for (int shift = 24; shift >= 0; shift -= 8) s += static_cast<char>(v >> shift & 255u);
    return s;
}
std::uint32_t crc(std::string const& bytes) {
    std::uint32_t c = ~0u;
    for (char const b : bytes) {
        c ^= static_cast<unsigned char>(b);
        for (int k = 0; k < 8; ++k) c = c >> 1 ^ (c & 1 ? 0xedb88320u : 0u);
    }
    return ~c;
}
/// A PNG that claims so many pixels and has none.
std::string png_header(std::uint32_t width, std::uint32_t height) {
    std::string const body =
        "IHDR" + big_endian(width) + big_endian(height) + std::string("\x08\x02\0\0\0", 5);
    return "\x89PNG\r\n\x1a\n" + big_endian(13) + body + big_endian(crc(body)) + big_endian(0) + "IDAT" +
           big_endian(crc("IDAT"));
}

bool contains(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a file is read once, whatever it is called and however it is read") {
    Folder const folder;
    auto const png = folder.file("a.png");
    write_png(png, noise(PixelFormat::U8, 64, 64, 3));
    fs::create_symlink(png, folder.file("link.png"));
    fs::create_hard_link(png, folder.file("hard.png"));
    fs::create_directory(folder.file("sub"));
    auto const around = folder.file("sub/../a.png");
    fs::copy_file(png, folder.file("copy.png"));
    Pictures const one(scene_of({{png, ""}}));
    std::size_t const levels = 64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1;
    CHECK(one.bytes() == 3 * levels);
    CHECK(one.files() == 1);

    Scene const s = scene_of({{png, ""},
                              {png, "sRGB"},
                              {folder.file("link.png"), ""},
                              {folder.file("hard.png"), "sRGB"},
                              {around, ""}});
    Pictures const same(s);
    CHECK(s.images.size() == 5);
    CHECK(same.bytes() == one.bytes());
    CHECK(same.files() == 1);
    for (std::uint32_t i = 1; i < 5; ++i) CHECK(&same[ImageId{i}] == &same[ImageId{0}]);

    // Another encoding shares the picture and has its own smaller levels, which are averages of light.
    Pictures const two(scene_of({{png, ""}, {folder.file("link.png"), "linear"}, {png, "gamma 2"}}));
    CHECK(two.files() == 1);
    CHECK(two.bytes() == 3 * (levels + 2 * (levels - 64 * 64)));
    Image const &srgb = two[ImageId{0}].level(0), &linear = two[ImageId{1}].level(0),
                &squared = two[ImageId{2}].level(0);
    CHECK(srgb.shares_bytes_with(linear));
    CHECK(srgb.shares_bytes_with(squared));
    CHECK(srgb.encoding() == Encoding::srgb());
    int wrong = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                float const byte = static_cast<float>(srgb.u8()[srgb.index(x, y, c)]) / 255.0f;
                wrong += linear.get(x, y, c) != byte;
                wrong += std::abs(squared.get(x, y, c) - byte * byte) > 1e-6f;
                wrong += std::abs(srgb.get(x, y, c) - srgb_to_linear(byte)) > 1e-6f;
            }
    CHECK(wrong == 0);
    CHECK(two[ImageId{1}].level(1).encoding() == Encoding::linear());

    Pictures const copied(scene_of({{png, ""}, {folder.file("copy.png"), ""}}));
    CHECK(copied.files() == 2);
    CHECK(copied.bytes() == 2 * one.bytes());
}

TEST_CASE("pictures that store light are one whatever encoding is asked for; deep PNGs are one for each") {
    Folder const folder;
    write_pfm(folder.file("a.pfm"), noise(PixelFormat::Float, 8, 8, 3));
    Pictures const light(scene_of({{folder.file("a.pfm"), ""}, {folder.file("a.pfm"), "sRGB"}}));
    CHECK(light.files() == 1);
    CHECK(&light[ImageId{0}] == &light[ImageId{1}]);
    // Sixteen bits are decoded when they are read, so each encoding has numbers of its own.
    write_png(folder.file("deep.png"), noise(PixelFormat::Float, 8, 8, 1), 16);
    Pictures const deep(
        scene_of({{folder.file("deep.png"), "linear"}, {folder.file("deep.png"), "gamma 2"}}));
    CHECK(deep.files() == 1);
    CHECK(deep.bytes() == 2 * 4 * (64 + 16 + 4 + 1));
    float const stored = deep[ImageId{0}].texel(0, 3, 3, 0);
    CHECK(deep[ImageId{1}].texel(0, 3, 3, 0) == doctest::Approx(stored * stored).epsilon(1e-4));
}

TEST_CASE("bytes stay bytes, halves stay halves, and floats become halves only where nothing is lost") {
    Folder const folder;
    auto const format_of = [](std::string const& path) {
        Pictures const p(scene_of({{path, ""}}));
        return p[ImageId{0}].level(0).format();
    };
    write_png(folder.file("b.png"), noise(PixelFormat::U8, 5, 4, 3));
    CHECK(format_of(folder.file("b.png")) == PixelFormat::U8);
    write_jpeg(folder.file("b.jpg"), noise(PixelFormat::U8, 8, 8, 3));
    CHECK(format_of(folder.file("b.jpg")) == PixelFormat::U8);
    write_exr(folder.file("h.exr"), noise(PixelFormat::Half, 5, 4, 3));
    CHECK(format_of(folder.file("h.exr")) == PixelFormat::Half);

    Image exact(PixelFormat::Float, 4, 2, {"R", "G", "B"});
    for (int i = 0; i < 24; ++i)
        exact.floats()[static_cast<std::size_t>(i)] = std::ldexp(static_cast<float>(i), i - 20);
    write_pfm(folder.file("exact.pfm"), exact);
    CHECK(format_of(folder.file("exact.pfm")) == PixelFormat::Half);
    Pictures const p(scene_of({{folder.file("exact.pfm"), ""}}));
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 3; ++c) CHECK(p[ImageId{0}].texel(0, x, y, c) == exact.get(x, y, c));
    for (float const v : {1.0f / 3, 70000.0f, 1e-9f}) {
        Image broken = exact;
        broken.floats()[7] = v;
        write_pfm(folder.file("float.pfm"), broken);
        CHECK(format_of(folder.file("float.pfm")) == PixelFormat::Float);
    }
    // Radiance's pictures have eight binary digits and fit, unless they go below what a half can hold.
    Image sky(PixelFormat::Float, 8, 8, {"R", "G", "B"});
    Random r(3);
    for (float& v : sky.floats()) v = static_cast<float>(std::pow(2.0, r.uniform(-6, 15)));
    write_hdr(folder.file("sky.hdr"), sky);
    CHECK(format_of(folder.file("sky.hdr")) == PixelFormat::Half);
}

TEST_CASE("pictures of one texel, of two channels, with NaN, without colour") {
    Folder const folder;
    auto const look = [&](std::string const& path, Vec2 uv) {
        Scene s = scene_of({{path, ""}});
        ImageTexture t;
        t.image = ImageId{0}, t.filter = FilterMode::Ewa, t.role = SpectrumRole::Unbounded;
        auto const id = s.add(Texture{t, {}});
        Assets const a(s);
        TexturePoint p;
        p.uv = uv, p.duv_dx = {0.3f, 0.1f}, p.duv_dy = {0, 0.2f};
        Spectrum const v = evaluate_spectrum(a, id, p, Wavelengths::rgb());
        CHECK(std::isfinite(evaluate_float(a, id, p)));
        return Vec3{v[0], v[1], v[2]};
    };
    Image one(PixelFormat::Float, 1, 1, {"R", "G", "B"});
    one.floats() = {0.25f, 0.5f, 0.75f};
    write_pfm(folder.file("one.pfm"), one);
    for (Vec2 const uv : {Vec2{0, 0}, Vec2{0.5f, 0.5f}, Vec2{-7.3f, 1e6f}})
        CHECK(glm::length(look(folder.file("one.pfm"), uv) - Vec3{0.25f, 0.5f, 0.75f}) < 1e-6f);
    // Gray and alpha: gray.
    Image two(PixelFormat::U8, 4, 4, {"Y", "A"}, Encoding::srgb());
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) two.set(x, y, 0, 0.5f), two.set(x, y, 1, 0.25f);
    write_png(folder.file("two.png"), two);
    Vec3 const gray = look(folder.file("two.png"), {0.3f, 0.3f});
    CHECK(gray.x == doctest::Approx(0.5).epsilon(0.01));
    CHECK(gray.x == gray.y);
    CHECK(gray.y == gray.z);
    // NaN and negative numbers are black, infinities the largest number there is.
    Image bad(PixelFormat::Float, 2, 2, {"R", "G", "B"});
    bad.floats() = {1, 1, 1, std::nanf(""), std::nanf(""), std::nanf(""), kInfinity, 2, 2, -kInfinity, -1, 4};
    write_pfm(folder.file("bad.pfm"), bad);
    Pictures const p(scene_of({{folder.file("bad.pfm"), ""}}));
    for (int level = 0; level < 2; ++level) CHECK(count_bad_pixels(p[ImageId{0}].level(level)) == 0);
    CHECK(p[ImageId{0}].texel(0, 1, 0, 0) == 0);
    CHECK(p[ImageId{0}].texel(0, 0, 1, 0) == 1);
    CHECK(p[ImageId{0}].texel(0, 1, 1, 2) == 4);
    CHECK(is_finite(look(folder.file("bad.pfm"), {0.5f, 0.5f})));
}

TEST_CASE("pictures that cannot be are refused before memory is taken for them, with their place") {
    Folder const folder;
    auto const refused = [&](std::string const& name, std::string const& bytes) {
        auto const path = folder.file(name);
        write(path, bytes);
        std::string const message = error_of(scene_of({{path, ""}}));
        CAPTURE(message);
        CHECK(message.starts_with("scene.pbrt:1: "));
        CHECK(contains(message, name));
        return message;
    };
    CHECK(contains(error_of(scene_of({{folder.file("none.png"), ""}})), "scene.pbrt:1: "));
    CHECK(contains(error_of(scene_of({{folder.file("none.png"), ""}})), "none.png"));
    CHECK(contains(error_of(scene_of({{folder.file(""), ""}})), "scene.pbrt:1: "));  // a folder
    refused("empty.png", "");
    CHECK(contains(refused("text.png", "this is no picture"),
                   "PNG, JPEG, EXR, HDR, PFM, BMP and TGA are read"));
    refused("zero.pfm", "PF\n0 4\n-1\n");
    refused("zero.png", png_header(0, 16));
    refused("wide.png", png_header(70000, 1));
    CHECK(contains(refused("wide.pfm", "PF\n70000 1\n-1\n"), "at most 65536 a side"));
    CHECK(contains(refused("huge.png", png_header(60000, 60000)), "more than 2 GiB"));
    CHECK(contains(refused("huge.pfm", "PF\n30000 30000\n-1\n"), "more than 2 GiB"));
    // 16384 x 16384 is allowed, but not in a file that cannot hold so many.
    CHECK(contains(refused("hollow.png", png_header(16384, 16384)), "truncated"));
    refused("hollow.pfm", "Pf\n16384 16384\n-1\n");
    write_png(folder.file("a.png"), noise(PixelFormat::U8, 4, 4, 3));
    for (char const* encoding : {"srgb", "gamma", "gamma x", "gamma 0", "gamma inf", "log"})
        CHECK(contains(error_of(scene_of({{folder.file("a.png"), ""}, {folder.file("a.png"), encoding}})),
                       "scene.pbrt:2: unknown encoding"));
}

TEST_CASE("a picture of 16384 x 16384 bytes takes four thirds of itself" * doctest::skip(!full())) {
    Folder const folder;
    write_png(folder.file("big.png"), Image(PixelFormat::U8, 16384, 16384, {"Y"}, Encoding::srgb()));
    Pictures const p(scene_of({{folder.file("big.png"), ""}, {folder.file("big.png"), "linear"}}));
    std::size_t const base = std::size_t{1} << 28;
    CHECK(p.bytes() < base + 2 * (base / 3 + 1));
    CHECK(p[ImageId{0}].levels() == 15);
}
