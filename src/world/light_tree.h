// A tree over lights, by which one is chosen in proportion to what it may contribute: Conty Estevez & Kulla 2018,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting"; PBRT 4th ed., 12.6.3.
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
    [[nodiscard]] std::size_t size() const { return leaf_of_light_.size(); }
    /// Nothing where no light can reach the receiver. u in [0, 1).
    [[nodiscard]] std::optional<Choice> sample(Receiver const& to, double u) const;
    /// The probability with which sample() chooses the light.
    [[nodiscard]] float pmf(Receiver const& to, std::uint32_t light) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    friend class LightTreeBuilder;
    static constexpr std::uint32_t kLeaf = 0x80000000u;
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    /// Siblings lie side by side, at an even index and the next; the root is 0, and 1 is left empty.
    struct Node {
        Vec3 centre{0, 0, 0};
        float radius2 = 0;  // of a sphere around the box
        Vec3 axis{0, 0, 1};
        float intensity = 0;
        float cos_normals = 1, sin_normals = 0, cos_emission = 0;
        std::uint32_t link = 0;  // the first child, or kLeaf | light
        std::uint32_t parent = 0;
        bool two_sided = false;
    };
    [[nodiscard]] static float importance(Node const& node, Receiver const& to);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> leaf_of_light_;
};

}  // namespace nephroid
