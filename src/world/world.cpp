#include "world/world.h"

#include "light_table.h"
#include "model/material.h"
#include "ray_caster.h"
#include "scene/match.h"
#include "world_parts.h"

#include <cmath>

namespace nephroid {

std::size_t LightTable::bytes() const {
    std::size_t n = emitters.size() * sizeof(Emitter) + data.size() * sizeof(LightData) +
                    entries.size() * sizeof(LightEntry) + entry_of_light.size() * sizeof(std::uint32_t) +
                    choice.bytes();
    for (LightData const& d : data)
        if (d.table) n += d.table->bytes();
    return n;
}

World::World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

WorldMemory World::memory() const {
    WorldMemory m;
    for (Group const& g : scene_->groups)
        for (Object const& o : g.objects)
            match(
                o.shape,
                [&](TriangleMesh const& s) {
                    m.meshes += s.p.size() * sizeof(Vec3) + s.n.size() * sizeof(Vec3) +
                                s.uv.size() * sizeof(Vec2) + s.triangles.size() * sizeof(Vec3i);
                },
                [&](BilinearMesh const& s) {
                    m.meshes += s.p.size() * sizeof(Vec3) + s.n.size() * sizeof(Vec3) +
                                s.uv.size() * sizeof(Vec2) + s.patches.size() * sizeof(s.patches[0]);
                },
                [](auto const&) {});
    m.bvh = caster_->bytes();
    m.images = assets_->image_bytes();
    m.spectra = assets_->spectrum_bytes();
    m.lights = lights_->bytes();
    m.instances =
        parts_->instances.size() * sizeof(InstanceRecord) + parts_->records.size() * sizeof(ObjectRecord);
    return m;
}

bool World::intersect(Ray const& ray, float t_max, RayKind kind, RayStats& stats, SurfaceHit& hit) const {
    ++stats.rays[static_cast<std::size_t>(kind)];
    if (!RayCaster::acceptable(ray, t_max)) {
        ++stats.rejected;
        return false;
    }
    if (stats.recorder) stats.recorder->push_back({ray, t_max, kind});
    RawHit raw;
    if (!caster_->nearest(ray, t_max, raw)) return false;
    ++stats.hits;
    complete(raw, hit);
    return true;
}

/// From what the intersector says to a point on a surface.
void World::complete(RawHit const& raw, SurfaceHit& hit) const {
    InstanceRecord const* instance = raw.instance == kNoInstance ? nullptr : &parts_->instances[raw.instance];
    std::uint32_t const index = (instance ? instance->first_record : 0) + raw.geometry;
    ObjectRecord const& record = parts_->records[index];
    hit.t = raw.t;
    hit.hit_uv = {raw.u, raw.v};
    hit.record = index;
    hit.part = raw.primitive;
    hit.instance = raw.instance;
    hit.material = record.material;
    hit.emits = record.emits();
    hit.passage = record.passage;
    surface_at(record, instance, {static_cast<double>(raw.t), raw.u, raw.v, raw.primitive}, raw.local,
               record.textured, hit.s);
}

float World::transmittance(SurfaceHit const& from, LightSample const& to, RayStats& stats) const {
    ++stats.rays[static_cast<std::size_t>(RayKind::Shadow)];
    Ray ray;
    float t_max = kInfinity;
    if (to.at_infinity) {
        ray = from.spawn(to.wi);
    } else {
        // Between two points, each moved off its surface towards the other: the far one also by the rounding of the direction,
        // which grows with the distance and would else reach below a surface seen at grazing. The last 2^-20 of the way
        // is left out: where the far end is a corner, other surfaces begin there.
        ray.o = offset_ray_origin(from.s.p, from.s.p_error, from.s.ng, to.p - from.s.p);
        Vec3 const rounding = gamma_bound(3) * abs(to.p - ray.o);
        Vec3 const target = offset_ray_origin(to.p, to.p_error + rounding, to.n, ray.o - to.p);
        ray.d = target - ray.o;
        t_max = 1.0f - 0x1p-20f;
    }
    if (!RayCaster::acceptable(ray, t_max)) {
        ++stats.rejected;
        return 0.0f;
    }
    if (stats.recorder) stats.recorder->push_back({ray, t_max, RayKind::Shadow});
    if (caster_->any(ray, t_max)) return 0.0f;
    return parts_->partly ? passing_share(ray, t_max, stats) : 1.0f;
}

/// The product of the shares that partly passing surfaces on the way let through. Chance decides at hits (transport/walk.cpp);
/// here its mean is at hand, which has no noise. Shadows have no footprint: a picture that says how much passes is looked up
/// at its finest. A ray that meets more surfaces than a scene in order has ends in the dark, and so does one that is no ray.
float World::passing_share(Ray ray, float t_max, RayStats& stats) const {
    Vec3 const end = ray.o + ray.d;
    constexpr int kMostSurfaces = 4096;
    float share = 1;
    for (int i = 0; i < kMostSurfaces && share > 0.0f; ++i) {
        if (!RayCaster::acceptable(ray, t_max)) {
            ++stats.rejected;
            return 0.0f;
        }
        ++stats.rays[static_cast<std::size_t>(RayKind::Shadow)];
        RawHit raw;
        if (!caster_->nearest(ray, t_max, raw, RayCaster::seen(Passage::Partly))) return share;
        SurfaceHit hit;
        complete(raw, hit);
        TexturePoint at;
        at.p = hit.s.p;
        at.uv = hit.s.uv;
        share *= interface_share(*assets_, hit.material, at);
        ray = hit.spawn(ray.d);
        if (std::isfinite(t_max)) ray.d = end - ray.o;
    }
    return 0.0f;
}

Spectrum World::emitted(SurfaceHit const& hit, Vec3 w, Wavelengths const& lambda) const {
    if (!hit.emits) return {};
    return emitted(lights_->emitters[parts_->records[hit.record].emitter], hit.s.ng, hit.s.uv, w, lambda);
}

Spectrum World::emitted(Emitter const& e, Vec3 n, Vec2 uv, Vec3 w, Wavelengths const& lambda) const {
    if (!e.light->two_sided && dot(n, w) <= 0.0f) return {};
    Spectrum const radiance = e.radiance.sample(lambda);
    if (!e.light->image.valid()) return radiance;
    Vec3 const rgb = assets_->pyramid(e.light->image).bilerp_rgb(0, {uv.x, 1.0f - uv.y}, Wrap::Clamp);
    return radiance * rgb_to_spectrum(max(rgb, Vec3{0.0f}), SpectrumRole::Unbounded, lambda);
}

Spectrum World::environment(Vec3 w, Wavelengths const& lambda) const {
    Spectrum sum;
    for (LightId const id : lights_->infinite) sum += environment(id, w, lambda);
    return sum;
}
std::vector<LightId> const& World::infinite_lights() const { return lights_->infinite; }
Spectrum World::environment(LightId id, Vec3 w, Wavelengths const& lambda) const {
    return environment_radiance((*scene_)[id], lights_->data[id.value], *assets_, {0, 0, 0}, w, lambda);
}

std::optional<LightSample> World::sample_light(Receiver const& to, LightSampling, double u_choose, Vec2 u,
                                               Wavelengths const& lambda) const {
    Vec3 const p = to.p;
    if (lights_->choice.empty()) return std::nullopt;
    auto const chosen = lights_->choice.sample(u_choose);
    LightEntry const& entry = lights_->entries[chosen.index];
    return entry.record == kNoInstance
               ? sample_light_without_surface(LightId{entry.part}, chosen.pmf, p, u, lambda)
               : sample_area_light(entry, chosen.pmf, p, u, lambda);
}

std::optional<LightSample> World::sample_light_without_surface(LightId id, float pmf, Vec3 p, Vec2 u,
                                                               Wavelengths const& lambda) const {
    auto s = nephroid::sample_light((*scene_)[id], lights_->data[id.value], *assets_, p, u, lambda);
    if (s) s->pdf *= pmf;
    return s;
}

std::optional<LightSample> World::sample_area_light(LightEntry const& entry, float pmf, Vec3 p, Vec2 u,
                                                    Wavelengths const& lambda) const {
    std::optional<LightSample> result;
    Emitter const& emitter = lights_->emitters[parts_->records[entry.record].emitter];
    // A point uniform by area …
    ShapeSample point;
    if (entry.area_pdf > 0.0f) {
        Vec2 const b = square_to_triangle(u);
        point.p = entry.corner + b.x * entry.edge1 + b.y * entry.edge2;
        point.p_error = entry.p_error;
        point.n = entry.normal;
        point.pdf_area = entry.area_pdf;
    } else {
        point = sample_part(parts_->records[entry.record],
                            entry.instance == kNoInstance ? nullptr : &parts_->instances[entry.instance],
                            entry.part, u);
    }
    // … its density turned into solid angle: p_w = p_A r^2 / |cos| (PBRT 4th ed., eq. 4.17).
    Vec3 const to_light = point.p - p;
    float const r2 = length_squared(to_light);
    if (!(r2 > 0.0f)) return result;
    Vec3 const wi = to_light * (1.0f / std::sqrt(r2));
    float const cos_light = abs_dot(point.n, wi);
    float const pdf = pmf * point.pdf_area * r2 / cos_light;
    if (!(cos_light > 0.0f) || !(pdf > 0.0f) || !std::isfinite(pdf)) return result;
    LightSample& s = result.emplace();
    s.wi = wi;
    s.pdf = pdf;
    s.radiance = emitted(emitter, point.n, point.uv, -wi, lambda);
    s.p = point.p;
    s.p_error = point.p_error;
    s.n = point.n;
    return result;
}

float World::light_pdf(SurfaceHit const& hit, Receiver const& to, LightSampling, Vec3 w) const {
    ObjectRecord const& record = parts_->records[hit.record];
    if (!record.emits() || lights_->choice.empty()) return 0.0f;
    InstanceRecord const* instance = hit.instance == kNoInstance ? nullptr : &parts_->instances[hit.instance];
    std::uint32_t const entry = (instance ? instance->first_light : 0) + record.first_light + hit.part;
    float const cos_light = abs_dot(hit.s.ng, w);
    if (!(cos_light > 0.0f)) return 0.0f;
    float const known = lights_->entries[entry].area_pdf;
    float const area_pdf = known > 0.0f ? known : part_pdf(record, instance, hit.part, hit.hit_uv, hit.s.ng);
    return lights_->choice.pmf(entry) * area_pdf * distance_squared(hit.s.p, to.p) / cos_light;
}

float World::infinite_light_pdf(LightId id, Receiver const& to, LightSampling, Vec3 w) const {
    if (lights_->choice.empty()) return 0.0f;
    return lights_->choice.pmf(lights_->entry_of_light[id.value]) *
           environment_pdf((*scene_)[id], lights_->data[id.value], to.p, w);
}

}  // namespace nephroid
