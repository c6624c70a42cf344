#include "image/image.h"

#include "math/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace nephroid {

namespace {

std::array<float, 256> make_srgb_table() {
    std::array<float, 256> table{};
    for (int i = 0; i < 256; ++i) {
        double const x = i / 255.0;
        double const y = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
        table[static_cast<std::size_t>(i)] = static_cast<float>(y);
    }
    return table;
}

std::uint8_t to_byte(float x) {
    if (!(x > 0.0f)) return 0;  // NaN too
    return x >= 1.0f ? std::uint8_t{255} : static_cast<std::uint8_t>(x * 255.0f + 0.5f);
}

}  // namespace

float srgb_to_linear(float encoded) {
    float const x = std::abs(encoded);
    float const y = x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
    return std::copysign(y, encoded);
}

float linear_to_srgb(float linear) {
    float const x = std::abs(linear);
    float const y = x <= 0.0031308f ? x * 12.92f : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return std::copysign(y, linear);
}

float srgb_byte_to_linear(std::uint8_t byte) {
    static std::array<float, 256> const table = make_srgb_table();
    return table[byte];
}

std::uint8_t linear_to_srgb_byte(float linear) { return to_byte(linear_to_srgb(linear)); }

float decode(Encoding const& encoding, float stored) {
    switch (encoding.kind) {
        case Encoding::Kind::Linear:
            break;
        case Encoding::Kind::Srgb:
            return srgb_to_linear(stored);
        case Encoding::Kind::Gamma:
            return std::pow(std::max(stored, 0.0f), encoding.gamma);
    }
    return stored;
}

float encode(Encoding const& encoding, float linear) {
    switch (encoding.kind) {
        case Encoding::Kind::Linear:
            break;
        case Encoding::Kind::Srgb:
            return linear_to_srgb(linear);
        case Encoding::Kind::Gamma:
            return std::pow(std::max(linear, 0.0f), 1.0f / encoding.gamma);
    }
    return linear;
}

Image::Image(PixelFormat format, int width, int height, std::vector<std::string> channel_names,
             Encoding encoding)
    : format_(format), width_(width), height_(height), names_(std::move(channel_names)) {
    if (width <= 0 || height <= 0 || names_.empty())
        throw Error(ErrorKind::Input, "image: an image needs at least one pixel and one channel");
    std::int64_t const count = std::int64_t{width} * std::int64_t{height} *
                               static_cast<std::int64_t>(std::min(names_.size(), std::size_t{1} << 20));
    std::int64_t const each = format == PixelFormat::U8 ? 1 : (format == PixelFormat::Half ? 2 : 4);
    if (width > kMaxImageSide || height > kMaxImageSide || count > kMaxImageBytes / each)
        throw Error(ErrorKind::Limit,
                    "image: too large; the limits are 65536 pixels a side and 2 GiB of pixels");
    channels_ = static_cast<int>(names_.size());
    alpha_ = channel("A").value_or(-1);
    auto const n = static_cast<std::size_t>(count);
    switch (format) {
        case PixelFormat::U8:
            set_encoding(encoding);
            u8_ = std::make_shared<std::vector<std::uint8_t>>(n);
            break;
        case PixelFormat::Half:
            half_.resize(n);
            break;
        case PixelFormat::Float:
            float_.resize(n);
            break;
    }
}

std::optional<int> Image::channel(std::string_view name) const {
    auto const found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return std::nullopt;
    return static_cast<int>(found - names_.begin());
}

std::vector<std::uint8_t> const& Image::no_bytes() {
    static std::vector<std::uint8_t> const none;
    return none;
}

void Image::set_encoding(Encoding encoding) {
    encoding_ = encoding;
    decode_.resize(256);
    for (int i = 0; i < 256; ++i) {
        auto const byte = static_cast<std::uint8_t>(i);
        decode_[byte] = encoding.kind == Encoding::Kind::Srgb
                            ? srgb_byte_to_linear(byte)
                            : decode(encoding, static_cast<float>(i) / 255.0f);
    }
}

Image Image::with_encoding(Encoding encoding) const {
    Image other = *this;
    other.set_encoding(encoding);
    return other;
}

std::vector<std::uint8_t>& Image::u8() {
    if (u8_.use_count() != 1) u8_ = std::make_shared<std::vector<std::uint8_t>>(std::as_const(*this).u8());
    return *u8_;
}

std::size_t Image::bytes() const { return u8().size() + 2 * half_.size() + 4 * float_.size(); }

void Image::set(int x, int y, int c, float linear) {
    std::size_t const i = index(x, y, c);
    switch (format_) {
        case PixelFormat::U8:
            u8()[i] = to_byte(c == alpha_ ? linear : encode(encoding_, linear));
            break;
        case PixelFormat::Half:
            half_[i] =
                float_to_half(std::isfinite(linear) ? clamp(linear, -kLargestHalf, kLargestHalf) : linear);
            break;
        case PixelFormat::Float:
            float_[i] = linear;
            break;
    }
}

namespace {

bool is_bad(float v) { return !std::isfinite(v) || v < 0.0f; }

template <class F>
std::size_t for_each_bad_pixel(Image const& image, F&& visit) {
    if (image.format() == PixelFormat::U8) return 0;
    std::size_t bad = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            bool hit = false;
            for (int c = 0; c < image.channels(); ++c)
                if (is_bad(image.get(x, y, c))) {
                    hit = true;
                    visit(x, y, c);
                }
            bad += hit ? 1 : 0;
        }
    return bad;
}

}  // namespace

std::size_t count_bad_pixels(Image const& image) {
    return for_each_bad_pixel(image, [](int, int, int) {});
}

std::size_t sanitize(Image& image) {
    if (image.format() == PixelFormat::U8) return 0;
    std::vector<float> largest(static_cast<std::size_t>(image.channels()), 0.0f);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < image.channels(); ++c) {
                float const v = image.get(x, y, c);
                float& top = largest[static_cast<std::size_t>(c)];
                if (std::isfinite(v) && v > top) top = v;
            }
    return for_each_bad_pixel(image, [&](int x, int y, int c) {
        bool const positive_infinity = image.get(x, y, c) == kInfinity;
        image.set(x, y, c, positive_infinity ? largest[static_cast<std::size_t>(c)] : 0.0f);
    });
}

bool store_as_halves_if_exact(Image& image) {
    if (image.format() != PixelFormat::Float) return false;
    auto const same = [](float v) {
        return std::bit_cast<std::uint32_t>(half_to_float(float_to_half(v))) ==
               std::bit_cast<std::uint32_t>(v);
    };
    if (!std::all_of(image.floats().begin(), image.floats().end(), same)) return false;
    Image halves(PixelFormat::Half, image.width(), image.height(), image.channel_names());
    std::transform(image.floats().begin(), image.floats().end(), halves.half_bits().begin(), float_to_half);
    halves.chromaticities = image.chromaticities;
    image = std::move(halves);
    return true;
}

std::vector<std::string> default_channel_names(int channels) {
    switch (channels) {
        case 1:
            return {"Y"};
        case 2:
            return {"Y", "A"};
        case 3:
            return {"R", "G", "B"};
        case 4:
            return {"R", "G", "B", "A"};
        default:
            break;
    }
    std::vector<std::string> names;
    for (int c = 0; c < channels; ++c) names.push_back(std::string("C").append(std::to_string(c)));
    return names;
}

}  // namespace nephroid
