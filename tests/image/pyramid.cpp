#include "support.h"

#include "image/compare.h"
#include "image/pyramid.h"
#include "statistics.h"

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

namespace {

/// What the elliptically weighted average stands for, by its definition and slowly: all of the picture, repeated, weighted by
/// the Gaussian exp(-2 r^2) - exp(-2) in the ellipse with the two derivatives as half axes, where those are conjugate
/// diameters: a point q is at the radius |M^-1 q|, M = (d0 d1). Each texel is sampled `sub` x `sub` times.
double ellipse_average(Image const& image, Vec2 st, Vec2 d0, Vec2 d1, int sub) {
    double const w = image.width(), h = image.height();
    double const a = static_cast<double>(d0.x) * w, b = static_cast<double>(d1.x) * w,
                 c = static_cast<double>(d0.y) * h, d = static_cast<double>(d1.y) * h;
    double const det = a * d - b * c;
    int const reach_x = static_cast<int>(std::hypot(a, b)) + 2,
              reach_y = static_cast<int>(std::hypot(c, d)) + 2;
    double const cx = static_cast<double>(st.x) * w, cy = static_cast<double>(st.y) * h;
    double sum = 0, weights = 0;
    for (int y = static_cast<int>(cy) - reach_y; y <= static_cast<int>(cy) + reach_y; ++y)
        for (int x = static_cast<int>(cx) - reach_x; x <= static_cast<int>(cx) + reach_x; ++x) {
            int wx = x, wy = y;
            wrap_texel(Wrap::Repeat, image.width(), image.height(), wx, wy);
            double const v = static_cast<double>(image.get(wx, wy, 0));
            for (int j = 0; j < sub; ++j)
                for (int i = 0; i < sub; ++i) {
                    double const u = x + (i + 0.5) / sub - cx, t = y + (j + 0.5) / sub - cy;
                    double const r2 = (std::pow(d * u - b * t, 2) + std::pow(a * t - c * u, 2)) / (det * det);
                    if (r2 >= 1) continue;
                    double const weight = std::exp(-2 * r2) - std::exp(-2.0);
                    sum += weight * v;
                    weights += weight;
                }
        }
    return sum / weights;
}

/// Waves of 24 to 64 texels: detail that filters of several texels see.
Image waves(int width, int height) {
    Image image(PixelFormat::Float, width, height, {"Y"});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double const u = 2 * 3.14159265358979 * x / width, v = 2 * 3.14159265358979 * y / height;
            image.set(x, y, 0,
                      static_cast<float>(0.5 + 0.2 * std::sin(8 * u + 3 * v) + 0.2 * std::cos(4 * u - 9 * v) +
                                         0.1 * std::sin(10 * v)));
        }
    return image;
}

double difference(double a, double b) { return std::abs(a - b); }

}  // namespace

TEST_CASE("EWA is the average over its ellipse") {
    Pyramid const pyramid(waves(256, 256));
    test::Random r(1);
    double sum_ewa = 0, sum_trilinear = 0, worst = 0;
    int const n = 300;
    for (int i = 0; i < n; ++i) {
        float const s = r.unit();
        Vec2 const st(s, r.unit());
        double const longer = std::pow(2.0, r.uniform(2, 5)) / 256, ratio = r.uniform(1, 8),
                     angle = r.uniform(0, 6.3);
        Vec2 const axis(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
        Vec2 const d0 = static_cast<float>(longer) * axis,
                   d1 = static_cast<float>(longer / ratio) * Vec2(-axis.y, axis.x);
        double const exact = ellipse_average(pyramid.level(0), st, d0, d1, 2);
        auto const look = [&](TextureFilter f) {
            return difference(static_cast<double>(pyramid.lookup(st, f, Wrap::Repeat, d0, d1)), exact);
        };
        double const ewa = look(TextureFilter::Ewa);
        worst = std::max(worst, ewa);
        sum_ewa += ewa;
        sum_trilinear += look(TextureFilter::Trilinear);
    }
    MESSAGE("mean error of EWA ", sum_ewa / n, " (worst ", worst, "), of trilinear ", sum_trilinear / n);
    // It reads a level where the short axis has a texel or two, widened by one texel, and mixes two levels.
    CHECK(sum_ewa / n < 0.015);
    CHECK(worst < 0.15);
    CHECK(sum_ewa < 0.3 * sum_trilinear);
}

TEST_CASE("EWA: the limit of anisotropy widens the short axis, and no other") {
    Pyramid const pyramid(waves(256, 256));
    test::Random r(2);
    for (int i = 0; i < 100; ++i) {
        float const s = r.unit();
        Vec2 const st(s, r.unit());
        auto const angle = static_cast<float>(r.uniform(0, 6.3));
        Vec2 const axis = Vec2(std::cos(angle), std::sin(angle)), other(-axis.y, axis.x);
        float const longer = 0.1f;
        auto const look = [&](float ratio, float limit) {
            return pyramid.lookup(st, TextureFilter::Ewa, Wrap::Repeat, longer * axis, longer / ratio * other,
                                  limit);
        };
        for (float const limit : {1.0f, 2.0f, 8.0f, 16.0f}) {
            CHECK(look(30, limit) == doctest::Approx(look(limit, 64)).epsilon(1e-3));
            float const within = 1 + 0.9f * (limit - 1);
            CHECK(look(within, limit) == doctest::Approx(look(within, 64)).epsilon(1e-5));
        }
        // What is no limit, or none that can be kept, is one that can.
        CHECK(look(1000, 1e9f) == look(1000, 64));
        CHECK(look(5, 0) == look(5, 1));
    }
}

TEST_CASE("trilinear mixes averages over squares of two sizes, one to two footprints wide") {
    constexpr int kSide = 256;
    Image const image = waves(kSide, kSide);
    Pyramid const pyramid(image);
    // Bilinear between the averages of squares of `size` texels, from the picture itself.
    auto const squares = [&](Vec2 st, int size) {
        double const x = static_cast<double>(st.x) * kSide / size - 0.5,
                     y = static_cast<double>(st.y) * kSide / size - 0.5;
        double sum = 0;
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                double average = 0;
                for (int v = 0; v < size; ++v)
                    for (int u = 0; u < size; ++u) {
                        int tx = (static_cast<int>(std::floor(x)) + i) * size + u;
                        int ty = (static_cast<int>(std::floor(y)) + j) * size + v;
                        wrap_texel(Wrap::Repeat, kSide, kSide, tx, ty);
                        average += static_cast<double>(image.get(tx, ty, 0)) / (size * size);
                    }
                double const fx = x - std::floor(x), fy = y - std::floor(y);
                sum += (i ? fx : 1 - fx) * (j ? fy : 1 - fy) * average;
            }
        return sum;
    };
    test::Random r(3);
    for (int i = 0; i < 200; ++i) {
        float const s = r.unit();
        Vec2 const st(s, r.unit());
        double const level = r.uniform(-1, 6);
        // The wider of the two axes counts, and twice its derivative is the width of a footprint.
        auto const half_width = static_cast<float>(std::exp2(level) / kSide / 2);
        Vec2 const d(0.3f * half_width, -half_width), e(0.9f * half_width, 0);
        double const v =
            static_cast<double>(pyramid.lookup(st, TextureFilter::Trilinear, Wrap::Repeat, d, e));
        int const base = std::max(0, static_cast<int>(std::floor(level)));
        double const t = std::max(0.0, level - base);
        double const exact = (1 - t) * squares(st, 1 << base) + t * squares(st, 2 << base);
        CHECK(difference(v, exact) < 1e-4);
        double const nearest =
            static_cast<double>(pyramid.lookup(st, TextureFilter::Bilinear, Wrap::Repeat, d, e));
        CHECK(difference(nearest, squares(st, 1 << base)) < 1e-4);
    }
}

TEST_CASE("pyramids are the same whether rows or whole levels are halved") {
    // Each level again, from all of the one above in doubles; sides of all parities.
    for (auto const& [w, h] : {std::pair{37, 53}, {64, 7}, {1, 19}, {23, 1}, {2, 3}, {3, 2}}) {
        Pyramid const pyramid(noise(w, h, 2));
        auto const share = [](int n, int i, int from) {  // of texel `from` of n in texel i of n / 2
            if (n == 1) return 1.0;
            int const m = n / 2;
            double const lo = static_cast<double>(i) * n / m, hi = static_cast<double>(i + 1) * n / m;
            return std::max(0.0, std::min(hi, from + 1.0) - std::max(lo, static_cast<double>(from))) /
                   (hi - lo);
        };
        for (int l = 1; l < pyramid.levels(); ++l) {
            Image const &above = pyramid.level(l - 1), &here = pyramid.level(l);
            for (int y = 0; y < here.height(); ++y)
                for (int x = 0; x < here.width(); ++x) {
                    double sum = 0;
                    for (int v = 0; v < above.height(); ++v)
                        for (int u = 0; u < above.width(); ++u)
                            sum += share(above.width(), x, u) * share(above.height(), y, v) *
                                   static_cast<double>(above.get(u, v, 1));
                    CHECK(difference(sum, static_cast<double>(here.get(x, y, 1))) < 1e-6);
                }
        }
    }
}

TEST_CASE("images of bytes share them until one is changed") {
    Image a(PixelFormat::U8, 2, 1, {"Y"}, Encoding::srgb());
    a.u8() = {188, 0};
    Image b = a.with_encoding(Encoding::linear());
    CHECK(a.shares_bytes_with(b));
    CHECK(a.get(0, 0, 0) == doctest::Approx(0.5).epsilon(0.01));
    CHECK(b.get(0, 0, 0) == doctest::Approx(188 / 255.0));
    b.set(1, 0, 0, 1);
    CHECK_FALSE(a.shares_bytes_with(b));
    CHECK(a.get(1, 0, 0) == 0);
    CHECK(b.get(1, 0, 0) == 1);
    Image const moved = std::move(b);
    CHECK(moved.get(1, 0, 0) == 1);
    CHECK_FALSE(Image().shares_bytes_with(Image()));
    CHECK(Image().bytes() == 0);
}

TEST_CASE("floats that are halves become halves, all or none, bit by bit") {
    Image image(PixelFormat::Float, 4, 1, {"Y"});
    image.floats() = {0, -0.0f, 65504, 0x1p-24f};
    image.chromaticities = kRec709;
    CHECK(store_as_halves_if_exact(image));
    CHECK(image.format() == PixelFormat::Half);
    CHECK(image.chromaticities == kRec709);
    CHECK(image.half_bits() == std::vector<std::uint16_t>{0, 0x8000, 0x7bff, 1});
    CHECK_FALSE(store_as_halves_if_exact(image));
    for (float const v : {0.1f, 65505.0f, 0x1p-25f, std::nanf("")}) {
        Image other(PixelFormat::Float, 2, 1, {"Y"});
        other.floats() = {1, v};
        if (std::isnan(v)) {
            store_as_halves_if_exact(other);  // either way it stays a NaN
            CHECK(std::isnan(other.get(1, 0, 0)));
            continue;
        }
        CHECK_FALSE(store_as_halves_if_exact(other));
        CHECK(other.get(1, 0, 0) == v);
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
