// Files as bytes: regular files only (never a device, a pipe or a folder, which might not end), gzip'd ones inflated.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace nephroid {

/// No file may be longer, nor inflate to more: a few kilobytes of gzip can stand for terabytes.
inline constexpr std::size_t kMaxFileBytes = std::size_t{2} << 30;

struct FileBytes {
    std::string bytes;
    std::string problem;    // why it could not be read; empty when it could
    bool too_long = false;  // the problem is kMaxFileBytes
};
FileBytes read_bytes(std::filesystem::path const& path);

/// Inflates when `bytes` begins with gzip's magic, else hands them back.
FileBytes inflate_if_gzip(std::string bytes, std::size_t limit = kMaxFileBytes);

}  // namespace nephroid
