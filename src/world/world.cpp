#include "world/world.h"

#include "light_table.h"
#include "model/material.h"
#include "ray_caster.h"
#include "scene/match.h"
#include "world_parts.h"

#include <bit>
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

bool World::intersect(Ray const& ray, float t_max, RayKind kind, RayStats& stats, RawHit& hit) const {
    hit.found = false;
    ++stats.rays[static_cast<std::size_t>(kind)];
    if (!RayCaster::acceptable(ray, t_max)) {
        ++stats.rejected;
        return false;
    }
    if (stats.recorder) stats.recorder->push_back({ray, t_max, kind});
    if (caster_->nearest(ray, t_max, hit)) ++stats.hits;
    return hit.found;
}
bool World::intersect(Ray const& ray, float t_max, RayKind kind, RayStats& stats, SurfaceHit& hit) const {
    RawHit raw;
    return intersect(ray, t_max, kind, stats, raw) && surface(raw, hit);
}

namespace {

/// Counts a packet's rays, and says which may be traced.
LaneMask counted(RayPacket const& rays, RayKind kind, RayStats& stats) {
    LaneMask const lanes = RayCaster::acceptable(rays);
    stats.rays[static_cast<std::size_t>(kind)] += static_cast<std::uint64_t>(std::popcount(rays.used));
    stats.rejected += static_cast<std::uint64_t>(std::popcount(rays.used & ~lanes));
    if (stats.recorder) {
        int lane = 0;
        for (std::size_t i = 0; i < kLanes; ++i)
            if ((lanes >> i & 1u) != 0) stats.recorder->push_back({rays.ray(i), rays.t_max[i], kind, lane++});
    }
    return lanes;
}

}  // namespace

void World::intersect(RayPacket const& rays, RayStats& stats, std::array<RawHit, kLanes>& hits) const {
    LaneMask const lanes = counted(rays, RayKind::Camera, stats);
    caster_->nearest(rays, lanes, hits);
    for (RawHit const& hit : hits) stats.hits += static_cast<std::uint64_t>(hit.found);
}

bool World::surface(RawHit const& found, SurfaceHit& hit) const {
    if (found.found) complete(found, hit);
    return found.found;
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
    ShadowRay const shadow = shadow_ray(from, to);
    if (!shadow.lit) return 0.0f;
    if (!RayCaster::acceptable(shadow.ray, shadow.t_max)) {
        ++stats.rejected;
        return 0.0f;
    }
    if (stats.recorder) stats.recorder->push_back({shadow.ray, shadow.t_max, RayKind::Shadow});
    if (caster_->any(shadow.ray, shadow.t_max)) return 0.0f;
    return parts_->partly ? passing_share(shadow.ray, shadow.t_max, stats) : 1.0f;
}

LaneMask World::unoccluded(RayPacket const& rays, RayStats& stats) const {
    LaneMask const lanes = counted(rays, RayKind::Shadow, stats);
    return lanes & ~caster_->any(rays, lanes);
}

bool World::passes_partly() const { return parts_->partly; }

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
