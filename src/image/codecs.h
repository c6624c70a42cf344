// What the readers and writers of this room share; not part of its interface.
#pragma once

#include "image/image.h"
#include "math/error.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::codec {

using Bytes = std::span<std::byte const>;

/// "path: what".
[[noreturn]] void fail(std::string const& path, std::string const& what, ErrorKind kind = ErrorKind::Input);
/// Refuses empty and negative sizes, and more pixels than the limits in image.h allow. Call it before allocating.
void check_size(std::string const& path, std::int64_t width, std::int64_t height, std::int64_t channels,
                std::int64_t bytes_per_channel);

// Each decodes a whole file; `path` is for messages only.
Image decode_png(Bytes file, std::string const& path, std::optional<Encoding> override_encoding);
Image decode_jpeg(Bytes file, std::string const& path, std::optional<Encoding> override_encoding);
Image decode_tga(Bytes file, std::string const& path, std::optional<Encoding> override_encoding);
Image decode_bmp(Bytes file, std::string const& path, std::optional<Encoding> override_encoding);
Image decode_exr(Bytes file, std::string const& path);
Image decode_hdr(Bytes file, std::string const& path);
Image decode_pfm(Bytes file, std::string const& path);

/// A cursor over a file's bytes; reading past the end throws "truncated".
class Cursor {
  public:
    Cursor(Bytes file, std::string const& path) : file_(file), path_(&path) {}
    [[nodiscard]] std::size_t left() const { return file_.size() - at_; }
    [[nodiscard]] std::size_t at() const { return at_; }
    std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
    Bytes take(std::size_t n) {
        if (n > left()) fail(*path_, "the file is truncated; get a complete copy");
        Bytes const piece = file_.subspan(at_, n);
        at_ += n;
        return piece;
    }
    /// Up to the newline, which is consumed; at most `longest` characters.
    std::string line(std::size_t longest = 4096);

  private:
    Bytes file_;
    std::string const* path_;
    std::size_t at_ = 0;
};

}  // namespace nephroid::codec
