// Looking up in layer_albedos.h's tables: linear along every axis.
#pragma once

#include "layer_albedos.h"
#include "node_place.h"

namespace nephroid {

/// x in [0, 1] of an axis that is cut into cells.
struct TablePlace : NodePlace {
    TablePlace(float x, int cells)
        : NodePlace(x * static_cast<float>(cells), static_cast<std::size_t>(cells) + 1) {}
};
inline float between(float value) { return value; }
inline LayerAlbedos::Solid between(LayerAlbedos::Solid const& value) { return value; }
inline LayerAlbedos::Solid lerp(float t, LayerAlbedos::Solid const& a, LayerAlbedos::Solid const& b) {
    return {lerp(t, a.base, b.base), lerp(t, a.first, b.first), lerp(t, a.edge, b.edge)};
}
template <class A, class... Rest>
auto between(A const& nodes, TablePlace const& at, Rest const&... rest) {
    return lerp(at.t, between(nodes[at.i], rest...), between(nodes[at.i + 1], rest...));
}

}  // namespace nephroid
