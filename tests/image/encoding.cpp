#include "support.h"

#include "image/chromaticity.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>

using namespace nephroid;

TEST_CASE("the sRGB curve has the values of IEC 61966-2-1 and inverts") {
    CHECK(srgb_to_linear(0.0f) == 0.0f);
    CHECK(srgb_to_linear(1.0f) == doctest::Approx(1.0));
    CHECK(srgb_to_linear(0.5f) == doctest::Approx(0.21404114));
    CHECK(srgb_to_linear(0.04f) == doctest::Approx(0.04 / 12.92));
    CHECK(linear_to_srgb(0.5f) == doctest::Approx(0.73535698));
    CHECK(linear_to_srgb(-0.5f) == doctest::Approx(-0.73535698));
    for (float x = 0; x <= 2.0f; x += 0.01f)
        CHECK(srgb_to_linear(linear_to_srgb(x)) == doctest::Approx(x).epsilon(1e-5));
}

TEST_CASE("every byte survives decoding and encoding, in every encoding") {
    for (Encoding const e :
         {Encoding::linear(), Encoding::srgb(), Encoding::power(2.2f), Encoding::power(0.7f)}) {
        Image image(PixelFormat::U8, 256, 1, {"Y", "A"}, e);
        for (int i = 0; i < 256; ++i)
            image.u8()[image.index(i, 0, 0)] = image.u8()[image.index(i, 0, 1)] =
                static_cast<std::uint8_t>(i);
        auto const before = image.u8();
        for (int i = 0; i < 256; ++i) {
            CHECK(image.get(i, 0, 1) == static_cast<float>(i) / 255.0f);  // alpha is linear
            for (int c = 0; c < 2; ++c) image.set(i, 0, c, image.get(i, 0, c));
        }
        CHECK(image.u8() == before);
    }
    for (int i = 0; i < 256; ++i) {
        auto const byte = static_cast<std::uint8_t>(i);
        CHECK(linear_to_srgb_byte(srgb_byte_to_linear(byte)) == byte);
    }
    CHECK(linear_to_srgb_byte(std::nanf("")) == 0);
    CHECK(linear_to_srgb_byte(kInfinity) == 255);
    CHECK(linear_to_srgb_byte(-1.0f) == 0);
}

TEST_CASE("half conversion: the portable definition agrees with the machine's") {
    int wrong = 0;
    for (std::uint32_t h = 0; h < 65536; ++h) {
        auto const half = static_cast<std::uint16_t>(h);
        float const f = half_to_float(half);
        wrong +=
            std::bit_cast<std::uint32_t>(f) != std::bit_cast<std::uint32_t>(half_to_float_portable(half));
        if (!std::isnan(f)) wrong += float_to_half(f) != half;
        wrong += float_to_half(f) != float_to_half_portable(f);
    }
    CHECK(wrong == 0);
    // Between halves: every 1/8 of a step, so that ties and their neighbours occur.
    for (std::uint64_t bits = 0; bits < 0x100000000ull; bits += 0x1003ull) {
        auto const f = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        wrong += float_to_half(f) != float_to_half_portable(f);
    }
    for (std::uint32_t bits = 0x33000000u; bits < 0x48000000u; bits += 0x400u)
        wrong +=
            float_to_half(std::bit_cast<float>(bits)) != float_to_half_portable(std::bit_cast<float>(bits));
    CHECK(wrong == 0);
}

TEST_CASE("images refuse sizes beyond their limits before allocating") {
    using test::error_of;
    CHECK(error_of([] { Image(PixelFormat::U8, 0, 1, {"Y"}); }) == ErrorKind::Input);
    CHECK(error_of([] { Image(PixelFormat::U8, 1, -1, {"Y"}); }) == ErrorKind::Input);
    CHECK(error_of([] { Image(PixelFormat::U8, 1, 1, {}); }) == ErrorKind::Input);
    CHECK(error_of([] { Image(PixelFormat::U8, 65537, 1, {"Y"}); }) == ErrorKind::Limit);
    CHECK(error_of([] { Image(PixelFormat::Float, 65536, 65536, {"Y"}); }) == ErrorKind::Limit);
    CHECK(Image().empty());
}

TEST_CASE("sanitize replaces what is no light, and counts pixels") {
    Image image(PixelFormat::Float, 3, 2, {"R", "G", "B"});
    image.set(0, 0, 0, 5.0f);
    image.set(1, 0, 0, kInfinity);
    image.set(1, 0, 1, -1.0f);
    image.set(2, 0, 2, std::nanf(""));
    image.set(0, 1, 1, -kInfinity);
    image.set(1, 1, 2, -0.0f);  // still no light missing
    CHECK(count_bad_pixels(image) == 3);
    CHECK(sanitize(image) == 3);
    CHECK(count_bad_pixels(image) == 0);
    CHECK(image.get(1, 0, 0) == 5.0f);
    CHECK(image.get(1, 0, 1) == 0.0f);
    CHECK(image.get(2, 0, 2) == 0.0f);
    CHECK(image.get(0, 1, 1) == 0.0f);
}

TEST_CASE("halves clamp finite numbers and keep infinities") {
    Image image(PixelFormat::Half, 1, 1, {"Y"});
    image.set(0, 0, 0, 1e9f);
    CHECK(image.get(0, 0, 0) == kLargestHalf);
    image.set(0, 0, 0, -kInfinity);
    CHECK(image.get(0, 0, 0) == -kInfinity);
    CHECK(image.bytes() == 2);
    CHECK(image.channel("Y") == 0);
    CHECK_FALSE(image.channel("R").has_value());
}

TEST_CASE("other primaries: XYZ to Rec. 709, and nothing to do without them") {
    Image image(PixelFormat::Float, 1, 1, {"R", "G", "B"});
    image.floats() = {0.9504559f, 1.0f, 1.0890578f};  // D65
    CHECK_FALSE(convert_to_rec709(image));
    image.chromaticities = Chromaticities{{1, 0}, {0, 1}, {0, 0}, {1 / 3.0f, 1 / 3.0f}};
    CHECK(convert_to_rec709(image));
    for (int c = 0; c < 3; ++c) CHECK(image.get(0, 0, c) == doctest::Approx(1).epsilon(1e-3));
    CHECK_FALSE(convert_to_rec709(image));
    image.chromaticities = kRec709;
    CHECK_FALSE(convert_to_rec709(image));
    image.chromaticities = Chromaticities{{0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.0f}};
    CHECK_FALSE(convert_to_rec709(image));
}
