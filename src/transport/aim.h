// Aim: caustic paths are sent towards what reflects or refracts (the projection maps of Jensen 1996, 2001 5.3, without a map: the
// cones that the bounding spheres of casters subtend).
#pragma once

#include "world/world.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid {

class Aim {
  public:
    Aim() = default;
    /// Of a world's casters: everything whose material may scatter (near-)specularly.
    explicit Aim(World const& world);

    /// Something casts.
    [[nodiscard]] bool casts() const { return casts_; }
    /// A ray of light towards some caster; LightRay's densities are those of this choice among all that lead there, so that
    /// power() is what the ray stands for. Every ray that can meet a caster may come; others have no use.
    [[nodiscard]] std::optional<LightRay> sample(World const& world, double u_source, float u_caster,
                                                 Vec2 u_position, Vec2 u_direction,
                                                 Wavelengths const& lambda) const;

  private:
    bool casts_ = false;
};

}  // namespace nephroid
