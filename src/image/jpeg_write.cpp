// JPEG through libjpeg(-turbo), into memory; see jpeg_read.cpp about longjmp.
#include "codecs.h"
#include "image/file.h"
#include "image/write.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

namespace nephroid {

namespace {

struct State {
    jpeg_error_mgr errors;  // first, as in jpeg_read.cpp
    std::jmp_buf jump;
    char message[JMSG_LENGTH_MAX] = {};
};

[[noreturn]] void on_error(j_common_ptr info) {
    State& state = *reinterpret_cast<State*>(info->err);
    (*info->err->format_message)(info, static_cast<char*>(state.message));
    std::longjmp(state.jump, 1);
}

struct Writer {
    jpeg_compress_struct info{};
    unsigned char* out = nullptr;
    unsigned long size = 0;
    bool created = false;
    ~Writer() {
        if (created) jpeg_destroy_compress(&info);
        std::free(out);  // libjpeg's memory destination calls malloc
    }
};

/// Owns nothing: may be left by longjmp.
bool encode(Writer& w, State& state, std::uint8_t* samples, int width, int height, int channels,
            int quality) {
    if (setjmp(state.jump) != 0) return false;
    w.created = true;
    jpeg_create_compress(&w.info);
    jpeg_mem_dest(&w.info, &w.out, &w.size);
    w.info.image_width = static_cast<JDIMENSION>(width);
    w.info.image_height = static_cast<JDIMENSION>(height);
    w.info.input_components = channels;
    w.info.in_color_space = channels == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&w.info);
    jpeg_set_quality(&w.info, quality, TRUE);
    for (int c = 0; c < channels; ++c)
        w.info.comp_info[c].h_samp_factor = w.info.comp_info[c].v_samp_factor = 1;
    w.info.optimize_coding = TRUE;
    jpeg_start_compress(&w.info, TRUE);
    while (w.info.next_scanline < w.info.image_height) {
        JSAMPROW row = samples + static_cast<std::size_t>(w.info.next_scanline) *
                                     static_cast<std::size_t>(width * channels);
        jpeg_write_scanlines(&w.info, &row, 1);
    }
    jpeg_finish_compress(&w.info);
    return true;
}

}  // namespace

void write_jpeg(std::filesystem::path const& path, Image const& image, int quality) {
    if (image.empty()) codec::fail(path.string(), "cannot write an empty image");
    if (image.width() > 65500 || image.height() > 65500)
        codec::fail(path.string(), "a JPEG has at most 65500 pixels a side; write an EXR", ErrorKind::Limit);
    int const channels = image.channels() >= 3 ? 3 : 1;
    std::vector<std::uint8_t> samples;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < channels; ++c) samples.push_back(linear_to_srgb_byte(image.get(x, y, c)));
    State state{};
    Writer w;
    w.info.err = jpeg_std_error(&state.errors);
    state.errors.error_exit = on_error;
    state.errors.output_message = [](j_common_ptr) {};
    if (!encode(w, state, samples.data(), image.width(), image.height(), channels,
                std::clamp(quality, 1, 100)))
        codec::fail(path.string(),
                    std::string("cannot encode a JPEG: ") + static_cast<char const*>(state.message),
                    ErrorKind::Io);
    write_file_atomically(path, std::as_bytes(std::span(w.out, w.size)));
}

}  // namespace nephroid
