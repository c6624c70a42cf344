#include "diffuse_lanes.h"

#include "shadow_queue.h"
#include "world/ray_packet.h"

#include <array>
#include <cmath>
#include <variant>

namespace nephroid {

namespace {

Spectrum reflectance(PathInFlight const& path) { return std::get_if<DiffuseBsdf>(&path.v.bsdf)->reflectance; }
/// For each lane what is left of f Li |cos| / pdf when the colours are taken out, and the ray on which it comes.
struct ArrivingLanes {
    RayPacket rays;
    FloatLanes factor{};
    std::array<std::uint32_t, kLanes> arrives, lit;
};
/// A ray, its density, and what is left of f |cos| / pdf when the colour is taken out.
struct LeavingLanes {
    Vec3Lanes o, d;
    FloatLanes pdf{}, factor{};
};

}  // namespace

DiffuseLanes::DiffuseLanes(std::span<PathInFlight* const> paths) : paths_(paths) {
    TriangleLanes triangles;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        PathInFlight const& path = *paths[i];
        d_.set(i, path.walk.ray.d);
        if (path.v.mesh)
            triangles.set(i, *path.v.mesh->mesh, path.met.primitive, {path.met.u, path.met.v},
                          path.v.mesh->flip);
    }
    triangles.surfaces(s_);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (paths[i]->v.mesh) continue;
        SurfacePoint const& s = paths[i]->v.hit.s;
        s_.p.set(i, s.p);
        s_.p_error.set(i, s.p_error);
        s_.ng.set(i, s.ng);
        s_.ns.set(i, s.ns);
    }
    for (std::size_t i = 0; i < kLanes; ++i) cos_wo_[i] = dot(-d_[i], s_.ns[i]);
}

void DiffuseLanes::complete_hits() const {
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        SurfacePoint& s = paths_[i]->v.hit.s;
        s.p = s_.p[i];
        s.p_error = s_.p_error[i];
        s.ng = s_.ng[i];
        s.ns = s_.ns[i];
    }
}

void DiffuseLanes::sample_light(Vec2 const* u_light, WaitingReceivers& waiting) {
    PathContext const& any = paths_[0]->c;
    ReceiverLanes to;
    Vec2Lanes u;
    for (std::size_t i = 0; i < kLanes; ++i) {
        to.p.set(i, s_.p[i]);
        to.n.set(i, facing(i));
    }
    for (std::size_t i = 0; i < paths_.size(); ++i) u.set(i, u_light[i]);
    any.world.sample_lone_flat_light(to, used(), any.lights, u, light_, waiting);
}

void DiffuseLanes::add_direct(bool mis) const {
    LightSampleLanes const& light = light_;
    ArrivingLanes arriving;
    for (std::size_t i = 0; i < kLanes; ++i) {
        float const cos_wi = dot(light.wi[i], s_.ns[i]);
        float const pdf = diffuse_pdf(cos_wo_[i], cos_wi);
        float const weight = mis ? power_heuristic(light.pdf[i], pdf) : 1.0f;
        arriving.factor[i] = std::abs(cos_wi) * weight / light.pdf[i];
        arriving.arrives[i] = (light.pdf[i] > 0.0f) & (cos_wo_[i] * cos_wi > 0.0f);
        ShadowRay const s = shadow_ray(s_.p[i], s_.p_error[i], s_.ng[i], light.p[i], light.p_error, light.n);
        arriving.rays.o.set(i, s.ray.o);
        arriving.rays.d.set(i, s.ray.d);
        arriving.rays.t_max[i] = s.t_max;
        arriving.lit[i] = s.lit;
    }
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (arriving.arrives[i] == 0) continue;
        PathInFlight& path = *paths_[i];
        // f Li |cos| / pdf (PBRT 4th ed., eq. 13.6), weighed by MIS.
        Spectrum const f = reflectance(path) * kInvPi * light.radiance->sample(path.c.lambda);
        if (f.is_black()) continue;
        path.c.shadows->wait(
            path.c.path, path.walk.path_class.ends_after(false), path.walk.beta * (f * arriving.factor[i]),
            {arriving.rays.ray(i), arriving.rays.t_max[i], arriving.lit[i] != 0}, path.walk.vertex);
    }
}

LaneMask DiffuseLanes::scatter(Vec2 const* u_direction) const {
    Vec2Lanes u;
    for (std::size_t i = 0; i < paths_.size(); ++i) u.set(i, u_direction[i]);
    Mode const mode = paths_[0]->walk.mode;
    LeavingLanes leaving;
    for (std::size_t i = 0; i < kLanes; ++i) {
        Vec3 local = square_to_cosine_hemisphere(u[i]);
        local.z = cos_wo_[i] < 0.0f ? -local.z : local.z;
        leaving.pdf[i] = diffuse_pdf(cos_wo_[i], local.z);
        Vec3 const wi = normalize(frame_from_z(s_.ns[i]).from_local(local));
        leaving.factor[i] =
            std::abs(local.z) / leaving.pdf[i] * shading_normal_scale(mode, -d_[i], wi, s_.ns[i], s_.ng[i]);
        leaving.d.set(i, wi);
        leaving.o.set(i, offset_of_lane(s_.p[i], s_.p_error[i], s_.ng[i], wi));
    }
    LaneMask going = 0;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (!(leaving.pdf[i] > 0.0f)) continue;
        PathInFlight& path = *paths_[i];
        Walk& walk = path.walk;
        // f |cos| / pdf (PBRT 4th ed., eq. 13.8)
        walk.beta *= reflectance(path) * kInvPi * leaving.factor[i];
        if (!carries_on(path.c, walk)) continue;
        walk.specular = false;
        walk.pdf = leaving.pdf[i];
        walk.from = {s_.p[i], facing(i), false};
        walk.cone += path.v.hit.t;
        walk.path_class.scatter(false);
        walk.ray = {leaving.o[i], leaving.d[i]};
        ++walk.vertex;
        going |= 1u << i;
    }
    return going;
}

}  // namespace nephroid
