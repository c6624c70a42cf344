// Whole files. Reading accepts regular files only: a device or a FIFO given by a scene must not hang the program.
// Writing is all or nothing: a reader sees the old file or the new one, never half of one, also after a power cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nephroid {

inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 32;

/// Throws Error(Io) if the file cannot be read or is not a regular file, Error(Limit) if it is larger than `limit`.
std::vector<std::byte> read_file(std::filesystem::path const& path, std::size_t limit = kMaxFileBytes);
std::string read_text_file(std::filesystem::path const& path, std::size_t limit = kMaxFileBytes);

/// Where a write to `path` ends up: symbolic links are followed, also one whose target is not there yet.
std::filesystem::path write_target(std::filesystem::path const& path);

/// A file in the making: it lies beside its target under a temporary name, and is gone again unless commit() puts it in
/// place. The temporary name depends on the target alone, so that what a killed process left is used up by the next one
/// that writes the same file; a lock keeps two live ones apart. A symbolic link keeps pointing where it pointed.
class NewFile {
  public:
    /// Throws Error(Io) when the folder takes no file, or when what is there is no regular file.
    explicit NewFile(std::filesystem::path path);
    ~NewFile();
    NewFile(NewFile const&) = delete;
    NewFile& operator=(NewFile const&) = delete;

    /// False once something has failed, and from then on; commit() says what.
    bool write(std::span<std::byte const> data);
    bool seek(std::uint64_t position);
    [[nodiscard]] bool failed() const { return error_ != 0; }
    /// Syncs, renames, syncs the folder. Throws Error(Io); the old file is then still there.
    void commit();

  private:
    void open_temporary();

    std::filesystem::path path_, target_, temporary_;
    int fd_ = -1;
    int error_ = 0;  // the first errno
};

/// All of it at once.
void write_file_atomically(std::filesystem::path const& path, std::span<std::byte const> data);

}  // namespace nephroid
