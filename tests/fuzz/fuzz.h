// What a reader is fuzzed by: fuzz() either returns or throws Error; anything else is a fault.
#pragma once

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace nephroid {

/// Each fuzz_<reader>.cpp defines it.
void fuzz(std::string_view bytes);

/// For readers that take a path.
class TemporaryFile {
  public:
    TemporaryFile(std::string_view bytes, std::string const& extension)
        : path_(std::filesystem::temp_directory_path() /
                ("nephroid-fuzz-" + std::to_string(getpid()) + extension)) {
        std::ofstream(path_, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    TemporaryFile(TemporaryFile const&) = delete;
    TemporaryFile& operator=(TemporaryFile const&) = delete;
    [[nodiscard]] std::filesystem::path const& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace nephroid
