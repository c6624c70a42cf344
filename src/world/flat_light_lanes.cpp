// The light of many a room, a flat one all by itself: drawn for eight receivers at once. Each gets the very sample that
// World::sample_light() would give it (emitter_sampling.cpp, FlatEmitter); the loops are over the functions that are used there, and the
// compiler makes one instruction of eight.
#include "emitter_sampling.h"
#include "lambert_ray.h"
#include "sampling/spherical_rectangle.h"
#include "sampling/warp.h"
#include "seen_flat.h"
#include "world/world.h"
#include "world_parts.h"

namespace nephroid {

namespace {

/// For those that see it at an angle where it is drawn by area, bent or not; of the others, which are `near`, the point has no meaning.
void draw_by_area(LightEntry const& __restrict e, ReceiverLanes const& __restrict to, bool by_view,
                  Vec2Lanes const& __restrict u, LightSampleLanes& __restrict drawn,
                  std::array<std::uint32_t, kLanes>& __restrict near) {
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
        drawn.p.set(i, p);
        drawn.wi.set(i, wi);
        drawn.pdf[i] = (r2 > 0.0f) & (cosine > 0.0f) & (pdf < kInfinity) ? pdf : 0.0f;
        near[i] = static_cast<std::uint32_t>(view == FlatView::Near);
    }
}

/// Receivers that see it at an angle so wide that its solid angle is drawn: FlatEmitter's draw_seen() for rectangles. In three loops,
/// since doubles and floats in one would not be made wide.
void draw_by_solid_angle(LightEntry const& __restrict e, ReceiverLanes const& __restrict to,
                         Vec2Lanes const& __restrict u, LightSampleLanes& __restrict drawn) {
    RectangleAxes const axes = rectangle_axes(e.edge1, e.edge2);
    Vec3Lanes corners;
    Vec2Lanes bent;
    FloatLanes bent_pdf;
    for (std::size_t i = 0; i < kLanes; ++i) {
        Receiver const r{to.p[i], to.n[i], false};
        Vec3 const corner = e.corner - r.p;
        BentByCosine const square(square_corners(e, corner), r, u[i]);
        corners.set(i, corner);
        bent.set(i, square.u);
        bent_pdf[i] = square.pdf;
    }
    Vec2Lanes st;
    FloatLanes solid_angle;
    for (std::size_t i = 0; i < kLanes; ++i) {
        SphericalRectangle const map(axes, corners[i]);
        st.set(i, map.sample(bent[i]));
        solid_angle[i] = map.solid_angle();
    }
    for (std::size_t i = 0; i < kLanes; ++i) {
        Vec3 const p = flat_point(e, st[i]);
        Vec3 const way = p - to.p[i];
        float const r2 = length_squared(way);
        float const pdf = 1.0f / solid_angle[i] * bent_pdf[i];
        drawn.p.set(i, p);
        drawn.wi.set(i, way * (1.0f / std::sqrt(r2)));
        drawn.pdf[i] = (r2 > 0.0f) & (solid_angle[i] > 0.0f) & (pdf < kInfinity) ? pdf : 0.0f;
    }
}

/// Only one side shines.
void keep_before(LightEntry const& e, LightSampleLanes& sample) {
    for (std::size_t i = 0; i < kLanes; ++i)
        sample.pdf[i] = dot(e.normal, sample.wi[i]) < 0.0f ? sample.pdf[i] : 0.0f;
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
                                   Vec2Lanes const& u, LightSampleLanes& sample,
                                   WaitingReceivers& waiting) const {
    LightEntry const& e = lights_->entries.front();
    Emitter const& emitter = lights_->emitters[e.emitter];
    std::array<std::uint32_t, kLanes> near;
    draw_by_area(e, to, how.shapes == ShapeSampling::SolidAngle, u, sample, near);
    sample.p_error = e.p_error;
    sample.n = e.normal;
    sample.radiance = &emitter.radiance;
    for (std::size_t i = 0; i < kLanes; ++i) {
        if ((used >> i & 1u) == 0 || near[i] == 0) continue;
        if (e.shape == LightShape::Rectangle) {
            waiting.to.p.set(waiting.count, to.p[i]);
            waiting.to.n.set(waiting.count, to.n[i]);
            waiting.u.set(waiting.count, u[i]);
            waiting.places[waiting.count] = {&sample, i};
            if (++waiting.count == kLanes) sample_waiting(waiting);
            continue;
        }
        LightSample one;
        bool const seen =
            sample_emitter(*lights_, *parts_, e, {to.p[i], to.n[i], false}, how.shapes, u[i], one);
        sample.p.set(i, one.p);
        sample.wi.set(i, one.wi);
        sample.pdf[i] = seen ? one.pdf : 0.0f;
    }
    if (!emitter.two_sided) keep_before(e, sample);
}

void World::sample_waiting(WaitingReceivers& waiting) const {
    if (waiting.count == 0) return;
    LightEntry const& e = lights_->entries.front();
    LightSampleLanes drawn;
    draw_by_solid_angle(e, waiting.to, waiting.u, drawn);
    if (!lights_->emitters[e.emitter].two_sided) keep_before(e, drawn);
    for (std::size_t i = 0; i < waiting.count; ++i) {
        auto const [samples, lane] = waiting.places[i];
        samples->p.set(lane, drawn.p[i]);
        samples->wi.set(lane, drawn.wi[i]);
        samples->pdf[lane] = drawn.pdf[i];
    }
    waiting.count = 0;
}

}  // namespace nephroid
