// Aim: caustic paths are sent towards what reflects or refracts (the projection maps of Jensen 1996, 2001 5.3, without a map: the
// cones that bounding balls of casters subtend).
//
// Every ray that can meet a caster may be sent. Which light sends it, from which cell of its surface and towards which ball goes by
// the power that those rays carry, so that all paths carry about the same. Balls may overlap: a ray's density is the sum over all
// that it meets, and so are its rays those of sample_emission(), each as often as it should be.
#pragma once

#include "sampling/distribution.h"
#include "world/world.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid {

class Aim {
  public:
    Aim() = default;
    /// At everything in the world that may scatter (near-)specularly. Uses the threads of the caller's arena.
    explicit Aim(World const& world);

    /// Some light may reach something that casts.
    [[nodiscard]] bool casts() const { return !ways_.empty(); }

    /// One way of sending light.
    struct Way {
        std::uint32_t light = 0;  // LightRay::light
        std::uint32_t cell = 0;   // of the square of positions on a surface
        std::uint32_t ball = 0;   // balls().size(): as sample_emission does
    };
    /// Only where something casts.
    [[nodiscard]] Way choose(double u) const;
    /// A ray sent that way; its densities are those of all ways together, so that power() is what it stands for. Nothing where no
    /// light goes.
    [[nodiscard]] std::optional<LightRay> sample(World const& world, Way way, Vec2 u_position,
                                                 Vec2 u_direction, Wavelengths const& lambda) const;
    /// How often all ways together send that ray of a light (from that cell of it), relative to its position or direction alone:
    /// World::aimed_density.
    [[nodiscard]] float density(World const& world, LightRay const& ray, std::uint32_t cell) const;

    [[nodiscard]] std::vector<BoundingSphere> const& balls() const { return balls_; }
    /// Cells along a side of the square of positions.
    [[nodiscard]] std::uint32_t side() const { return side_; }
    [[nodiscard]] std::size_t bytes() const {
        return ways_.bytes() + first_.size() * sizeof(std::uint32_t) + balls_.size() * sizeof(BoundingSphere);
    }

  private:
    class Builder;
    [[nodiscard]] std::uint32_t cells(World const& world, std::uint32_t light) const {
        return world.has_surface(light) ? side_ * side_ : 1;
    }
    /// Ways of a cell: one a ball, and one without.
    [[nodiscard]] std::uint32_t per_cell() const { return static_cast<std::uint32_t>(balls_.size()) + 1; }

    std::vector<BoundingSphere> balls_;
    std::vector<std::uint32_t> first_;  // way of each light; by cell, then ball
    std::uint32_t side_ = 1;
    AliasTable ways_;
};

}  // namespace nephroid
