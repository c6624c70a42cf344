// PNG through libpng, into memory; see png_read.cpp about longjmp.
#include "codecs.h"
#include "image/file.h"
#include "image/write.h"

#include <cmath>
#include <csetjmp>
#include <cstring>
#include <new>

#include <png.h>

namespace nephroid {

namespace {

struct State {
    std::vector<std::byte> out;
    bool out_of_memory = false;
    std::jmp_buf jump;
    char message[160] = {};
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
    auto* const state = static_cast<State*>(png_get_error_ptr(png));
    std::strncpy(state->message, text, sizeof(state->message) - 1);
    std::longjmp(state->jump, 1);
}
void on_warning(png_structp, png_const_charp) {}
void on_flush(png_structp) {}

void on_write(png_structp png, png_bytep data, std::size_t n) {
    auto* const state = static_cast<State*>(png_get_io_ptr(png));
    try {
        auto const* const bytes = reinterpret_cast<std::byte const*>(data);
        state->out.insert(state->out.end(), bytes, bytes + n);
        return;
    } catch (std::bad_alloc const&) {
        state->out_of_memory = true;
    }
    png_error(png, "out of memory");  // only here, where nothing is left to destroy
}

/// Encoded samples in the file's order: 16 bits are big-endian.
std::vector<std::uint8_t> encode_samples(Image const& image, int bits) {
    std::vector<std::uint8_t> samples;
    samples.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()) *
                    static_cast<std::size_t>(image.channels() * bits / 8));
    float const top = bits == 8 ? 255.0f : 65535.0f;
    bool const has_alpha = image.channels() == 2 || image.channels() == 4;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < image.channels(); ++c) {
                float v = image.get(x, y, c);
                if (!(has_alpha && c == image.channels() - 1)) v = linear_to_srgb(v);
                v = v > 0.0f ? std::fmin(v, 1.0f) : 0.0f;  // NaN too
                auto const n = static_cast<unsigned>(v * top + 0.5f);
                if (bits == 16) samples.push_back(static_cast<std::uint8_t>(n >> 8));
                samples.push_back(static_cast<std::uint8_t>(n & 255u));
            }
    return samples;
}

struct Writer {
    png_structp png = nullptr;
    png_infop info = nullptr;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

/// Owns nothing: may be left by longjmp.
bool encode(Writer& w, State& state, Image const& image, int bits, std::uint8_t const* samples) {
    if (setjmp(state.jump) != 0) return false;
    w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
    if (w.png != nullptr) w.info = png_create_info_struct(w.png);
    if (w.info == nullptr) return false;
    png_set_write_fn(w.png, &state, on_write, on_flush);
    png_set_user_limits(w.png, static_cast<png_uint_32>(kMaxImageSide),
                        static_cast<png_uint_32>(kMaxImageSide));
    static constexpr int kTypes[] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                     PNG_COLOR_TYPE_RGB_ALPHA};
    png_set_IHDR(w.png, w.info, static_cast<png_uint_32>(image.width()),
                 static_cast<png_uint_32>(image.height()), bits, kTypes[image.channels()], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(w.png, w.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(w.png, w.info);
    std::size_t const row_bytes = static_cast<std::size_t>(image.width()) *
                                  static_cast<std::size_t>(image.channels()) *
                                  static_cast<std::size_t>(bits / 8);
    for (int y = 0; y < image.height(); ++y)
        png_write_row(w.png, samples + static_cast<std::size_t>(y) * row_bytes);
    png_write_end(w.png, nullptr);
    return true;
}

}  // namespace

void write_png(std::filesystem::path const& path, Image const& image, int bits) {
    if (image.empty()) codec::fail(path.string(), "cannot write an empty image");
    if (bits != 8 && bits != 16) codec::fail(path.string(), "a PNG has 8 or 16 bits a channel");
    if (image.channels() > 4)
        codec::fail(path.string(), "a PNG has one to four channels, not " + std::to_string(image.channels()) +
                                       "; write an EXR");
    std::vector<std::uint8_t> const samples = encode_samples(image, bits);
    State state;
    Writer writer;
    if (!encode(writer, state, image, bits, samples.data()))
        codec::fail(path.string(),
                    std::string("cannot encode a PNG: ") + static_cast<char const*>(state.message),
                    state.out_of_memory ? ErrorKind::Limit : ErrorKind::Io);
    write_file_atomically(path, state.out);
}

}  // namespace nephroid
