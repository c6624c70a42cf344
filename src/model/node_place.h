// Where a value lies among the nodes of a table.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cstddef>

namespace nephroid {

/// The node below, and how far it is from there to the next; beyond the ends, at the ends.
struct NodePlace {
    std::size_t i = 0;
    float t = 0;

    NodePlace() = default;
    /// x from 0 to n - 1, n >= 2 nodes.
    NodePlace(float x, std::size_t n) {
        x = clamp(x, 0.0f, static_cast<float>(n - 1));
        i = std::min(static_cast<std::size_t>(x), n - 2);
        t = x - static_cast<float>(i);
    }
};

}  // namespace nephroid
