#include "diffuse_lanes.h"

#include "shadow_queue.h"
#include "world/light_lanes.h"

#include <variant>

namespace nephroid {

namespace {

Spectrum reflectance(PathInFlight const& path) {
    return std::get_if<DiffuseBsdf>(&path.v.bsdf)->reflectance;
}
/// cos(theta) / pi where both directions are on one side, else 0.
float density(float cos_wo, float cos_wi) {
    float const pdf = cosine_hemisphere_pdf(std::abs(cos_wi));
    return cos_wo * cos_wi > 0.0f ? pdf : 0.0f;
}

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
    for (std::size_t i = 0; i < paths.size(); ++i) {
        SurfacePoint const& s = paths[i]->v.hit.s;
        p_.set(i, s.p);
        p_error_.set(i, s.p_error);
        ng_.set(i, s.ng);
        ns_.set(i, s.ns);
        cos_wo_[i] = dot(-paths[i]->walk.ray.d, s.ns);
    }
}

void DiffuseLanes::add_direct(bool mis) {
    PathContext const& any = paths_[0]->c;
    ReceiverLanes to;
    Vec2Lanes u;
    for (std::size_t i = 0; i < kLanes; ++i) {
        to.p.set(i, p_[i]);
        to.n.set(i, facing(i));
    }
    for (std::size_t i = 0; i < paths_.size(); ++i) u.set(i, paths_[i]->v.drawn.light);
    LightSampleLanes light;
    any.world.sample_lone_flat_light(to, used(), any.lights, u, light);

    ArrivingLanes arriving;
    for (std::size_t i = 0; i < kLanes; ++i) {
        float const cos_wi = dot(light.wi[i], ns_[i]);
        float const pdf = density(cos_wo_[i], cos_wi);
        float const weight = mis ? power_heuristic(light.pdf[i], pdf) : 1.0f;
        arriving.factor[i] = std::abs(cos_wi) * weight / light.pdf[i];
        arriving.arrives[i] = (light.pdf[i] > 0.0f) & (cos_wo_[i] * cos_wi > 0.0f);
        ShadowRay const s =
            shadow_ray(p_[i], p_error_[i], ng_[i], light.p[i], light.p_error, light.n);
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
        path.c.shadows->wait(path.c.path, path.walk.path_class.ends_after(false),
                             path.walk.beta * (f * arriving.factor[i]),
                             {arriving.rays.ray(i), arriving.rays.t_max[i], arriving.lit[i] != 0},
                             path.walk.vertex);
    }
}

LaneMask DiffuseLanes::scatter() {
    Vec2Lanes u;
    for (std::size_t i = 0; i < paths_.size(); ++i) u.set(i, paths_[i]->v.drawn.direction);
    LeavingLanes leaving;
    for (std::size_t i = 0; i < kLanes; ++i) {
        Vec3 local = square_to_cosine_hemisphere(u[i]);
        local.z = cos_wo_[i] < 0.0f ? -local.z : local.z;
        leaving.pdf[i] = density(cos_wo_[i], local.z);
        leaving.factor[i] = std::abs(local.z) / leaving.pdf[i];
        Vec3 const wi = normalize(frame_from_z(ns_[i]).from_local(local));
        leaving.d.set(i, wi);
        leaving.o.set(i, offset_of_lane(p_[i], p_error_[i], ng_[i], wi));
    }
    LaneMask going = 0;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (!(leaving.pdf[i] > 0.0f)) continue;
        PathInFlight& path = *paths_[i];
        Walk& walk = path.walk;
        // f |cos| / pdf (PBRT 4th ed., eq. 13.8)
        if (!weigh(path.c, walk, reflectance(path) * kInvPi * leaving.factor[i])) continue;
        walk.specular = false;
        walk.pdf = leaving.pdf[i];
        walk.from = {p_[i], facing(i), false};
        walk.cone += path.v.hit.t;
        walk.path_class.scatter(false);
        walk.ray = {leaving.o[i], leaving.d[i]};
        ++walk.vertex;
        going |= 1u << i;
    }
    return going;
}

}  // namespace nephroid
