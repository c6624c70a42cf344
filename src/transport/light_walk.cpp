#include "light_walk.h"

namespace nephroid {

std::optional<LightStart> emit(PathContext& c, Aim const* aim, std::uint64_t paths, std::uint32_t* light) {
    c.sampler.at(dimension::kSource);
    // One light alone is no choice; towards casters there is more than one way.
    double const u_source = aim || c.world.chooses_lights() ? c.sampler.next_1d_fine() : 0.0;
    c.sampler.at(dimension::kSourcePoint);
    Vec2 const u_point = c.sampler.next_2d();
    c.sampler.at(dimension::kSourceDirection);
    Vec2 const u_direction = c.sampler.next_2d();
    std::optional<LightRay> ray;
    if (aim) {
        Aim::Way const way = aim->choose(u_source);
        if (light) *light = way.light;
        ray = aim->sample(c.world, way, u_point, u_direction, c.lambda);
    } else {
        ray = c.world.sample_emission(u_source, u_point, u_direction, c.lambda);
        if (light) *light = ray ? ray->light : c.world.light_chosen_by(u_source).value_or(*light);
    }
    std::optional<LightStart> start;
    if (!ray) return start;
    Spectrum const power = ray->power();
    c.tainted = !power.is_finite();
    if (power.is_black() || c.tainted) return start;
    start.emplace();
    start->ray = *ray;
    Walk& w = start->walk;
    w.mode = Mode::Importance;
    w.ray = ray->start();
    w.beta = power / static_cast<float>(paths);
    w.specular = true;
    if (c.world.encloses()) w.interiors = interiors_at(c.world, w.ray.o, c.stats);
    return start;
}

bool survives_with_power(PathContext& c, Walk& walk, Spectrum before) {
    // What keep_hero() multiplied is the same power in one lane instead of four.
    bool const was_spread = before[1] + before[2] + before[3] > 0.0f;
    float const most = before.max();
    float const left = walk.beta.max() * (walk.hero_only && was_spread ? 0.25f : 1.0f);
    float const q = min(1.0f, left / most);
    c.sampler.at(dimension::of(walk.vertex - 1, dimension::kRoulette));
    if (!(c.sampler.next_1d() < q)) return false;
    walk.beta /= q;
    return true;
}

}  // namespace nephroid
