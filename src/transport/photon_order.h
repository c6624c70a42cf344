// The order of photons in a tree: each aligned run of leaf * 2^l of them is close together.
#pragma once

#include "math/bounds.h"

#include <cstdint>
#include <span>

namespace nephroid {

/// Where a photon is, and which it was.
struct PlacedPhoton {
    Vec3 p;
    std::uint32_t index;
};
static_assert(sizeof(PlacedPhoton) == 16);

Bounds3 bounds_of(std::span<PlacedPhoton const> photons);

/// Median splits along the longest side of what is left (kd-tree), moved to multiples of leaf * 2^l: all leaves are full but the
/// last, and a tree over them needs no pointers. By rank, not by place: photons at one point do no harm. A function of the
/// sequence alone, on any number of threads; positions must be finite.
void order_photons(std::span<PlacedPhoton> photons, std::size_t leaf);

}  // namespace nephroid
