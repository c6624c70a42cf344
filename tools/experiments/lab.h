// What a page's sections share: the page, and how large a run is.
#pragma once

#include "page.h"

#include <algorithm>
#include <filesystem>

namespace nephroid::experiment {

/// Where a page finds pictures in full size, beside it.
inline constexpr char const* kFullFolder = "full";

struct Lab {
    Page& page;
    bool quick = false;             // a run of seconds that shows that everything works, and nothing else
    std::filesystem::path scratch;  // for files that a scene reads; gone when the run ends
    std::filesystem::path full;     // where pictures go in full size, each as EXR and PNG; empty: nowhere
    int enlarge = 1;                // pictures are rendered so many times as large as sheets show them

    /// Passes of measurements that need no particular number.
    [[nodiscard]] std::uint64_t passes(std::uint64_t n) const {
        return quick ? std::max<std::uint64_t>(4, n / 32) : n;
    }
    [[nodiscard]] int pixels(int n) const { return quick ? std::max(6, n / 6) : n * enlarge; }
    /// Of pictures that are measured and not shown.
    [[nodiscard]] int measured(int n) const { return quick ? std::max(6, n / 6) : n; }
    [[nodiscard]] int seeds(int n) const { return quick ? 2 : n; }
};

}  // namespace nephroid::experiment
