// A tree over points in a given order, eight ways at each node: the kd-tree of photons.
//
// Leaves are runs of photons; a node holds the boxes of eight leaves, or of eight nodes, that follow each other. So there are no
// pointers, and one step looks at eight boxes. Boxes hug the photons, which lie on surfaces: that leaves out more than the
// planes of a kd-tree do (docs/decisions/0008-photon-map-structure.md).
#pragma once

#include "transport/float8.h"
#include "transport/nearest_photons.h"

#include <array>
#include <span>
#include <vector>

namespace nephroid {

struct PlacedPhoton;

class PhotonTree {
  public:
    /// Photons in a leaf.
    static constexpr std::uint32_t kLeafBlocks = 1;
    static constexpr std::uint32_t kLeaf = 8 * kLeafBlocks;

    PhotonTree() = default;
    /// Over photons as order_photons leaves them.
    explicit PhotonTree(std::span<PlacedPhoton const> photons);

    [[nodiscard]] std::size_t bytes() const {
        return points_.capacity() * sizeof(Points8) + nodes_.capacity() * sizeof(Boxes8);
    }

    /// Calls f(first place, squared distances) for eight photons that follow each other in the order, for all eights that may hold
    /// some with squared distance < distance2.
    template <class F>
    void eights_within(Vec3 p, float distance2, F&& f) const;
    /// Adds what may be among the nearest to `out`, which says how near that is.
    void nearest(Vec3 p, NearestPhotons& out) const;

  private:
    static constexpr std::uint32_t kMostLevels = 11;  // 8^11 leaves are more than 2^32 photons

    std::vector<Points8> points_;                     // eight photons each; the last filled up with NaN
    std::vector<Boxes8> nodes_;                       // level by level, the lowest first
    std::array<std::uint32_t, kMostLevels> first_{};  // node of each level
    std::uint32_t levels_ = 0;
};

template <class F>
void PhotonTree::eights_within(Vec3 p, float distance2, F&& f) const {
    if (levels_ == 0) return;
    Points8 const at = all8(p);
    Float8 const most = all8(distance2);
    struct Open {
        std::uint32_t node, level;
    };
    std::array<Open, 8 * kMostLevels> stack;
    std::size_t open = 0;
    stack[open++] = {0, levels_ - 1};
    while (open > 0) {
        std::uint32_t const node = stack[--open].node, level = stack[open].level;
        std::uint32_t const near = less8(nodes_[first_[level] + node].distance2(at), most);
        if (level > 0) {
            each_bit(near, [&](std::uint32_t i) { stack[open++] = {8 * node + i, level - 1}; });
            continue;
        }
        each_bit(near, [&](std::uint32_t i) {
            std::uint32_t const block = (8 * node + i) * kLeafBlocks;
            for (std::uint32_t b = block; b < block + kLeafBlocks; ++b) f(8 * b, points_[b].distance2(at));
        });
    }
}

}  // namespace nephroid
