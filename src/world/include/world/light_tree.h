// A tree over lights, by which one is chosen in proportion to what it may contribute: Conty Estevez & Kulla 2018,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting"; PBRT 4th ed., 12.6.3. What they say of a node is a bound, and
// loose where the receiver is near; so the choice is not between two children but among a front of descendants, finer where the
// node is near, and among all lights of a small node (docs/decisions/0006).
#pragma once

#include "model/light.h"
#include "model/light_bounds.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nephroid {

class LightTree {
  public:
    struct Choice {
        std::uint32_t light = 0;
        float pmf = 0;
    };

    LightTree() = default;
    /// bounds[i] is light i's; those without intensity are never chosen.
    explicit LightTree(std::span<LightBounds const> bounds);

    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] std::size_t size() const { return order_.size(); }
    /// Nothing where no light can reach the receiver. u in [0, 1).
    [[nodiscard]] std::optional<Choice> sample(Receiver const& to, double u) const;
    /// The probability with which sample() chooses the light.
    [[nodiscard]] float pmf(Receiver const& to, std::uint32_t light) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    friend class LightTreeBuilder;
    static constexpr std::uint32_t kLeaf = 0x80000000u;
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    /// Siblings lie side by side; the root is 0.
    struct Node {
        Vec3 centre{0, 0, 0};
        float radius2 = 0;  // of a sphere around the box
        Vec3 axis{0, 0, 1};
        float intensity = 0;
        float cos_normals = 1, sin_normals = 0, cos_emission = 0;
        std::uint32_t link = 0;              // the first child, or kLeaf | light
        std::uint32_t begin = 0, count = 0;  // its leaves, in the order of the tree
        bool two_sided = false;
    };
    static constexpr std::uint32_t kSmall = 32;  // lights of a node that are looked at one by one
    struct Front;
    [[nodiscard]] static float importance(Node const& node, Receiver const& to);
    void gather(std::uint32_t node, Receiver const& to, Front& front) const;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;  // of each light among the leaves, or kNone
};

}  // namespace nephroid
