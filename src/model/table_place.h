// Looking up in layer_albedos.h's tables: linear along every axis.
#pragma once

#include "layer_albedos.h"
#include "math/vec.h"

#include <algorithm>

namespace nephroid {

/// x in [0, 1] of an axis that is cut into cells.
struct TablePlace {
    std::size_t cell;
    float t;
    TablePlace(float x, int cells) {
        float const at = clamp(x, 0.0f, 1.0f) * static_cast<float>(cells);
        int const i = std::min(static_cast<int>(at), cells - 1);
        cell = static_cast<std::size_t>(i);
        t = at - static_cast<float>(i);
    }
};
inline float between(float value) { return value; }
inline LayerAlbedos::Solid between(LayerAlbedos::Solid const& value) { return value; }
inline LayerAlbedos::Solid lerp(float t, LayerAlbedos::Solid const& a, LayerAlbedos::Solid const& b) {
    return {lerp(t, a.base, b.base), lerp(t, a.first, b.first), lerp(t, a.edge, b.edge)};
}
template <class A, class... Rest>
auto between(A const& nodes, TablePlace const& at, Rest const&... rest) {
    return lerp(at.t, between(nodes[at.cell], rest...), between(nodes[at.cell + 1], rest...));
}

}  // namespace nephroid
