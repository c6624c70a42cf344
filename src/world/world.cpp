#include "world/world.h"

#include "light_table.h"
#include "model/material.h"
#include "ray_caster.h"
#include "scene/match.h"
#include "world_parts.h"

#include <cmath>

namespace nephroid {

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

Object const& World::object_at(SurfaceHit const& hit) const { return *parts_->records[hit.record].object; }

float World::presence(SurfaceHit const& hit) const {
    TextureId const alpha = parts_->records[hit.record].object->alpha;
    if (!alpha.valid()) return 1.0f;
    TexturePoint at;
    at.p = hit.s.p;
    at.uv = hit.s.uv;
    at.n = hit.s.ng;
    float const opacity = evaluate_float(*assets_, alpha, at);
    return opacity > 0.0f && opacity < 1.0f ? opacity : 1.0f;  // it has been met
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
        // What rounding alone lifted out of a lamp's plane sees nothing of the lamp, not even where it is the lamp's own back.
        if (dot(to.n, from.s.p - to.p) * dot(to.n, ray.o - to.p) < 0.0f) return 0.0f;
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

}  // namespace nephroid
