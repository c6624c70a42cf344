// A box as a receiver sees it: at most three faces from outside, all six from inside.
#pragma once

#include "emitter_sampling.h"

#include <array>

namespace nephroid {

/// Faces by their part numbers, 2 * axis + (1 at the far end of the edge), and how likely each is.
class SeenBox {
  public:
    SeenBox(BoxLight const& box, Receiver const& to, ShapeSampling how, bool two_sided);

    bool sample(Vec2 u, LightSample& s) const;
    [[nodiscard]] float pdf(std::uint32_t face, Vec3 p, Vec3 w) const;

  private:
    struct Face {
        Vec3 corner;
        std::size_t axis;
        bool far_end;
    };
    [[nodiscard]] Face face(std::uint32_t i) const;
    [[nodiscard]] bool emits_to(std::uint32_t i, bool two_sided) const;
    /// By area over one face: what the strategy says its density is.
    [[nodiscard]] float claimed_area_pdf(std::uint32_t i) const;

    /// Beyond this many squared diagonals the faces are sampled by area (docs/decisions/0005).
    static constexpr float kFar2 = 4;

    BoxLight const& box_;
    Receiver const& to_;
    ShapeSampling how_;
    std::array<float, 3> above_{};  // the receiver's height above the faces s_i = 0
    std::array<float, 6> weight_{};
    float sum_ = 0;
    float visible_area_ = 0;
};

}  // namespace nephroid
