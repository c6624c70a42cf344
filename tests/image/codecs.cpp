// What is written is read again.
#include "jpegs.h"
#include "support.h"

#include "image/peek.h"
#include "image/read.h"
#include "image/write.h"

#include <doctest/doctest.h>
#include <cstring>

#include <cmath>

using namespace nephroid;
using test::error_of;
using test::gradient;
using test::largest_difference;

TEST_CASE("PNG: bytes come back as they were, 16 bits within their rounding") {
    test::Folder const folder;
    for (int const channels : {1, 2, 3, 4}) {
        Image const bytes = gradient(PixelFormat::U8, 37, 21, channels, Encoding::srgb());
        write_png(folder / "a.png", bytes);
        Image const again = read_image(folder / "a.png");
        CHECK(again.format() == PixelFormat::U8);
        CHECK(again.encoding() == Encoding::srgb());
        CHECK(again.channel_names() == bytes.channel_names());
        CHECK(again.u8() == bytes.u8());

        Image const floats = gradient(PixelFormat::Float, 37, 21, channels);
        write_png(folder / "b.png", floats, 16);
        Image const deep = read_image(folder / "b.png");
        CHECK(deep.format() == PixelFormat::Float);
        CHECK(largest_difference(deep, floats) < 2e-5f);
    }
    Image const linear = read_image(folder / "a.png", Encoding::linear());
    CHECK(linear.encoding() == Encoding::linear());
    CHECK(linear.get(9, 9, 0) == static_cast<float>(linear.u8()[linear.index(9, 9, 0)]) / 255.0f);
}

TEST_CASE("PNG: the same picture makes the same file, and what is no colour is clamped") {
    test::Folder const folder;
    Image image = gradient(PixelFormat::Float, 16, 16, 3);
    image.set(0, 0, 0, std::nanf(""));
    image.set(1, 0, 0, kInfinity);
    image.set(2, 0, 0, -1.0f);
    write_png(folder / "a.png", image);
    write_png(folder / "b.png", image);
    CHECK(read_file(folder / "a.png") == read_file(folder / "b.png"));
    Image const again = read_image(folder / "a.png");
    CHECK(again.get(0, 0, 0) == 0);
    CHECK(again.get(1, 0, 0) == 1);
    CHECK(again.get(2, 0, 0) == 0);
    CHECK(error_of([&] { write_png(folder / "c.png", gradient(PixelFormat::U8, 2, 2, 5)); }) ==
          ErrorKind::Input);
    CHECK(error_of([&] { write_png(folder / "c.png", Image()); }) == ErrorKind::Input);
    CHECK(folder.entries() == 2);
}

TEST_CASE("JPEG: close at high quality; progressive and CMYK files") {
    test::Folder const folder;
    for (int const channels : {1, 3}) {
        Image const image = gradient(PixelFormat::Float, 61, 43, channels);
        write_jpeg(folder / "a.jpg", image, 98);
        Image const again = read_image(folder / "a.jpg");
        CHECK(again.channels() == channels);
        CHECK(largest_difference(again, image) < 0.03f);
    }
    Image const progressive =
        read_image(test::write(folder, "p.jpg", test::from_hex(test::kProgressiveJpeg)));
    CHECK(std::abs(int{progressive.u8()[0]} - 200) <= 1);
    CHECK(std::abs(int{progressive.u8()[1]} - 100) <= 1);
    CHECK(std::abs(int{progressive.u8()[2]} - 50) <= 1);
    for (std::string_view const hex : {test::kCmykJpeg, test::kYcckJpeg}) {  // orange, in inverted inks
        Image const cmyk = read_image(test::write(folder, "c.jpg", test::from_hex(hex)));
        CHECK(cmyk.channels() == 3);
        CHECK(std::abs(int{cmyk.u8()[0]} - 255) <= 2);
        CHECK(std::abs(int{cmyk.u8()[1]} - 127) <= 2);
        CHECK(std::abs(int{cmyk.u8()[2]} - 0) <= 2);
    }
}

TEST_CASE("every prefix of a file is refused or read, never worse") {
    test::Folder const folder;
    Image const image = gradient(PixelFormat::Float, 9, 7, 3);
    for (char const* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.pfm"}) {
        CAPTURE(name);
        write_image(folder / name, image);
        auto const whole = read_file(folder / name);
        CHECK_NOTHROW(read_image(folder / name));
        std::size_t const step = whole.size() > 1500 ? 5 : 1;
        int accepted = 0;
        for (std::size_t n = 0; n < whole.size(); n += step) {
            write_file_atomically(folder / "cut", std::span(whole).first(n));
            auto const error = error_of([&] { (void)read_image(folder / "cut"); });
            accepted += error ? 0 : 1;
        }
        // An EXR file or a JPEG may lack a few last bytes that say nothing.
        CHECK(accepted <= 2);
    }
}

TEST_CASE("PFM and HDR") {
    test::Folder const folder;
    for (int const width : {5, 64, 300}) {
        Image image = gradient(PixelFormat::Float, width, 6, 3);
        image.set(1, 1, 0, 12345.678f);
        image.set(2, 1, 1, 1e-6f);
        write_pfm(folder / "a.pfm", image);
        CHECK(read_image(folder / "a.pfm").floats() == image.floats());
        write_hdr(folder / "a.hdr", image);
        Image const hdr = read_image(folder / "a.hdr");
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < width; ++x) {
                float const top =
                    std::fmax(image.get(x, y, 0), std::fmax(image.get(x, y, 1), image.get(x, y, 2)));
                for (int c = 0; c < 3; ++c)
                    CHECK(std::abs(hdr.get(x, y, c) - image.get(x, y, c)) <= top / 256 * 1.001f);
            }
    }
    Image odd(PixelFormat::Float, 8, 1, {"R", "G", "B"});
    odd.floats() = {1e38f, 0, 0, kInfinity, -1, 0, std::nanf(""), 0, 0, 1e-39f, 0, 0, 0.9999999f, 0, 0};
    odd.floats().resize(24);
    write_hdr(folder / "b.hdr", odd);
    Image const again = read_image(folder / "b.hdr");
    CHECK(again.get(0, 0, 0) == doctest::Approx(1e38).epsilon(0.01));
    CHECK(again.get(1, 0, 0) > 1e38f);
    CHECK(again.get(1, 0, 1) == 0);
    CHECK(again.get(2, 0, 0) == 0);
    CHECK(again.get(3, 0, 0) == 0);
    CHECK(again.get(4, 0, 0) == 1);
    write_pfm(folder / "b.pfm", gradient(PixelFormat::Half, 3, 3, 1));
    CHECK(read_image(folder / "b.pfm").channels() == 1);
}

TEST_CASE("EXR: planes of every type, windows and text come back without loss") {
    test::Folder const folder;
    ExrFile file;
    file.width = 13;
    file.height = 7;
    file.data_x0 = 4;
    file.data_y0 = -2;
    file.display_x0 = -1;
    file.display_width = 100;
    file.display_height = 50;
    file.chromaticities = kRec709;
    file.attributes = {{"scene", "a \"quoted\" name\nand a line"}, {"passes", "0:16"}, {"empty", ""}};
    ExrChannel a{"A.first", ExrChannel::Type::Float}, b{"B", ExrChannel::Type::Half},
        c{"count", ExrChannel::Type::Uint};
    for (int i = 0; i < 13 * 7; ++i) {
        a.data.push_back(1.0f / static_cast<float>(i + 1));
        b.data.push_back(half_to_float(static_cast<std::uint16_t>(i * 300)));
        c.uints.push_back(0xffffffffu - static_cast<std::uint32_t>(i));
    }
    a.data[3] = kInfinity;
    a.data[4] = -0.0f;
    b.data[5] = -kInfinity;
    file.channels = {a, b, c};
    write_exr(folder / "a.exr", file);
    ExrFile const again = read_exr(folder / "a.exr");
    CHECK(again.width == 13);
    CHECK(again.height == 7);
    CHECK(again.data_x0 == 4);
    CHECK(again.data_y0 == -2);
    CHECK(again.display_x0 == -1);
    CHECK(again.display_y0 == 0);
    CHECK(again.display_width == 100);
    CHECK(again.display_height == 50);
    CHECK(again.attributes == file.attributes);
    CHECK(again.chromaticities == file.chromaticities);
    REQUIRE(again.channels.size() == 3);
    for (ExrChannel const& channel : file.channels) {
        ExrChannel const* const found = again.find(channel.name);
        REQUIRE(found != nullptr);
        CHECK(found->type == channel.type);
        CHECK(found->data == channel.data);
        CHECK(found->uints == channel.uints);
    }
    write_exr(folder / "b.exr", again);
    CHECK(read_file(folder / "a.exr") == read_file(folder / "b.exr"));
    CHECK(again.find("none") == nullptr);
    file.channels[0].data.pop_back();
    CHECK(error_of([&] { write_exr(folder / "c.exr", file); }) == ErrorKind::Input);
}

TEST_CASE("EXR pictures: plain channels first, then gray, then a layer, then anything") {
    test::Folder const folder;
    auto picture = [&](std::vector<std::string> const& names) {
        ExrFile file;
        file.width = file.height = 1;
        float value = 1;
        for (std::string const& name : names)
            file.channels.push_back({name, ExrChannel::Type::Half, {value++}});
        write_exr(folder / "a.exr", file);
        return read_image(folder / "a.exr");
    };
    using Names = std::vector<std::string>;
    Image const rgb = picture({"albedo.R", "albedo.G", "albedo.B", "R", "G", "B"});
    CHECK(rgb.channel_names() == Names{"R", "G", "B"});
    CHECK(rgb.get(0, 0, 0) == 4);
    CHECK(rgb.format() == PixelFormat::Half);
    Image const rgba = picture({"A", "B", "G", "R", "Z"});
    CHECK(rgba.channel_names() == Names{"R", "G", "B", "A"});
    CHECK(rgba.get(0, 0, 3) == 1);
    CHECK(picture({"Y", "Z"}).channel_names() == Names{"Y"});
    Image const layer = picture({"view.B", "view.G", "view.R", "x"});
    CHECK(layer.channel_names() == Names{"R", "G", "B"});
    CHECK(layer.get(0, 0, 0) == 3);
    CHECK(picture({"G"}).channel_names() == Names{"G"});
    for (PixelFormat const format : {PixelFormat::Half, PixelFormat::Float}) {
        Image const image = gradient(format, 33, 17, 4);
        write_exr(folder / "b.exr", image);
        Image const again = read_image(folder / "b.exr");
        CHECK(again.format() == format);
        CHECK(largest_difference(again, image) == 0);
    }
}

TEST_CASE("write_image chooses by extension and names those it knows") {
    test::Folder const folder;
    Image const image = gradient(PixelFormat::Float, 8, 8, 3);
    for (char const* name : {"a.exr", "a.PNG", "a.jpeg", "a.pfm", "a.hdr"}) {
        write_image(folder / name, image);
        CHECK(largest_difference(read_image(folder / name), image) < 0.05f);
    }
    std::string message;
    CHECK(error_of([&] { write_image(folder / "a.gif", image); }, &message) == ErrorKind::Input);
    CHECK(message.find(".exr") != std::string::npos);
    CHECK(error_of([&] { write_image(folder / "missing/a.exr", image); }) == ErrorKind::Io);
}

TEST_CASE("EXR: deep files are refused, and so are attributes that reserved names would break") {
    test::Folder const folder;
    write_exr(folder / "a.exr", gradient(PixelFormat::Half, 4, 4, 1));
    std::string file = read_text_file(folder / "a.exr");
    file[5] = 0x08;  // the version's flag for deep data
    std::string message;
    auto const path = test::write(folder, "deep.exr", file);
    CHECK(error_of([&] { (void)read_image(path); }, &message) == ErrorKind::Input);
    CHECK(message.find("deep") != std::string::npos);
    CHECK(error_of([&] { (void)read_exr(path); }) == ErrorKind::Input);
    ExrFile reserved = read_exr(folder / "a.exr");
    reserved.attributes["channels"] = "no";
    CHECK(error_of([&] { write_exr(folder / "b.exr", reserved); }) == ErrorKind::Input);
    CHECK_FALSE(std::filesystem::exists(folder / "b.exr"));
}

TEST_CASE("how large a picture is can be told without reading it") {
    test::Folder const folder;
    Image const image = test::gradient(PixelFormat::Float, 37, 21, 3);
    for (char const* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.pfm"}) {
        write_image(folder / name, image);
        CHECK(peek_size(folder / name) == std::array<std::int64_t, 2>{37, 21});
    }
    CHECK(peek_size(test::write(folder, "c.hdr", "#?RADIANCE\n\n+X 37 -Y 21\n")) ==
          std::array<std::int64_t, 2>{37, 21});
    CHECK_FALSE(peek_size(test::write(folder, "d.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n")).has_value());
    CHECK_FALSE(peek_size(test::write(folder, "d.pfm", "PF\nwide high\n")).has_value());
    CHECK_FALSE(peek_size(folder / "nowhere.png").has_value());
    CHECK_FALSE(peek_size(folder.path()).has_value());
    std::string const cut = read_text_file(folder / "a.jpg").substr(0, 100);
    CHECK_FALSE(peek_size(test::write(folder, "cut.jpg", cut)).has_value());
}

TEST_CASE("planes are read to where they belong, and written from there") {
    test::Folder const folder;
    struct Pixel {
        float value;
        std::uint32_t number;
    };
    std::vector<Pixel> pixels(6 * 4);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = {static_cast<float>(i) / 3.0f, static_cast<std::uint32_t>(i) * 0x1234567u};
    ExrFile file;
    file.width = 6, file.height = 4, file.data_x0 = 3, file.data_y0 = -2;
    auto const* const base = reinterpret_cast<std::byte const*>(pixels.data());
    std::vector<ExrSourcePlane> const sources{{"value", ExrChannel::Type::Float, base, sizeof(Pixel)},
                                              {"number", ExrChannel::Type::Uint, base + 4, sizeof(Pixel)}};
    for (auto const compression : {ExrCompression::Zip, ExrCompression::Fast}) {
        write_exr(folder / "a.exr", file, sources, compression);
        std::vector<Pixel> back(pixels.size());
        ExrFile const header = read_exr(folder / "a.exr", [&](ExrFile const& h) {
            CHECK(h.channels.size() == 2);
            auto* const to = reinterpret_cast<std::byte*>(back.data());
            return std::vector<ExrTargetPlane>{{"value", ExrChannel::Type::Float, to, sizeof(Pixel)},
                                               {"number", ExrChannel::Type::Uint, to + 4, sizeof(Pixel)}};
        });
        CHECK(header.data_x0 == 3);
        CHECK(header.data_y0 == -2);
        CHECK(std::memcmp(back.data(), pixels.data(), pixels.size() * sizeof(Pixel)) == 0);
        CHECK(error_of([&] {
                  (void)read_exr(folder / "a.exr", [&](ExrFile const&) {
                      return std::vector<ExrTargetPlane>{
                          {"absent", ExrChannel::Type::Float, reinterpret_cast<std::byte*>(back.data()), 8}};
                  });
              }) == ErrorKind::Input);
    }
    CHECK(read_exr_header(folder / "a.exr").width == 6);
    CHECK(read_exr(folder / "a.exr").find("number")->uints[5] == pixels[5].number);
}
