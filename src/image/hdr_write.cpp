// Radiance RGBE with the newer run-length code.
#include "codecs.h"
#include "image/file.h"
#include "image/write.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace nephroid {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

Rgbe to_rgbe(Vec3 color) {
    auto positive = [](float v) { return v > 0.0f ? std::min(v, 1.69e38f) : 0.0f; };  // NaN becomes 0
    Vec3 const c{positive(color.x), positive(color.y), positive(color.z)};
    float const top = max_component(c);
    if (top < 1e-38f) return {0, 0, 0, 0};
    int exponent = 0;
    (void)std::frexp(top, &exponent);  // top = m 2^e with m in [1/2, 1)
    auto mantissa = [&](float v, int e) { return static_cast<int>(std::ldexp(v, 8 - e) + 0.5f); };
    if (mantissa(top, exponent) > 255) ++exponent;  // rounding to nearest must not wrap
    auto byte = [&](float v) { return static_cast<std::uint8_t>(mantissa(v, exponent)); };
    return {byte(c.x), byte(c.y), byte(c.z), static_cast<std::uint8_t>(exponent + 128)};
}

void append_plane(std::vector<std::byte>& out, std::vector<Rgbe> const& line, std::size_t plane) {
    auto at = [&](std::size_t i) { return line[i][plane]; };
    auto run_length = [&](std::size_t i) {
        std::size_t n = 1;
        while (n < 127 && i + n < line.size() && at(i + n) == at(i)) ++n;
        return n;
    };
    for (std::size_t x = 0; x < line.size();) {
        std::size_t const run = run_length(x);
        if (run >= 4) {
            out.push_back(static_cast<std::byte>(128 + run));
            out.push_back(static_cast<std::byte>(at(x)));
            x += run;
            continue;
        }
        std::size_t end = x + 1;  // literals until a run worth its two bytes begins
        while (end < line.size() && end - x < 128 && run_length(end) < 4) ++end;
        out.push_back(static_cast<std::byte>(end - x));
        for (; x < end; ++x) out.push_back(static_cast<std::byte>(at(x)));
    }
}

}  // namespace

void write_hdr(std::filesystem::path const& path, Image const& image) {
    if (image.empty()) codec::fail(path.string(), "cannot write an empty image");
    bool const color = image.channels() >= 3;
    std::string const header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height()) +
                               " +X " + std::to_string(image.width()) + "\n";
    std::vector<std::byte> out(header.size());
    std::memcpy(out.data(), header.data(), header.size());
    std::vector<Rgbe> line(static_cast<std::size_t>(image.width()));
    bool const encode_runs = line.size() >= 8 && line.size() < 32768;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x)
            line[static_cast<std::size_t>(x)] =
                to_rgbe({image.get(x, y, 0), image.get(x, y, color ? 1 : 0), image.get(x, y, color ? 2 : 0)});
        if (encode_runs) {
            for (std::size_t const v : {std::size_t{2}, std::size_t{2}, line.size() >> 8, line.size() & 255})
                out.push_back(static_cast<std::byte>(v));
            for (std::size_t plane = 0; plane < 4; ++plane) append_plane(out, line, plane);
        } else {
            // Flat. No pixel reads as a repeat (1,1,1,n): the largest mantissa is at least 128.
            for (Rgbe const& p : line)
                for (std::uint8_t const v : p) out.push_back(static_cast<std::byte>(v));
        }
    }
    write_file_atomically(path, out);
}

}  // namespace nephroid
