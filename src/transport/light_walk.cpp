#include "light_walk.h"

namespace nephroid {

double draw_source(PathContext& c, Aim const* aim) {
    // One light alone is no choice; towards casters there is more than one way.
    if (!aim && !c.world.chooses_lights()) return 0;
    c.sampler.at(dimension::kSource);
    return c.sampler.next_1d_fine();
}

EmissionNumbers draw_emission(PathContext& c, Aim const* aim) {
    EmissionNumbers u;
    u.source = draw_source(c, aim);
    c.sampler.at(dimension::kSourcePoint);
    u.point = c.sampler.next_2d();
    c.sampler.at(dimension::kSourceDirection);
    u.direction = c.sampler.next_2d();
    return u;
}

std::optional<LightRay> send(PathContext const& c, Aim const* aim, EmissionNumbers const& u,
                             std::uint32_t* light) {
    if (aim) {
        Aim::Way const way = aim->choose(u.source);
        if (light) *light = way.light;
        return aim->sample(c.world, way, u.point, u.direction, c.lambda);
    }
    auto ray = c.world.sample_emission(u.source, u.point, u.direction, c.lambda);
    if (light) *light = ray ? ray->light : c.world.light_chosen_by(u.source).value_or(*light);
    return ray;
}

bool begin_at_light(PathContext& c, Ray const& ray, Spectrum power, std::uint64_t paths, Walk& walk) {
    c.tainted = !power.is_finite();
    if (power.is_black() || c.tainted) return false;
    walk.mode = Mode::Importance;
    walk.ray = ray;
    walk.beta = power / static_cast<float>(paths);
    walk.specular = true;
    if (c.world.encloses()) walk.interiors = interiors_at(c.world, walk.ray.o, c.stats);
    return true;
}

std::optional<LightStart> emit(PathContext& c, Aim const* aim, std::uint64_t paths, std::uint32_t* light) {
    std::optional<LightStart> start;
    auto const ray = send(c, aim, draw_emission(c, aim), light);
    if (!ray) return start;
    start.emplace(LightStart{{}, *ray});
    if (!begin_at_light(c, ray->start(), ray->power(), paths, start->walk)) start.reset();
    return start;
}

float power_survival(Walk const& walk, Spectrum before) {
    // What keep_hero() multiplied is the same power in one lane instead of four.
    bool const was_spread = before[1] + before[2] + before[3] > 0.0f;
    float const left = walk.beta.max() * (walk.hero_only && was_spread ? 0.25f : 1.0f);
    return min(1.0f, left / before.max());
}

bool survives_with_power(PathContext& c, Walk& walk, Spectrum before, float share) {
    float const q = power_survival(walk, before) * share;
    c.sampler.at(roulette_dimension(walk));
    if (!(c.sampler.next_1d() < q)) return false;
    walk.beta /= q;
    return true;
}

}  // namespace nephroid
