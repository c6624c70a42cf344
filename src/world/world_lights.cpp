// What the world says about its lights.
#include "emission.h"
#include "emitter_sampling.h"
#include "light_table.h"
#include "world/world.h"
#include "world_parts.h"

#include <cmath>

namespace nephroid {

Spectrum World::emitted(SurfaceHit const& hit, Vec3 w, Wavelengths const& lambda) const {
    if (!hit.emits) return {};
    Emitter const& e = lights_->emitters[parts_->records[hit.record].emitter];
    if (!e.light->two_sided && dot(hit.s.ng, w) <= 0.0f) return {};
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

std::optional<LightSample> World::sample_light(Receiver const& to, LightSampling how, double u_choose, Vec2 u,
                                               Wavelengths const& lambda) const {
    auto const choice = lights_->choose(to, how.choice, u_choose);
    if (!choice) return std::nullopt;
    LightEntry const& entry = lights_->entries[choice->entry];
    return entry.shape == LightShape::NoSurface
               ? sample_light_without_surface(LightId{entry.part}, choice->pmf, to.p, u, lambda)
               : sample_area_light(entry, choice->pmf, to, how.shapes, u, lambda);
}

std::optional<LightSample> World::sample_light_without_surface(LightId id, float pmf, Vec3 p, Vec2 u,
                                                               Wavelengths const& lambda) const {
    auto s = nephroid::sample_light((*scene_)[id], lights_->data[id.value], *assets_, p, u, lambda);
    if (s) s->pdf *= pmf;
    return s;
}

std::optional<LightSample> World::sample_area_light(LightEntry const& entry, float pmf, Receiver const& to,
                                                    ShapeSampling how, Vec2 u,
                                                    Wavelengths const& lambda) const {
    std::optional<LightSample> result;
    LightSample& s = result.emplace();
    if (!sample_emitter(*lights_, *parts_, entry, to, how, u, s)) {
        result.reset();
        return result;
    }
    s.pdf *= pmf;
    Emitter const& emitter = lights_->emitters[parts_->records[entry.record].emitter];
    if (emitter.light->two_sided || dot(s.n, s.wi) < 0.0f)
        s.radiance = emission_at(*assets_, emitter, s.p, s.uv, lambda);
    return result;
}

float World::light_pdf(SurfaceHit const& hit, Receiver const& to, LightSampling how, Vec3 w) const {
    ObjectRecord const& record = parts_->records[hit.record];
    if (!record.emits()) return 0.0f;
    std::uint32_t const first = hit.instance == kNoInstance ? 0 : parts_->instances[hit.instance].first_light;
    std::uint32_t const entry = lights_->entry_of_part[first + record.first_light + hit.part];
    float const pmf = lights_->pmf(to, how.choice, entry);
    if (!(pmf > 0.0f)) return 0.0f;
    float const pdf = emitter_pdf(*lights_, *parts_, lights_->entries[entry], to, how.shapes, hit, w);
    return std::isfinite(pdf) ? pmf * pdf : 0.0f;
}

float World::infinite_light_pdf(LightId id, Receiver const& to, LightSampling how, Vec3 w) const {
    float const pmf = lights_->pmf(to, how.choice, lights_->entry_of_light[id.value]);
    return pmf > 0.0f ? pmf * environment_pdf((*scene_)[id], lights_->data[id.value], to.p, w) : 0.0f;
}

}  // namespace nephroid
