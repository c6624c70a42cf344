// Where pictures of other renderers are, and how they are looked at. They are no part of the project: NEPHROID_SHARED, or
// ../shared beside the sources, says where they are.
#pragma once

#include "image/image.h"

#include <cstdlib>
#include <filesystem>

namespace nephroid::test {

inline std::filesystem::path data_folder() {
    char const* const named = std::getenv("NEPHROID_SHARED");
    auto const shared = named ? std::filesystem::path(named)
                              : std::filesystem::path(NEPHROID_SOURCE_DIR).parent_path() / "shared";
    return shared / "data";
}

/// R, G and B alone, whatever else a picture holds.
inline Image rgb_of(Image const& image) {
    Image out(PixelFormat::Float, image.width(), image.height(), {"R", "G", "B"});
    char const* const names[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        int const from = image.channel(names[c]).value();
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) out.set(x, y, c, image.get(x, y, from));
    }
    return out;
}

}  // namespace nephroid::test
