// What the world says about its lights.
#include "emission.h"
#include "emitter_sampling.h"
#include "lambert_ray.h"
#include "light_table.h"
#include "sampling/warp.h"
#include "scene/match.h"
#include "world/world.h"
#include "world_parts.h"

#include <cmath>

namespace nephroid {

namespace {

/// As pbrt's scene files call it.
char const* kind_of(Light const& light) {
    return match(
        light.kind, [](PointLight const&) { return "point"; }, [](SpotLight const&) { return "spot"; },
        [](DistantLight const&) { return "distant"; }, [](InfiniteLight const&) { return "infinite"; },
        [](SunSkyLight const&) { return "sunsky"; }, [](GoniometricLight const&) { return "goniometric"; },
        [](ProjectionLight const&) { return "projection"; }, [](MeasuredLight const&) { return "measured"; });
}

}  // namespace

Spectrum World::emitted(SurfaceHit const& hit, Vec3 w, Wavelengths const& lambda) const {
    if (!hit.emits) return {};
    Emitter const& e = lights_->emitters[parts_->records[hit.record].emitter];
    if (!e.two_sided && dot(hit.s.ng, w) <= 0.0f) return {};
    return emission_at(*assets_, e, hit.s.p, hit.s.uv, lambda);
}

std::vector<LightId> const& World::infinite_lights() const { return lights_->infinite; }

Spectrum World::environment(LightId id, Vec3 p, Vec3 w, Wavelengths const& lambda) const {
    return environment_radiance((*scene_)[id], lights_->data[id.value], *assets_, p, w, lambda);
}
Spectrum World::environment(Vec3 p, Vec3 w, Wavelengths const& lambda) const {
    Spectrum sum;
    for (LightId const id : lights_->infinite) sum += environment(id, p, w, lambda);
    return sum;
}

bool World::chooses_lights() const { return lights_->entries.size() > 1; }

[[gnu::always_inline]] inline std::optional<LightSample> World::sample_area_light(
    LightEntry const& entry, float pmf, Receiver const& to, ShapeSampling how, Vec2 u,
    Wavelengths const& lambda) const {
    // A copy of a constant: to clear it in place becomes a string instruction, which takes longer than drawing the point.
    static constexpr LightSample kNone;
    std::optional<LightSample> result;
    LightSample& s = result.emplace(kNone);
    if (!sample_emitter(*lights_, *parts_, entry, to, how, u, s)) {
        result.reset();
        return result;
    }
    s.pdf *= pmf;
    Emitter const& emitter = lights_->emitters[entry.emitter];
    if (emitter.two_sided || dot(s.n, s.wi) < 0.0f)
        s.radiance = emitter.even ? emitter.radiance.sample(lambda)
                                  : emission_at(*assets_, emitter, s.p, s.uv, lambda) *
                                        opacity(*assets_, emitter, s.p, s.uv);
    s.delta = emitter.unseen;  // no ray finds it
    return result;
}

std::optional<LightSample> World::sample_light(Receiver const& to, LightSampling how, double u_choose, Vec2 u,
                                               Wavelengths const& lambda) const {
    LightTable::Choice const choice = lights_->choose(to, how.choice, u_choose);
    if (!(choice.pmf > 0.0f)) return std::nullopt;
    LightEntry const& entry = lights_->entries[choice.entry];
    return entry.shape == LightShape::NoSurface
               ? sample_light_without_surface(LightId{entry.part}, choice.pmf, to.p, u, lambda)
               : sample_area_light(entry, choice.pmf, to, how.shapes, u, lambda);
}

std::optional<LightSample> World::sample_light_without_surface(LightId id, float pmf, Vec3 p, Vec2 u,
                                                               Wavelengths const& lambda) const {
    auto s = nephroid::sample_light((*scene_)[id], lights_->data[id.value], *assets_, p, u, lambda);
    if (s) s->pdf *= pmf;
    return s;
}

std::uint32_t World::entry_of(SurfaceHit const& hit) const {
    std::uint32_t const first = hit.instance == kNoInstance ? 0 : parts_->instances[hit.instance].first_light;
    return lights_->entry_of_part[first + parts_->records[hit.record].first_light + hit.part];
}

float World::light_pdf(SurfaceHit const& hit, Receiver const& to, LightSampling how, Vec3 w) const {
    if (!hit.emits) return 0.0f;
    std::uint32_t const entry = entry_of(hit);
    float const pmf = lights_->pmf(to, how.choice, entry);
    if (!(pmf > 0.0f)) return 0.0f;
    float const pdf = emitter_pdf(*lights_, *parts_, lights_->entries[entry], to, how.shapes, hit, w);
    return std::isfinite(pdf) ? pmf * pdf : 0.0f;
}

float World::infinite_light_pdf(LightId id, Receiver const& to, LightSampling how, Vec3 w) const {
    float const pmf = lights_->pmf(to, how.choice, lights_->entry_of_light[id.value]);
    return pmf > 0.0f ? pmf * environment_pdf((*scene_)[id], lights_->data[id.value], to.p, w) : 0.0f;
}

std::optional<LightRay> World::sample_emission(double u_choose, Vec2 u_position, Vec2 u_direction,
                                               Wavelengths const& lambda) const {
    if (lights_->by_power.empty()) return std::nullopt;
    auto const chosen = lights_->by_power.sample(u_choose);
    auto ray = emit(chosen.index, nullptr, u_position, u_direction, lambda);
    if (ray) ray->choice = chosen.pmf;
    return ray;
}

std::optional<std::uint32_t> World::light_chosen_by(double u_choose) const {
    if (lights_->by_power.empty()) return std::nullopt;
    return lights_->by_power.sample(u_choose).index;
}

std::vector<LightSource> World::light_sources() const {
    std::vector<LightSource> sources;
    // Emitters have the order of the records that shine.
    for (ObjectRecord const& r : parts_->records)
        if (r.emits()) sources.push_back({"area", r.object->light->where});
    for (Light const& light : scene_->lights) sources.push_back({kind_of(light), light.where});
    return sources;
}

std::uint32_t World::source_of(std::uint32_t light) const {
    LightEntry const& e = lights_->entries[light];
    return e.shape == LightShape::NoSurface ? static_cast<std::uint32_t>(lights_->emitters.size()) + e.part
                                            : parts_->records[e.record].emitter;
}

EmissionDensity World::emission_density(SurfaceHit const& from, Vec3 w) const {
    EmissionDensity d;
    if (!from.emits || lights_->by_power.empty()) return d;
    std::uint32_t const entry = entry_of(from);
    bool const two_sided = lights_->emitters[parts_->records[from.record].emitter].two_sided;
    float const cosine = two_sided ? abs_dot(from.s.ng, w) : dot(from.s.ng, w);
    d.position =
        lights_->by_power.pmf(entry) * emitter_area_pdf(*lights_, *parts_, lights_->entries[entry], from);
    d.direction = lambert_density(cosine, two_sided);
    return d;
}

EmissionDensity World::emission_density(LightId id, Vec3 p, Vec3 w) const {
    if (lights_->by_power.empty()) return {};
    EmissionDensity d =
        nephroid::emission_density((*scene_)[id], lights_->data[id.value], bounding_sphere(bounds_), p, w);
    d.position *= lights_->by_power.pmf(lights_->entry_of_light[id.value]);
    return d;
}

float World::total_power() const { return lights_->total_power; }

}  // namespace nephroid
