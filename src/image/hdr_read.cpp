// Radiance's RGBE pictures ("Real Pixels", Ward 1991): a text header, a resolution line that also gives the orientation,
// then scanlines of four bytes a pixel (three mantissas, one exponent), flat or run-length encoded in the old or new way.
#include "codecs.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

namespace nephroid::codec {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

struct Header {
    bool xyz = false;
    double exposure = 1.0;                 // pixels were multiplied by it: divide
    std::array<double, 3> color{1, 1, 1};  // COLORCORR, likewise
    std::optional<Chromaticities> primaries;
};

struct Layout {  // scanlines run along the second axis of the resolution line
    bool y_first = true, first_positive = false, second_positive = true;
    std::int64_t rows = 0, columns = 0;  // in file order: rows scanlines of columns pixels
};

Header read_header(Cursor& in, std::string const& path) {
    Header header;
    in.line();  // "#?RADIANCE", "#?RGBE" or another program's name: the FORMAT line is what counts
    for (int count = 0;; ++count) {
        if (count > 10000) fail(path, "the HDR header has no end");
        std::string const line = in.line();
        if (line.empty() || line == "\r") return header;
        auto const equals = line.find('=');
        if (equals == std::string::npos) continue;
        std::string const key = line.substr(0, equals);
        std::istringstream value(line.substr(equals + 1));
        value.imbue(std::locale::classic());
        if (key == "FORMAT") {
            std::string name;
            value >> name;
            if (name != "32-bit_rle_rgbe" && name != "32-bit_rle_xyze")
                fail(path, "the HDR format '" + name + "' is not known; RGBE and XYZE are read");
            header.xyz = name == "32-bit_rle_xyze";
        } else if (key == "EXPOSURE") {
            double factor = 0;
            if (!(value >> factor) || !(factor > 0) || !std::isfinite(factor))
                fail(path, "the HDR header's EXPOSURE must be a number above 0");
            header.exposure *= factor;
        } else if (key == "COLORCORR") {
            for (double& c : header.color) {
                double factor = 0;
                if (!(value >> factor) || !(factor > 0) || !std::isfinite(factor))
                    fail(path, "the HDR header's COLORCORR must be three numbers above 0");
                c *= factor;
            }
        } else if (key == "PRIMARIES") {
            std::array<float, 8> xy{};
            bool good = true;
            for (float& v : xy) good = good && (value >> v) && std::isfinite(v);
            if (good)
                header.primaries =
                    Chromaticities{{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
        }
    }
}

/// "-Y 480 +X 640" and the seven other orientations.
Layout read_resolution(Cursor& in, std::string const& path) {
    std::string const line = in.line(256);
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string axis[2];
    std::string count[2];
    words >> axis[0] >> count[0] >> axis[1] >> count[1];
    auto legal_axis = [](std::string const& a) {
        return a.size() == 2 && (a[0] == '+' || a[0] == '-') && (a[1] == 'X' || a[1] == 'Y');
    };
    if (!legal_axis(axis[0]) || !legal_axis(axis[1]) || axis[0][1] == axis[1][1])
        fail(path, "the HDR resolution line is damaged; it should read like '-Y 480 +X 640'");
    std::int64_t size[2] = {0, 0};
    for (int i = 0; i < 2; ++i) {
        auto const [end, error] =
            std::from_chars(count[i].data(), count[i].data() + count[i].size(), size[i]);
        if (error != std::errc{} || end != count[i].data() + count[i].size())
            fail(path, "the HDR resolution line is damaged: '" + count[i] + "' is no number of pixels");
    }
    return {axis[0][1] == 'Y', axis[0][0] == '+', axis[1][0] == '+', size[0], size[1]};
}

/// Four separate planes, each of runs (count above 128) and literals; the run must end with the scanline.
void read_new_rle(Cursor& in, std::vector<Rgbe>& line, std::string const& path) {
    for (std::size_t plane = 0; plane < 4; ++plane)
        for (std::size_t x = 0; x < line.size();) {
            std::size_t count = in.byte();
            bool const run = count > 128;
            if (run) count -= 128;
            if (count == 0 || count > line.size() - x) fail(path, "the HDR run-length code is damaged");
            if (run) {
                std::uint8_t const value = in.byte();
                for (std::size_t i = 0; i < count; ++i) line[x++][plane] = value;
            } else {
                Bytes const values = in.take(count);
                for (std::size_t i = 0; i < count; ++i)
                    line[x++][plane] = static_cast<std::uint8_t>(values[i]);
            }
        }
}

/// Flat pixels; (1,1,1,n) repeats the previous pixel n times, and repeats that follow each other are digits to base 256.
void read_flat_or_old_rle(Cursor& in, std::vector<Rgbe>& line, std::string const& path) {
    int shift = 0;
    for (std::size_t x = 0; x < line.size();) {
        Rgbe pixel{};
        std::memcpy(pixel.data(), in.take(4).data(), 4);
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[x++] = pixel;
            shift = 0;
            continue;
        }
        std::size_t const count = shift < 24 ? static_cast<std::size_t>(pixel[3]) << shift : line.size();
        if (x == 0 || count > line.size() - x) fail(path, "the HDR run-length code is damaged");
        for (std::size_t i = 0; i < count; ++i, ++x) line[x] = line[x - 1];
        shift += 8;
    }
}

void read_scanline(Cursor& in, std::vector<Rgbe>& line, std::string const& path) {
    std::size_t const start = in.at();
    if (line.size() >= 8 && line.size() < 32768) {
        Cursor ahead = in;
        Bytes const mark = ahead.take(4);
        bool const is_new =
            mark[0] == std::byte{2} && mark[1] == std::byte{2} && (mark[2] & std::byte{0x80}) == std::byte{0};
        if (is_new) {
            auto const width = (static_cast<std::size_t>(mark[2]) << 8) | static_cast<std::size_t>(mark[3]);
            if (width != line.size())
                fail(path, "the HDR scanline at byte " + std::to_string(start) +
                               " has another width than the image");
            in = ahead;
            read_new_rle(in, line, path);
            return;
        }
    }
    read_flat_or_old_rle(in, line, path);
}

}  // namespace

Image decode_hdr(Bytes file, std::string const& path) {
    Cursor in(file, path);
    Header const header = read_header(in, path);
    Layout const layout = read_resolution(in, path);
    check_size(path, layout.rows, layout.columns, 3, 4);
    // A scanline takes at least four bytes: refuse a huge image of nothing before making room for it.
    if (in.left() / 4 < static_cast<std::size_t>(layout.rows))
        fail(path, "the file is truncated; get a complete copy");

    auto const width = static_cast<int>(layout.y_first ? layout.columns : layout.rows);
    auto const height = static_cast<int>(layout.y_first ? layout.rows : layout.columns);
    Image image(PixelFormat::Float, width, height, {"R", "G", "B"});
    image.chromaticities = header.primaries;
    std::vector<Rgbe> line(static_cast<std::size_t>(layout.columns));
    for (int row = 0; row < static_cast<int>(layout.rows); ++row) {
        read_scanline(in, line, path);
        for (int column = 0; column < static_cast<int>(layout.columns); ++column) {
            auto const& [r, g, b, exponent] = line[static_cast<std::size_t>(column)];
            // The reference decoder adds 1/2 to the mantissas; writers of today do not expect it, and 1 should be 1.
            double const scale =
                exponent == 0 ? 0.0 : std::ldexp(1.0, exponent - (128 + 8)) / header.exposure;
            double v[3] = {r * scale / header.color[0], g * scale / header.color[1],
                           b * scale / header.color[2]};
            if (header.xyz) {  // to linear Rec. 709 with white D65 (IEC 61966-2-1)
                double const x = v[0], y = v[1], z = v[2];
                v[0] = 3.2404542 * x - 1.5371385 * y - 0.4985314 * z;
                v[1] = -0.9692660 * x + 1.8760108 * y + 0.0415560 * z;
                v[2] = 0.0556434 * x - 0.2040259 * y + 1.0572252 * z;
            }
            // Y counts upwards in the file's words, X to the right.
            int const px = layout.y_first ? (layout.second_positive ? column : width - 1 - column)
                                          : (layout.first_positive ? row : width - 1 - row);
            int const py = layout.y_first ? (layout.first_positive ? height - 1 - row : row)
                                          : (layout.second_positive ? height - 1 - column : column);
            for (int c = 0; c < 3; ++c) image.set(px, py, c, static_cast<float>(v[c]));
        }
    }
    return image;
}

}  // namespace nephroid::codec
