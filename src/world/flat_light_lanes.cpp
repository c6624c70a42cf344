// The light of many a room, a flat one all by itself: drawn for eight receivers at once. Each gets the very sample that
// World::sample_light() would give it (emitter_sampling.cpp, FlatEmitter); the loops are over the functions that are used there, and the
// compiler makes one instruction of eight.
#include "emitter_sampling.h"
#include "lambert_ray.h"
#include "sampling/warp.h"
#include "seen_flat.h"
#include "world/world.h"
#include "world_parts.h"

namespace nephroid {

namespace {

/// Those that see it at an angle where it is drawn by area, bent or not; of the others the point has no meaning.
struct DrawnByArea {
    LightSampleLanes sample;
    std::array<std::uint32_t, kLanes> near;
};

void draw_by_area(LightEntry const& __restrict e, ReceiverLanes const& __restrict to, bool by_view,
                  Vec2Lanes const& __restrict u, DrawnByArea& __restrict drawn) {
    float const last = last_corner(e);
    float const area_pdf = e.area_pdf;
    for (std::size_t i = 0; i < kLanes; ++i) {
        Receiver const r{to.p[i], to.n[i], false};
        FlatView const seen = view_of(e, r);
        FlatView const view = by_view ? seen : FlatView::Far;
        SeenCorner<float> const a(e, r, 0, 0);
        SeenCorner<float> const b(e, r, 1, 0);
        SeenCorner<float> const c(e, r, 0, 1);
        SeenCorner<float> const d(e, r, last, last);
        float const unit = 1.0f / a.r2;
        auto const weights =
            with_floor(a.weight(r, unit), b.weight(r, unit), c.weight(r, unit), d.weight(r, unit));
        Vec2 const bent = sample_bilinear(u[i], weights.data());
        bool const between = view == FlatView::Between;
        float const square_pdf = between ? bilinear_pdf(bent, weights.data()) : 1.0f;
        Vec2 const square{between ? bent.x : u.x[i], between ? bent.y : u.y[i]};
        Vec3 const p = area_point(e, square);
        Vec3 const way = p - r.p;
        float const r2 = length_squared(way);
        Vec3 const wi = way * (1.0f / std::sqrt(r2));
        float const cosine = abs_dot(e.normal, wi);
        float const pdf = square_pdf * area_pdf * r2 / cosine;
        drawn.sample.p.set(i, p);
        drawn.sample.wi.set(i, wi);
        drawn.sample.pdf[i] = (r2 > 0.0f) & (cosine > 0.0f) & (pdf < kInfinity) ? pdf : 0.0f;
        drawn.near[i] = static_cast<std::uint32_t>(view == FlatView::Near);
    }
}

/// aimed_emission.cpp, emit_from_surface, where nothing is aimed at. `choice`: the probability of having chosen the light.
void emit_by_area(LightEntry const& __restrict e, bool two_sided, float choice,
                  Vec2Lanes const& __restrict u_position, Vec2Lanes const& __restrict u_direction,
                  EmittedLanes& __restrict emitted) {
    float const area_pdf = e.area_pdf;
    for (std::size_t i = 0; i < kLanes; ++i) {
        Vec3 const p = area_point(e, u_position[i]);
        LambertRay const ray(e.normal, two_sided, u_direction[i]);
        emitted.o.set(i, offset_of_lane(p, e.p_error, ray.n, ray.d));
        emitted.d.set(i, ray.d);
        emitted.pdf[i] = ray.pdf;
        emitted.per_radiance[i] = abs_dot(ray.n, ray.d) / (area_pdf * ray.pdf * choice);
    }
}

}  // namespace

void World::emit_lone_flat_light(Vec2Lanes const& u_position, Vec2Lanes const& u_direction,
                                 EmittedLanes& emitted) const {
    LightEntry const& e = lights_->entries.front();
    Emitter const& emitter = lights_->emitters[e.emitter];
    emit_by_area(e, emitter.two_sided, lights_->by_power.pmf(0), u_position, u_direction, emitted);
    emitted.radiance = &emitter.radiance;
}

bool World::has_lone_flat_light() const { return lights_->lone_flat(); }

void World::sample_lone_flat_light(ReceiverLanes const& to, LaneMask used, LightSampling how,
                                   Vec2Lanes const& u, LightSampleLanes& sample) const {
    LightEntry const& e = lights_->entries.front();
    Emitter const& emitter = lights_->emitters[e.emitter];
    DrawnByArea drawn;
    draw_by_area(e, to, how.shapes == ShapeSampling::SolidAngle, u, drawn);
    sample = drawn.sample;
    sample.p_error = e.p_error;
    sample.n = e.normal;
    sample.radiance = &emitter.radiance;
    for (std::size_t i = 0; i < kLanes; ++i) {
        if ((used >> i & 1u) == 0 || drawn.near[i] == 0) continue;
        LightSample near;
        bool const seen =
            sample_emitter(*lights_, *parts_, e, {to.p[i], to.n[i], false}, how.shapes, u[i], near);
        sample.p.set(i, near.p);
        sample.wi.set(i, near.wi);
        sample.pdf[i] = seen ? near.pdf : 0.0f;
    }
    if (emitter.two_sided) return;
    for (std::size_t i = 0; i < kLanes; ++i)
        sample.pdf[i] = dot(e.normal, sample.wi[i]) < 0.0f ? sample.pdf[i] : 0.0f;
}

}  // namespace nephroid
