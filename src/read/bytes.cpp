#include "bytes.h"

#include <zlib.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace nephroid {

namespace {

struct Inflater {
    z_stream stream{};
    bool open = false;

    Inflater() { open = inflateInit2(&stream, 15 + 16) == Z_OK; }  // 16: expect gzip's header and trailer
    ~Inflater() {
        if (open) inflateEnd(&stream);
    }
    Inflater(Inflater const&) = delete;
    Inflater& operator=(Inflater const&) = delete;
};

FileBytes too_long() {
    return {{}, "is longer than " + std::to_string(kMaxFileBytes >> 20) + " MiB: split it", true};
}

}  // namespace

FileBytes inflate_if_gzip(std::string bytes, std::size_t limit) {
    if (bytes.size() < 2 || bytes[0] != '\x1f' || bytes[1] != '\x8b') return {std::move(bytes), {}};
    Inflater z;
    if (!z.open) return {{}, "cannot start zlib"};
    std::string out;
    std::array<char, 1 << 16> block;
    // zlib counts in 32 bits: feed the input in pieces.
    std::size_t fed = 0;
    while (true) {
        if (z.stream.avail_in == 0 && fed < bytes.size()) {
            std::size_t const piece = std::min(bytes.size() - fed, std::size_t{1} << 30);
            z.stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + fed);
            z.stream.avail_in = static_cast<uInt>(piece);
            fed += piece;
        }
        z.stream.next_out = reinterpret_cast<Bytef*>(block.data());
        z.stream.avail_out = static_cast<uInt>(block.size());
        int const status = inflate(&z.stream, Z_NO_FLUSH);
        out.append(block.data(), block.size() - z.stream.avail_out);
        if (out.size() > limit) return too_long();
        if (status == Z_STREAM_END) {
            // gzip files may be concatenated; what follows and is no gzip is padding.
            bool const more =
                z.stream.avail_in >= 2 && z.stream.next_in[0] == 0x1f && z.stream.next_in[1] == 0x8b;
            if (!more) return {std::move(out), {}};
            if (inflateReset(&z.stream) != Z_OK) return {{}, "has a broken gzip stream"};
        } else if (status != Z_OK) {
            return {{}, "has a broken or truncated gzip stream"};
        }
    }
}

FileBytes read_bytes(std::filesystem::path const& path) {
    std::error_code error;
    auto const status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) return {{}, "does not exist"};
    if (!std::filesystem::is_regular_file(status)) return {{}, "is not a regular file"};
    auto const size = std::filesystem::file_size(path, error);
    if (!error && size > kMaxFileBytes) return too_long();

    auto const close = [](std::FILE* f) { std::fclose(f); };
    std::unique_ptr<std::FILE, decltype(close)> const file(std::fopen(path.c_str(), "rb"), close);
    if (!file) return {{}, std::string("cannot be opened: ") + std::strerror(errno)};
    std::string bytes;
    bytes.resize(error ? 0 : size);
    std::size_t used = std::fread(bytes.data(), 1, bytes.size(), file.get());
    // The size is only a hint: files grow, and some file systems say 0.
    std::array<char, 1 << 16> block;
    bytes.resize(used);
    while (std::size_t const n = std::fread(block.data(), 1, block.size(), file.get())) {
        bytes.append(block.data(), n);
        if (bytes.size() > kMaxFileBytes) return too_long();
    }
    if (std::ferror(file.get())) return {{}, "cannot be read"};
    return inflate_if_gzip(std::move(bytes));
}

}  // namespace nephroid
