// What the tests of this room share.
#pragma once

#include "image/file.h"
#include "image/image.h"
#include "math/error.h"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace nephroid::test {

/// An empty folder that goes away again.
class Folder {
  public:
    Folder() {
        static std::atomic<int> counter{0};
        path_ = std::filesystem::temp_directory_path() /
                ("nephroid-image-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;
    [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
    [[nodiscard]] std::filesystem::path const& path() const { return path_; }
    [[nodiscard]] int entries() const {
        int n = 0;
        for ([[maybe_unused]] auto const& entry : std::filesystem::directory_iterator(path_)) ++n;
        return n;
    }

  private:
    std::filesystem::path path_;
};

/// A folder of the shared test data, if it is there.
inline std::optional<std::filesystem::path> shared(std::string_view folder) {
    char const* const named = std::getenv("NEPHROID_SHARED");
    std::filesystem::path const root = named != nullptr
                                           ? std::filesystem::path(named)
                                           : std::filesystem::path(NEPHROID_SOURCE_DIR) / ".." / "shared";
    std::filesystem::path const path = root / folder;
    return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

inline std::span<std::byte const> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

inline std::filesystem::path write(Folder const& folder, std::string_view name, std::string_view content) {
    auto const path = folder / name;
    write_file_atomically(path, bytes(content));
    return path;
}

/// The kind of error that f throws; none if it returns.
template <class F>
std::optional<ErrorKind> error_of(F&& f, std::string* message = nullptr) {
    try {
        f();
    } catch (Error const& e) {
        if (message != nullptr) *message = e.what();
        return e.kind();
    }
    return std::nullopt;
}

/// Smooth, different in each channel and corner, within [0, 1].
inline Image gradient(PixelFormat format, int width, int height, int channels,
                      Encoding encoding = Encoding::linear()) {
    Image image(format, width, height, default_channel_names(channels), encoding);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                image.set(x, y, c,
                          (static_cast<float>(x) + 0.5f) / static_cast<float>(width) *
                              (c == 1 ? (static_cast<float>(y) + 0.5f) / static_cast<float>(height) : 1.0f) /
                              static_cast<float>(1 + c));
    return image;
}

inline float largest_difference(Image const& a, Image const& b) {
    float largest =
        a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() ? 0.0f : 1e30f;
    if (largest > 0) return largest;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int c = 0; c < a.channels(); ++c)
                largest = std::fmax(largest, std::abs(a.get(x, y, c) - b.get(x, y, c)));
    return largest;
}

}  // namespace nephroid::test
