// Light on its way, of a given light and towards a given ball: World::emit, World::aimed_density.
//
// Where the light is a point or a surface, the position is drawn as ever and the direction within the cone that the ball
// subtends from there; light from infinity keeps its direction and is sent through the ball's projection instead.
#include "emission.h"
#include "emitter_sampling.h"
#include "lambert_ray.h"
#include "light_table.h"
#include "sampling/warp.h"
#include "world/world.h"
#include "world_parts.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// The cone in which a point sees a ball.
struct Cone {
    Vec3 axis{0, 0, 1};
    float one_minus_cos = 0;
};
/// Nothing from inside, or from so near that the cone is wider than `least_cos`.
std::optional<Cone> cone_of(BoundingSphere const& ball, Vec3 from, float least_cos) {
    std::optional<Cone> result;
    Vec3 const to = ball.centre - from;
    float const d2 = length_squared(to), sin2 = sqr(ball.radius) / d2;
    if (!(sin2 <= 1.0f - sqr(least_cos))) return result;
    float const cosine = safe_sqrt(1.0f - sin2);
    result.emplace(Cone{to / std::sqrt(d2), sin2 / (1.0f + cosine)});
    return result;
}
/// Does the ray meet the ball, whose centre it goes towards?
bool meets(BoundingSphere const& ball, Vec3 from, Vec3 w) {
    Vec3 const to = ball.centre - from;
    return dot(to, w) > 0.0f && length_squared(cross(to, w)) <= sqr(ball.radius);
}
/// From a surface, wider cones than this give way to the cosine.
constexpr float kNearCos = 0.707f;

/// By solid angle, of a ray that leaves a surface.
float density_from_surface(EmissionSample const& e, BoundingSphere const* ball, bool two_sided) {
    if (ball)
        if (auto const cone = cone_of(*ball, e.ray.o, kNearCos))
            return meets(*ball, e.ray.o, e.ray.d) ? uniform_cone_pdf(cone->one_minus_cos) : 0.0f;
    return lambert_density(dot(e.n, e.ray.d), two_sided);
}

}  // namespace

std::optional<LightRay> World::emit(std::uint32_t light, BoundingSphere const* ball, Vec2 u_position,
                                    Vec2 u_direction, Wavelengths const& lambda) const {
    LightEntry const& entry = lights_->entries[light];
    return entry.shape == LightShape::NoSurface
               ? emit_without_surface(light, ball, u_position, u_direction, lambda)
               : emit_from_surface(light, ball, u_position, u_direction, lambda);
}

std::optional<LightRay> World::emit_without_surface(std::uint32_t light, BoundingSphere const* ball,
                                                    Vec2 u_position, Vec2 u_direction,
                                                    Wavelengths const& lambda) const {
    std::optional<LightRay> result;
    LightId const id{lights_->entries[light].part};
    Light const& source = (*scene_)[id];
    LightData const& data = lights_->data[id.value];
    BoundingSphere const scene = bounding_sphere(bounds_);
    if (ball && !lights_->entries[light].boundless) {
        // At a point: whatever its own way of drawing directions is, it knows what it sends along this one.
        auto const cone = cone_of(*ball, data.position, 0.0f);
        if (!cone) return result;
        Vec3 const w = normalize(
            frame_from_z(cone->axis).from_local(square_to_uniform_cone(u_direction, cone->one_minus_cos)));
        // From as far away as keeps the direction's digits.
        float const away = max_component(abs(data.position));
        float const r = away > 0.0f ? away : 1.0f;
        auto const s =
            nephroid::sample_light(source, data, *assets_, data.position + r * w, u_position, lambda);
        if (!s) return result;
        LightRay& ray = result.emplace();
        ray.emission.ray = {data.position, w};
        ray.emission.radiance = s->radiance * sqr(r);
        ray.emission.pdf_direction = uniform_cone_pdf(cone->one_minus_cos);
        ray.emission.delta_position = true;
        ray.light = light;
        ray.choice = 1;
        return result;
    }
    auto const e = nephroid::sample_emission(source, data, *assets_, scene, u_position, u_direction, lambda);
    if (!e) return result;
    LightRay& r = result.emplace(LightRay{*e, light, 1.0f});
    if (!ball) return result;
    Vec3 const back = -r.emission.ray.d;
    Vec2 const disk = square_to_disk(u_position);
    Vec3 const p = ball->centre + ball->radius * frame_from_z(back).from_local({disk.x, disk.y, 0.0f});
    // Light that comes through a portal comes through nothing else.
    if (!(nephroid::emission_density(source, data, scene, p, -back).position > 0.0f)) {
        result.reset();
        return result;
    }
    r.emission.ray.o = p + (scene.radius - dot(p - scene.centre, back)) * back;
    r.emission.pdf_position = 1.0f / (kPi * sqr(ball->radius));
    return result;
}

std::optional<LightRay> World::emit_from_surface(std::uint32_t light, BoundingSphere const* ball,
                                                 Vec2 u_position, Vec2 u_direction,
                                                 Wavelengths const& lambda) const {
    std::optional<LightRay> result;
    LightEntry const& entry = lights_->entries[light];
    Emitter const& emitter = lights_->emitters[parts_->records[entry.record].emitter];
    bool const two_sided = emitter.two_sided;
    LightSample point;
    float const area_pdf = sample_emitter_area(*lights_, *parts_, entry, u_position, point);
    if (!(area_pdf > 0.0f) || !std::isfinite(area_pdf)) return result;
    LightRay r;
    EmissionSample& e = r.emission;
    e.n = point.n;
    e.ray.o = point.p;
    if (auto const cone = ball ? cone_of(*ball, point.p, kNearCos) : std::nullopt) {
        e.ray.d = normalize(
            frame_from_z(cone->axis).from_local(square_to_uniform_cone(u_direction, cone->one_minus_cos)));
        if (two_sided) e.n = face_forward(e.n, e.ray.d);
        if (!(dot(e.n, e.ray.d) > 0.0f)) return result;
        e.pdf_direction = uniform_cone_pdf(cone->one_minus_cos);
    } else {
        LambertRay const lambert(e.n, two_sided, u_direction);
        e.n = lambert.n;
        e.ray.d = lambert.d;
        e.pdf_direction = lambert.pdf;
        if (!(e.pdf_direction > 0.0f)) return result;
    }
    e.p_error = point.p_error;
    e.radiance = emission_at(*assets_, emitter, point.p, point.uv, lambda) *
                 opacity(*assets_, emitter, point.p, point.uv);
    e.pdf_position = area_pdf;
    r.light = light;
    r.choice = 1;
    r.side = two_sided ? 0.5f : 1.0f;
    r.unseen = emitter.unseen;
    result.emplace(r);
    return result;
}

float World::aimed_density(LightRay const& ray, BoundingSphere const* ball) const {
    LightEntry const& entry = lights_->entries[ray.light];
    EmissionSample const& e = ray.emission;
    if (entry.shape != LightShape::NoSurface)
        return density_from_surface(e, ball,
                                    lights_->emitters[parts_->records[entry.record].emitter].two_sided);
    LightId const id{entry.part};
    if (!ball) {
        EmissionDensity const d = nephroid::emission_density((*scene_)[id], lights_->data[id.value],
                                                             bounding_sphere(bounds_), e.ray.o, e.ray.d);
        return entry.boundless ? d.position : d.direction;
    }
    if (entry.boundless) {
        float const across2 = length_squared(cross(ball->centre - e.ray.o, e.ray.d));
        return across2 <= sqr(ball->radius) ? 1.0f / (kPi * sqr(ball->radius)) : 0.0f;
    }
    auto const cone = cone_of(*ball, e.ray.o, 0.0f);
    return cone && meets(*ball, e.ray.o, e.ray.d) ? uniform_cone_pdf(cone->one_minus_cos) : 0.0f;
}

bool World::is_boundless(std::uint32_t light) const { return lights_->entries[light].boundless; }
bool World::has_surface(std::uint32_t light) const {
    return lights_->entries[light].shape != LightShape::NoSurface;
}
float World::power_of(std::uint32_t light) const {
    return lights_->by_power.empty() ? 0.0f : lights_->by_power.pmf(light) * lights_->total_power;
}

bool World::may_reach(std::uint32_t light, BoundingSphere const& ball) const {
    LightEntry const& e = lights_->entries[light];
    switch (e.shape) {
        case LightShape::Triangle:
        case LightShape::Rectangle:
        case LightShape::Parallelogram: {
            if (lights_->emitters[parts_->records[e.record].emitter].two_sided) return true;
            float const slack = 1e-3f * ball.radius + 1e-6f * length(ball.centre - e.corner);
            return dot(e.normal, ball.centre - e.corner) + ball.radius + slack > 0.0f;
        }
        case LightShape::NoSurface: {
            LightId const id{e.part};
            LightData const& data = lights_->data[id.value];
            auto const b = nephroid::light_bounds((*scene_)[id], data, *assets_);
            if (!b) return true;
            Vec3 const to = ball.centre - data.position;
            float const d = length(to);
            if (!(d > ball.radius)) return true;
            float const angle = std::acos(clamp(dot(to, b->axis) / d, -1.0f, 1.0f));
            float const widest = std::acos(clamp(b->cos_normals, -1.0f, 1.0f)) +
                                 std::acos(clamp(b->cos_emission, -1.0f, 1.0f));
            return angle - std::asin(min(1.0f, ball.radius / d)) <= widest + 1e-3f;
        }
        default:
            return true;
    }
}

}  // namespace nephroid
