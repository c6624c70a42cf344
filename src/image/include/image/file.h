// Whole files. Reading accepts regular files only: a device or a FIFO given by a scene must not hang the program.
// Writing is all or nothing: a reader sees the old file or the new one, never half of one, also after a power cut.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nephroid {

inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 32;

/// Throws Error(Io) if the file cannot be read or is not a regular file, Error(Limit) if it is larger than `limit`.
std::vector<std::byte> read_file(std::filesystem::path const& path, std::size_t limit = kMaxFileBytes);
std::string read_text_file(std::filesystem::path const& path, std::size_t limit = kMaxFileBytes);

/// Writes beside the target, syncs, renames, syncs the folder. On failure the old file stays, the temporary goes, and
/// Error(Io) says why. A symbolic link keeps pointing where it pointed: its target is replaced.
void write_file_atomically(std::filesystem::path const& path, std::span<std::byte const> data);

}  // namespace nephroid
