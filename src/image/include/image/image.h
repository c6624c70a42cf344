// Pixels. Channels are interleaved, row 0 is the top row. Numbers are stored as bytes, halves or floats; `get` and `set`
// always speak linear light, so that no caller ever handles an encoded value. An alpha channel ("A") is a coverage, not
// light, and is linear whatever the encoding says. Copies of an image of bytes share them until one is changed.
#pragma once

#include "image/half.h"
#include "math/vec.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

enum class PixelFormat { U8, Half, Float };

/// How stored bytes become linear light: as they are, by the sRGB curve, or as pow(x, gamma).
/// Halves and floats are always linear: what reads a file decodes them.
struct Encoding {
    enum class Kind { Linear, Srgb, Gamma } kind = Kind::Linear;
    float gamma = 1.0f;

    static constexpr Encoding linear() { return {Kind::Linear, 1.0f}; }
    static constexpr Encoding srgb() { return {Kind::Srgb, 1.0f}; }
    static constexpr Encoding power(float g) { return {Kind::Gamma, g}; }
    bool operator==(Encoding const&) const = default;
};

/// CIE 1931 xy of the primaries and of white.
struct Chromaticities {
    Vec2 r, g, b, w;
    bool operator==(Chromaticities const&) const = default;
};
inline constexpr Chromaticities kRec709{{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}};

/// Bounds that protect the machine; readers check them before they allocate.
inline constexpr int kMaxImageSide = 65536;
inline constexpr std::int64_t kMaxImageBytes = std::int64_t{1} << 31;

/// The sRGB curve of IEC 61966-2-1. Negative numbers are mirrored, numbers above one continue the power.
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);
/// The same for a byte, by table.
float srgb_byte_to_linear(std::uint8_t byte);
/// Clamps to [0, 1] and rounds to nearest; NaN becomes 0.
std::uint8_t linear_to_srgb_byte(float linear);

/// A stored number in [0, 1] to linear light, and back.
float decode(Encoding const& encoding, float stored);
float encode(Encoding const& encoding, float linear);

class Image {
  public:
    Image() = default;
    /// All pixels 0. Throws Error(Limit) beyond kMaxImageSide or kMaxImageBytes, Error(Input) for an empty size.
    Image(PixelFormat format, int width, int height, std::vector<std::string> channel_names,
          Encoding encoding = Encoding::linear());

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] int channels() const { return channels_; }
    [[nodiscard]] bool empty() const { return width_ == 0; }
    [[nodiscard]] std::vector<std::string> const& channel_names() const { return names_; }
    [[nodiscard]] std::optional<int> channel(std::string_view name) const;
    [[nodiscard]] PixelFormat format() const { return format_; }
    [[nodiscard]] Encoding encoding() const { return encoding_; }
    /// Memory of the pixels.
    [[nodiscard]] std::size_t bytes() const;

    /// Linear light. The coordinates must lie inside.
    [[nodiscard]] float get(int x, int y, int c) const {
        std::size_t const i = index(x, y, c);
        switch (format_) {
            case PixelFormat::U8:
                return c == alpha_ ? static_cast<float>((*u8_)[i]) / 255.0f : decode_[(*u8_)[i]];
            case PixelFormat::Half:
                return half_to_float(half_[i]);
            case PixelFormat::Float:
                break;
        }
        return float_[i];
    }
    /// Encodes. Bytes are clamped and rounded to nearest; a finite number too large for a half becomes the largest.
    void set(int x, int y, int c, float linear);

    [[nodiscard]] std::size_t index(int x, int y, int c) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels_) +
               static_cast<std::size_t>(c);
    }
    /// The stored numbers of the format in use, for codecs; the other two are empty.
    /// Not const: what others share is copied first.
    [[nodiscard]] std::vector<std::uint8_t>& u8();
    [[nodiscard]] std::vector<std::uint8_t> const& u8() const { return u8_ ? *u8_ : no_bytes(); }
    [[nodiscard]] std::vector<std::uint16_t>& half_bits() { return half_; }
    [[nodiscard]] std::vector<std::uint16_t> const& half_bits() const { return half_; }
    [[nodiscard]] std::vector<float>& floats() { return float_; }
    [[nodiscard]] std::vector<float> const& floats() const { return float_; }

    /// Of the file's header, if it said so; Rec. 709 is meant otherwise.
    std::optional<Chromaticities> chromaticities;

    /// The same bytes read by another curve. They are shared until one of the two is changed. For U8.
    [[nodiscard]] Image with_encoding(Encoding encoding) const;
    /// Do the two share their bytes? Such a pair costs bytes() once.
    [[nodiscard]] bool shares_bytes_with(Image const& other) const { return u8_ && u8_ == other.u8_; }

  private:
    static std::vector<std::uint8_t> const& no_bytes();
    void set_encoding(Encoding encoding);

    PixelFormat format_ = PixelFormat::Float;
    int width_ = 0, height_ = 0, channels_ = 0;
    int alpha_ = -1;  // index of channel "A"
    std::vector<std::string> names_;
    Encoding encoding_;
    std::vector<float> decode_;                      // 256 entries when bytes are stored
    std::shared_ptr<std::vector<std::uint8_t>> u8_;  // null when no bytes are stored
    std::vector<std::uint16_t> half_;
    std::vector<float> float_;
};

/// How many pixels hold a NaN, an infinity or a negative number.
std::size_t count_bad_pixels(Image const& image);
/// Replaces NaN and negative numbers by 0 and +infinity by the largest finite number of that channel in the image (an
/// environment map must keep a finite sum). Returns how many pixels were bad.
std::size_t sanitize(Image& image);

/// Floats that are all halves are stored as halves: half the memory, and not a bit is lost. Returns whether it did; images of
/// another format are left alone. True of most pictures in Radiance's format, whose numbers have eight binary digits.
bool store_as_halves_if_exact(Image& image);

/// Names by number of channels as files without names mean them: Y, YA, RGB, RGBA.
std::vector<std::string> default_channel_names(int channels);

}  // namespace nephroid
