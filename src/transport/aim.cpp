#include "aim.h"

namespace nephroid {

Aim::Aim(World const&) : casts_(true) {}

std::optional<LightRay> Aim::sample(World const& world, double u_source, float, Vec2 u_position,
                                    Vec2 u_direction, Wavelengths const& lambda) const {
    return world.sample_emission(u_source, u_position, u_direction, lambda);
}

}  // namespace nephroid
