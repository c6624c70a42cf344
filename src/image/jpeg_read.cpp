// JPEG through libjpeg(-turbo). Errors come by longjmp, which must not jump over C++ destructors: libjpeg is called
// inside guarded() only, in lambdas that own nothing.
#include "codecs.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>

#include <jpeglib.h>

#include <jerror.h>

namespace nephroid::codec {

namespace {

/// A progressive file may ask for the whole picture to be refined thousands of times; honest ones have about ten scans.
constexpr int kMaxScans = 200;

struct State {
    jpeg_error_mgr errors;  // first: libjpeg's pointer to it is a pointer to State
    jpeg_progress_mgr progress;
    std::jmp_buf jump;
    char message[JMSG_LENGTH_MAX] = {};
};

State& state_of(j_common_ptr info) { return *reinterpret_cast<State*>(info->err); }

[[noreturn]] void on_error(j_common_ptr info) {
    State& state = state_of(info);
    (*info->err->format_message)(info, static_cast<char*>(state.message));
    std::longjmp(state.jump, 1);
}

/// Warnings (level -1) are silent, but libjpeg only warns of missing data and paints the rest gray: that is an error.
void on_message(j_common_ptr info, int level) {
    if (level >= 0) return;
    int const code = info->err->msg_code;
    if (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER) on_error(info);
}

void on_progress(j_common_ptr info) {
    if (!info->is_decompressor) return;
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kMaxScans) return;
    std::strcpy(static_cast<char*>(state_of(info).message), "more than 200 scans");
    std::longjmp(state_of(info).jump, 1);
}

struct Reader {
    jpeg_decompress_struct info{};
    bool created = false;
    ~Reader() {
        if (created) jpeg_destroy_decompress(&info);
    }
};

template <class F>
bool guarded(State& state, F&& f) {
    if (setjmp(state.jump) != 0) return false;
    f();
    return true;
}

/// Printers' CMYK to RGB, without a profile. Adobe's files store the inks inverted.
void cmyk_to_rgb(std::uint8_t const* cmyk, bool inverted, std::uint8_t* rgb) {
    unsigned const black = inverted ? cmyk[3] : 255u - cmyk[3];
    for (int c = 0; c < 3; ++c) {
        unsigned const paper = inverted ? cmyk[c] : 255u - cmyk[c];
        rgb[c] = static_cast<std::uint8_t>((paper * black + 127u) / 255u);
    }
}

}  // namespace

Image decode_jpeg(Bytes file, std::string const& path, std::optional<Encoding> override_encoding) {
    State state{};
    Reader r;
    auto give_up = [&] {
        fail(path, std::string("the JPEG file is damaged: ") + static_cast<char const*>(state.message));
    };
    r.info.err = jpeg_std_error(&state.errors);
    state.errors.error_exit = on_error;
    state.errors.emit_message = on_message;
    state.errors.output_message = [](j_common_ptr) {};
    state.progress.progress_monitor = on_progress;
    if (!guarded(state, [&] {
            r.created = true;
            jpeg_create_decompress(&r.info);
            r.info.progress = &state.progress;
            jpeg_mem_src(&r.info, reinterpret_cast<unsigned char const*>(file.data()),
                         static_cast<unsigned long>(file.size()));
            jpeg_read_header(&r.info, TRUE);
        }))
        give_up();

    bool const cmyk = r.info.jpeg_color_space == JCS_CMYK || r.info.jpeg_color_space == JCS_YCCK;
    bool const gray = r.info.jpeg_color_space == JCS_GRAYSCALE;
    if (!cmyk && !gray && r.info.jpeg_color_space != JCS_YCbCr && r.info.jpeg_color_space != JCS_RGB)
        fail(path, "the JPEG's colour space is not known; save it as RGB or gray");
    check_size(path, r.info.image_width, r.info.image_height, 4, 1);
    // A Huffman-coded block of 64 samples takes a bit at least: refuse a huge image of nothing before making room for it.
    std::int64_t const pixels = std::int64_t{r.info.image_width} * std::int64_t{r.info.image_height};
    if (!r.info.arith_code && pixels / 512 > static_cast<std::int64_t>(file.size()) + 4096)
        fail(path, "the file is truncated; get a complete copy");

    int const channels = gray ? 1 : 3;
    Image image(PixelFormat::U8, static_cast<int>(r.info.image_width), static_cast<int>(r.info.image_height),
                default_channel_names(channels), override_encoding.value_or(Encoding::srgb()));
    std::vector<std::uint8_t> inks(cmyk ? static_cast<std::size_t>(r.info.image_width) * 4 : 0);
    if (!guarded(state, [&] {
            r.info.out_color_space = cmyk ? JCS_CMYK : (gray ? JCS_GRAYSCALE : JCS_RGB);
            jpeg_start_decompress(&r.info);
            while (r.info.output_scanline < r.info.output_height) {
                auto const y = static_cast<int>(r.info.output_scanline);
                JSAMPROW row = cmyk ? inks.data() : image.u8().data() + image.index(0, y, 0);
                if (jpeg_read_scanlines(&r.info, &row, 1) != 1) break;
                if (!cmyk) continue;
                for (int x = 0; x < image.width(); ++x)
                    cmyk_to_rgb(inks.data() + 4 * static_cast<std::size_t>(x), r.info.saw_Adobe_marker != 0,
                                image.u8().data() + image.index(x, y, 0));
            }
            jpeg_finish_decompress(&r.info);
        }))
        give_up();
    return image;
}

}  // namespace nephroid::codec
