#include "image/peek.h"

#include "image/exr.h"
#include "math/error.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

namespace {

using Size = std::optional<std::array<std::int64_t, 2>>;

std::int64_t big_endian(std::string_view bytes) {
    std::int64_t v = 0;
    for (char const c : bytes) v = (v << 8) | static_cast<unsigned char>(c);
    return v;
}
std::int64_t little_endian_16(std::string_view bytes) {
    return static_cast<unsigned char>(bytes[0]) | (static_cast<unsigned char>(bytes[1]) << 8);
}

/// The first frame header (SOF0 to SOF15 without DHT, JPG and DAC) tells; the segments before it are skipped.
Size jpeg_size(std::istream& in) {
    in.seekg(2);
    for (int segment = 0; segment < 10000; ++segment) {
        char head[9] = {};
        if (!in.read(&head[0], 4) || head[0] != '\xff') return std::nullopt;
        auto const marker = static_cast<unsigned char>(head[1]);
        std::int64_t const length = big_endian({&head[2], 2});
        if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) {
            if (!in.read(&head[4], 5)) return std::nullopt;
            return {{big_endian({&head[7], 2}), big_endian({&head[5], 2})}};
        }
        if (length < 2 || !in.seekg(length - 2, std::ios::cur)) return std::nullopt;
    }
    return std::nullopt;
}

/// The line of a Radiance picture that tells its size ends the header: "-Y height +X width", in some order and with some signs.
Size hdr_size(std::istream& in) {
    in.seekg(0);
    std::string line;
    for (int i = 0; i < 1000 && std::getline(in, line) && line.size() < 4096; ++i) {
        std::istringstream words(line);
        std::string first;
        std::string second;
        std::int64_t a = 0;
        std::int64_t b = 0;
        if (!(words >> first >> a >> second >> b) || first.size() != 2 || second.size() != 2) continue;
        if (first[1] == 'Y' && second[1] == 'X') return {{b, a}};
        if (first[1] == 'X' && second[1] == 'Y') return {{a, b}};
    }
    return std::nullopt;
}
/// Of 16 bits each in OS/2's header, of 32 and signed (rows from above) in the others.
Size bmp_size(std::istream& in) {
    char head[26] = {};
    in.seekg(0);
    if (!in.read(&head[0], 26)) return std::nullopt;
    auto const word = [&](std::size_t at) { return little_endian_16({&head[at], 2}); };
    if (word(14) == 12) return {{word(18), word(20)}};
    auto const number = [&](std::size_t at) {
        return std::int64_t{static_cast<std::int32_t>(word(at) | (word(at + 2) << 16))};
    };
    return {{number(18), std::abs(number(22))}};
}
Size pfm_size(std::istream& in) {
    in.seekg(2);
    std::int64_t width = 0;
    std::int64_t height = 0;
    return in >> width >> height ? Size{{width, height}} : std::nullopt;
}

}  // namespace

std::optional<std::array<std::int64_t, 2>> peek_size(std::filesystem::path const& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
    std::ifstream in(path, std::ios::binary);
    std::string head(24, '\0');
    in.read(head.data(), 24);
    if (in.gcount() < 12) return std::nullopt;
    in.clear();
    std::string_view const bytes = head;
    if (bytes.starts_with("#?")) return hdr_size(in);
    if (bytes.starts_with("PF") || bytes.starts_with("Pf")) return pfm_size(in);
    if (bytes.starts_with("BM")) return bmp_size(in);
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"))
        return {{big_endian(bytes.substr(16, 4)), big_endian(bytes.substr(20, 4))}};
    if (bytes.starts_with("\xff\xd8\xff")) return jpeg_size(in);
    if (bytes.starts_with("\x76\x2f\x31\x01")) try {
            ExrFile const file = read_exr_header(path);
            return {{file.width, file.height}};
        } catch (Error const&) {
            return std::nullopt;
        }
    if (path.extension() == ".tga" || path.extension() == ".TGA")
        return {{little_endian_16(bytes.substr(12, 2)), little_endian_16(bytes.substr(14, 2))}};
    return std::nullopt;
}

}  // namespace nephroid
