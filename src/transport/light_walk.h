// The walk of a light path: the same as a camera's, begun at a light and carrying power.
//
// beta is what the path stands for at its end, W (per nm): the power of its first ray, shared among the paths that are emitted, times
// f_imp |cos| / pdf along the way (Veach 1997, 4.5.1; PBRT 4th ed., 16.1).
#pragma once

#include "aim.h"
#include "walk.h"

namespace nephroid {

/// What a light path begins with: numbers that choose the source, a point of it, and a direction.
struct EmissionNumbers {
    double source = 0;
    Vec2 point, direction;
};
double draw_source(PathContext& c, Aim const* aim);
EmissionNumbers draw_emission(PathContext& c, Aim const* aim);
/// A ray by the power of the lights or, with `aim` (where something casts), towards casters. Nothing where the light sends nothing. `light`,
/// where given: who was asked, also then; untouched without lights.
std::optional<LightRay> send(PathContext const& c, Aim const* aim, EmissionNumbers const& u,
                             std::uint32_t* light);
/// The walk of such a ray, one of `paths`, which is new. False where it carries nothing, or (c.tainted) what is no number.
bool begin_at_light(PathContext& c, Ray const& ray, Spectrum power, std::uint64_t paths, Walk& walk);

/// The beginning of a light path: the ray is on its way, no surface was met.
struct LightStart {
    Walk walk;
    LightRay ray;
};
/// All of that: the path that `c.sampler` is of.
std::optional<LightStart> emit(PathContext& c, Aim const* aim, std::uint64_t paths,
                               std::uint32_t* light = nullptr);

/// Roulette of light paths: a path survives a scattering with the share of its power that is left, so that photons weigh nearly
/// the same (Jensen 2001, 5.2), and only a `share` of those. `before` is beta before the scattering.
bool survives_with_power(PathContext& c, Walk& walk, Spectrum before, float share = 1);
/// The share of power, at most 1.
float power_survival(Walk const& walk, Spectrum before);

}  // namespace nephroid
