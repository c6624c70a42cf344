// PNG through libpng. libpng reports errors by longjmp, which must not jump over C++ destructors: every stretch of
// libpng calls runs inside guarded(), in lambdas that own nothing; what owns memory lives outside of them.
#include "codecs.h"

#include <bit>
#include <csetjmp>
#include <cstring>

#include <png.h>

namespace nephroid::codec {

namespace {

struct State {
    Bytes file;
    std::size_t at = 0;
    std::jmp_buf jump;
    char message[160] = {};
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
    auto* const state = static_cast<State*>(png_get_error_ptr(png));
    std::strncpy(state->message, text, sizeof(state->message) - 1);
    std::longjmp(state->jump, 1);
}
void on_warning(png_structp, png_const_charp) {}  // libraries never print

void on_read(png_structp png, png_bytep out, std::size_t n) {
    auto* const state = static_cast<State*>(png_get_io_ptr(png));
    if (n > state->file.size() - state->at) png_error(png, "the file is truncated");
    std::memcpy(out, state->file.data() + state->at, n);
    state->at += n;
}

/// Runs `f`; false if libpng gave up in it. `f` and what it calls must own nothing.
template <class F>
bool guarded(State& state, F&& f) {
    if (setjmp(state.jump) != 0) return false;
    f();
    return true;
}

/// libpng's structures, freed whatever happens.
struct Reader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void read_info(Reader& r, State& state) {
    png_set_read_fn(r.png, &state, on_read);
    png_set_user_limits(r.png, static_cast<png_uint_32>(kMaxImageSide),
                        static_cast<png_uint_32>(kMaxImageSide));
    png_set_chunk_malloc_max(r.png, 16u << 20);
    png_set_benign_errors(r.png, 1);
    png_read_info(r.png, r.info);
}

/// Palettes to RGB, transparency to alpha, 1, 2 and 4 bits to 8; 16 bits in this machine's byte order.
void set_transforms(Reader& r) {
    png_set_expand(r.png);
    if (png_get_bit_depth(r.png, r.info) == 16 && std::endian::native == std::endian::little)
        png_set_swap(r.png);
}

}  // namespace

Image decode_png(Bytes file, std::string const& path, std::optional<Encoding> override_encoding) {
    State state;
    state.file = file;
    Reader r;
    auto give_up = [&] {
        fail(path, std::string("the PNG file is damaged: ") + static_cast<char const*>(state.message));
    };
    // Creation checks versions and may call on_error too.
    if (!guarded(state, [&] {
            r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
            if (r.png != nullptr) r.info = png_create_info_struct(r.png);
        }))
        give_up();
    if (r.info == nullptr) throw std::bad_alloc();
    if (!guarded(state, [&] { read_info(r, state); })) give_up();

    bool const deep = png_get_bit_depth(r.png, r.info) == 16;
    png_uint_32 const width = png_get_image_width(r.png, r.info),
                      height = png_get_image_height(r.png, r.info);
    check_size(path, width, height, 4, deep ? 4 : 1);
    // Deflate shrinks at most 1032 to 1: refuse a huge image of nothing before making room for it.
    std::size_t const least = png_get_rowbytes(r.png, r.info) * height / 1032;
    if (least > file.size() + 4096) fail(path, "the file is truncated; get a complete copy");

    int passes = 1;
    if (!guarded(state, [&] {
            set_transforms(r);
            passes = png_set_interlace_handling(r.png);
            png_read_update_info(r.png, r.info);
        }))
        give_up();
    int const channels = png_get_channels(r.png, r.info);
    Encoding const encoding = override_encoding.value_or(Encoding::srgb());
    Image image(deep ? PixelFormat::Float : PixelFormat::U8, static_cast<int>(width),
                static_cast<int>(height), default_channel_names(channels), encoding);
    std::vector<std::uint16_t> words;
    if (deep) words.resize(image.floats().size());
    auto* const pixels = deep ? reinterpret_cast<png_bytep>(words.data()) : image.u8().data();
    std::size_t const row_bytes = png_get_rowbytes(r.png, r.info);
    if (!guarded(state, [&] {
            for (int pass = 0; pass < passes; ++pass)
                for (png_uint_32 y = 0; y < height; ++y) png_read_row(r.png, pixels + y * row_bytes, nullptr);
            png_read_end(r.png, nullptr);
        }))
        give_up();

    int const alpha = image.channel("A").value_or(-1);
    for (std::size_t i = 0; i < words.size(); ++i) {
        float const v = static_cast<float>(words[i]) / 65535.0f;
        bool const is_alpha = static_cast<int>(i % static_cast<std::size_t>(channels)) == alpha;
        image.floats()[i] = is_alpha ? v : decode(encoding, v);
    }
    return image;
}

}  // namespace nephroid::codec
