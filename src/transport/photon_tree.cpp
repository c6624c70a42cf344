#include "transport/photon_tree.h"

#include "photon_order.h"

#include <tbb/parallel_for.h>

namespace nephroid {

namespace {

constexpr std::size_t up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

/// A node over up to eight boxes, and the box around them.
Bounds3 make_node(std::span<Bounds3 const> children, Boxes8& node) {
    Bounds3 around;
    for (std::uint32_t i = 0; i < 8; ++i) {
        Bounds3 const b = i < children.size() ? children[i] : Bounds3{};  // an empty box is infinitely far
        node.lo.set(i, b.lo);
        node.hi.set(i, b.hi);
        around.add(b);
    }
    return around;
}

}  // namespace

PhotonTree::PhotonTree(std::span<PlacedPhoton const> photons) {
    if (photons.empty()) return;
    std::size_t const leaves = up(photons.size(), kLeaf);
    points_.resize(leaves * kLeafBlocks);
    std::vector<Bounds3> boxes(leaves);
    Vec3 const nowhere(std::numeric_limits<float>::quiet_NaN());
    tbb::parallel_for(std::size_t{0}, leaves, [&](std::size_t leaf) {
        std::size_t const begin = leaf * kLeaf;
        auto const run = photons.subspan(begin, std::min<std::size_t>(kLeaf, photons.size() - begin));
        boxes[leaf] = bounds_of(run);
        for (std::uint32_t i = 0; i < kLeaf; ++i)
            points_[leaf * kLeafBlocks + i / 8].set(i % 8, i < run.size() ? run[i].p : nowhere);
    });
    std::size_t all = 0;
    for (std::size_t n = leaves; levels_ == 0 || n > 1; ++levels_) {
        first_[levels_] = static_cast<std::uint32_t>(all);
        n = up(n, 8);
        all += n;
    }
    nodes_.resize(all);
    for (std::uint32_t level = 0; level < levels_; ++level) {
        std::vector<Bounds3> above(up(boxes.size(), 8));
        tbb::parallel_for(std::size_t{0}, above.size(), [&](std::size_t i) {
            auto const children = std::span<Bounds3 const>(boxes).subspan(8 * i);
            above[i] = make_node(children.first(std::min<std::size_t>(8, children.size())),
                                 nodes_[first_[level] + i]);
        });
        boxes = std::move(above);
    }
}

void PhotonTree::nearest(Vec3 p, NearestPhotons& out) const {
    if (levels_ == 0) return;
    struct Open {
        float distance2;
        std::uint32_t node, level;
    };
    std::array<Open, 16 * kMostLevels> stack;
    std::size_t open = 0;
    stack[open++] = {0.0f, 0, levels_};  // the root, as the only child of none
    Points8 const at = all8(p);
    while (open > 0) {
        std::uint32_t const node = stack[--open].node, level = stack[open].level;
        if (!(stack[open].distance2 < out.most())) continue;
        if (level == 0) {
            for (std::uint32_t b = node * kLeafBlocks; b < (node + 1) * kLeafBlocks; ++b)
                out.add(points_[b].distance2(at), 8 * b);
            continue;
        }
        Float8 const d2 = nodes_[first_[level - 1] + node].distance2(at);
        // The nearest is opened first: it lies on top. Before there are k, of all that is open, because a large box around p may hold
        // none near p; then, of the eight.
        std::size_t const bottom = level == 1 || out.sated() || open > 8 * kMostLevels ? open : 0;
        each_bit(less8(d2, all8(out.most())), [&](std::uint32_t i) {
            std::size_t place = open++;
            for (; place > bottom && stack[place - 1].distance2 < d2[i]; --place)
                stack[place] = stack[place - 1];
            stack[place] = {d2[i], 8 * node + i, level - 1};
        });
    }
}

}  // namespace nephroid
