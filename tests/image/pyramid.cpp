#include "support.h"

#include "image/compare.h"
#include "image/pyramid.h"

#include <doctest/doctest.h>

using namespace nephroid;

namespace {

constexpr Wrap kWraps[] = {Wrap::Repeat, Wrap::Black, Wrap::Clamp, Wrap::OctahedralSphere};
constexpr TextureFilter kFilters[] = {TextureFilter::Point, TextureFilter::Bilinear, TextureFilter::Trilinear,
                                      TextureFilter::Ewa};

Image noise(int width, int height, int channels) {
    Image image(PixelFormat::Float, width, height, default_channel_names(channels));
    std::uint32_t state = 1;
    for (float& v : image.floats()) {
        state = state * 1664525u + 1013904223u;
        v = static_cast<float>(state >> 8) * 0x1p-24f;
    }
    return image;
}

}  // namespace

TEST_CASE("each level has the image's mean, for any size") {
    for (auto const& [w, h] : {std::pair{64, 64}, {37, 53}, {1, 9}, {7, 1}, {3, 5}, {100, 1}, {33, 16}}) {
        Pyramid const pyramid(noise(w, h, 3));
        auto const mean = channel_means(pyramid.level(0));
        for (int i = 1; i < pyramid.levels(); ++i) {
            CHECK(pyramid.level(i).width() == std::max(1, pyramid.level(i - 1).width() / 2));
            auto const here = channel_means(pyramid.level(i));
            for (std::size_t c = 0; c < 3; ++c) CHECK(here[c] == doctest::Approx(mean[c]).epsilon(1e-5));
        }
        CHECK(pyramid.level(pyramid.levels() - 1).width() == 1);
        CHECK(pyramid.level(pyramid.levels() - 1).height() == 1);
    }
}

TEST_CASE("sRGB bytes are averaged as light: black and white make 188") {
    Image image(PixelFormat::U8, 2, 2, {"Y"}, Encoding::srgb());
    image.u8() = {0, 255, 255, 0};
    Pyramid const pyramid(std::move(image));
    CHECK(pyramid.levels() == 2);
    CHECK(pyramid.level(1).format() == PixelFormat::U8);
    CHECK(pyramid.level(1).u8()[0] == 188);
    CHECK(pyramid.bytes() == 5);
}

TEST_CASE("a constant stays constant under every filter and wrap") {
    for (PixelFormat const format : {PixelFormat::U8, PixelFormat::Half, PixelFormat::Float})
        for (int const channels : {1, 3, 4}) {
            Image image(format, 19, 12, default_channel_names(channels), Encoding::srgb());
            for (int y = 0; y < 12; ++y)
                for (int x = 0; x < 19; ++x)
                    for (int c = 0; c < channels; ++c) image.set(x, y, c, c == 3 ? 1.0f : 0.5f);
            Pyramid const pyramid(std::move(image));
            float const value = pyramid.texel(0, 3, 3, 0);
            for (Wrap const wrap : kWraps)
                for (TextureFilter const filter : kFilters)
                    for (float const d : {0.0f, 0.01f, 0.1f, 0.7f, 3.0f}) {
                        if (wrap == Wrap::Black && d > 0.01f) continue;  // mixes with the black around
                        Vec2 const st(0.4f, 0.55f), dst0(d, 0.3f * d), dst1(-0.1f * d, d * 0.2f);
                        CHECK(pyramid.lookup(st, filter, wrap, dst0, dst1) ==
                              doctest::Approx(value).epsilon(1e-5));
                        CHECK(pyramid.lookup_rgb(st, filter, wrap, dst0, dst1).z ==
                              doctest::Approx(value).epsilon(1e-5));
                    }
        }
}

TEST_CASE("wrap modes") {
    auto at = [](Wrap wrap, int x, int y) { return wrap_texel(wrap, 4, 4, x, y) ? Vec2i(x, y) : Vec2i(-1); };
    CHECK(at(Wrap::Repeat, -1, 9) == Vec2i(3, 1));
    CHECK(at(Wrap::Clamp, -7, 9) == Vec2i(0, 3));
    CHECK(at(Wrap::Black, -1, 0) == Vec2i(-1));
    CHECK(at(Wrap::Black, 3, 0) == Vec2i(3, 0));
    CHECK(at(Wrap::OctahedralSphere, -1, 0) == Vec2i(0, 3));
    CHECK(at(Wrap::OctahedralSphere, 4, 1) == Vec2i(3, 2));
    CHECK(at(Wrap::OctahedralSphere, 1, -1) == Vec2i(2, 0));
    CHECK(at(Wrap::OctahedralSphere, 1, 4) == Vec2i(2, 3));
    CHECK(at(Wrap::OctahedralSphere, -1, -1) == Vec2i(3, 3));
    // Anything lands inside, and two crossings in a row come back.
    for (int x = -20; x < 20; ++x)
        for (int y = -20; y < 20; ++y) {
            Vec2i const p = at(Wrap::OctahedralSphere, x, y);
            bool const inside = p.x >= 0 && p.x < 4 && p.y >= 0 && p.y < 4;
            CHECK(inside);
            CHECK(at(Wrap::OctahedralSphere, x + 8, y - 8) == p);
        }
}

TEST_CASE("bilinear lookups hit texel centres and mix halfway") {
    Image image(PixelFormat::Float, 4, 1, {"Y"});
    image.floats() = {0, 1, 2, 3};
    Pyramid const pyramid(std::move(image));
    CHECK(pyramid.bilerp(0, {0.375f, 0.5f}, 0) == doctest::Approx(1));
    CHECK(pyramid.bilerp(0, {0.5f, 0.5f}, 0) == doctest::Approx(1.5));
    CHECK(pyramid.bilerp(0, {0.0f, 0.5f}, 0, Wrap::Repeat) == doctest::Approx(1.5));
    CHECK(pyramid.bilerp(0, {0.0f, 0.5f}, 0, Wrap::Clamp) == doctest::Approx(0));
    CHECK(pyramid.bilerp(0, {1.0f, 0.5f}, 0, Wrap::Black) == doctest::Approx(1.5));
    CHECK(pyramid.lookup({0.6f, 0.1f}, TextureFilter::Point, Wrap::Clamp, {}, {}) == 2.0f);
    CHECK(pyramid.lookup({0.6f, 0.1f}, TextureFilter::Trilinear, Wrap::Clamp, {9, 9}, {0, 0}) ==
          doctest::Approx(1.5));
}

TEST_CASE("EWA follows a linear ramp, whatever the ellipse") {
    Image image(PixelFormat::Float, 256, 256, {"Y"});
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            image.set(x, y, 0, (static_cast<float>(x) + 0.5f) / 256 + (static_cast<float>(y) + 0.5f) / 128);
    Pyramid const pyramid(std::move(image));
    for (float const angle : {0.0f, 0.7f, 2.0f})
        for (float const size : {0.001f, 0.01f, 0.03f}) {
            Vec2 const d0 = size * Vec2(std::cos(angle), std::sin(angle));
            Vec2 const d1 = 0.2f * size * Vec2(-std::sin(angle), std::cos(angle));
            float const v = pyramid.lookup({0.43f, 0.52f}, TextureFilter::Ewa, Wrap::Clamp, d0, d1);
            CHECK(v == doctest::Approx(0.43 + 2 * 0.52).epsilon(0.01));
        }
}

TEST_CASE("one number from colour: the average, or alpha where something is transparent") {
    Image opaque(PixelFormat::Float, 1, 1, {"R", "G", "B", "A"});
    opaque.floats() = {1, 2, 6, 1};
    Image leaf = opaque;
    leaf.floats()[3] = 0.25f;
    Image swapped(PixelFormat::Float, 1, 1, {"B", "G", "R"});
    swapped.floats() = {1, 2, 3};
    auto lookup = [](Image const& i) {
        return Pyramid(i).lookup({}, TextureFilter::Bilinear, Wrap::Repeat, {}, {});
    };
    CHECK(lookup(opaque) == doctest::Approx(3));
    CHECK(lookup(leaf) == doctest::Approx(0.25));
    CHECK(Pyramid(swapped).bilerp_rgb(0, {}) == Vec3(3, 2, 1));
}

TEST_CASE("broken coordinates read something and return") {
    Pyramid const pyramid(noise(16, 8, 3));
    float const nan = std::nanf("");
    for (TextureFilter const filter : kFilters)
        for (Wrap const wrap : kWraps)
            for (Vec2 const st :
                 {Vec2(nan, 0), Vec2(kInfinity, -kInfinity), Vec2(1e30f, -1e30f), Vec2(-1e9f, 3e9f)})
                for (Vec2 const d : {Vec2(0), Vec2(nan), Vec2(1e30f, 1), Vec2(1e-30f), Vec2(kInfinity, 0)})
                    CHECK(is_finite(pyramid.lookup_rgb(st, filter, wrap, d, Vec2(0.001f, 0))));
}
