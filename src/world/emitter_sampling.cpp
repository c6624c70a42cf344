#include "emitter_sampling.h"

#include "model/solid_angle.h"
#include "sampling/warp.h"
#include "scene/match.h"
#include "seen_box.h"
#include "seen_flat.h"

#include <cmath>

namespace nephroid {

namespace {

/// p_w = p_A r^2 / |cos| (PBRT 4th ed., eq. 4.17).
float by_solid_angle(float area_pdf, float distance2, float cosine) {
    return cosine > 0.0f ? area_pdf * distance2 / cosine : 0.0f;
}
float by_solid_angle(float area_pdf, Vec3 from, Vec3 p, Vec3 n, Vec3 w) {
    return by_solid_angle(area_pdf, distance_squared(p, from), abs_dot(n, w));
}

/// The way from the receiver to the point of the sample.
struct Way {
    float distance2;
    float cosine;  // at the emitter
};
/// Sets the direction. The distance is 0 where the point is the receiver itself.
Way aim(Receiver const& to, LightSample& s) {
    Vec3 const d = s.p - to.p;
    float const r2 = length_squared(d);
    Vec3 const wi = d * (1.0f / std::sqrt(r2));
    s.wi = wi;
    return {r2, abs_dot(s.n, wi)};
}

/// Rounding may carry a point over its part's edge, where a density over the square would be 0.
Vec2 within_square(Vec2 u) { return {clamp(u.x, 0.0f, 1.0f), clamp(u.y, 0.0f, 1.0f)}; }

// Three ways to be an emitter. Each has
//   draw_by_area(square, s)     a point by the part's area sampler; returns its density by area
//   square(p), area_pdf(p, n)   the other way round, for points that were drawn otherwise …
//   square(hit), area_pdf(hit)  … and for points that a ray has found
//   has_view, and where that is true draw_seen(u, s), which sets s.pdf, and seen_pdf(p, w): by what the receiver sees

/// Corner and edges in the entry itself.
struct FlatEmitter {
    LightEntry const& e;
    LightPicture const* picture;
    Receiver const& to;
    FlatView view = FlatView::Far;
    bool has_view;

    FlatEmitter(LightTable const& lights, LightEntry const& entry, Receiver const& receiver,
                ShapeSampling how)
        : e(entry),
          picture(entry.picture == LightEntry::kNone ? nullptr : &lights.pictures[entry.picture]),
          to(receiver),
          view(how == ShapeSampling::SolidAngle ? view_of(entry, receiver) : FlatView::Far),
          has_view(view != FlatView::Far) {}

    void put(Vec2 st, LightSample& s) const {
        s.p = flat_point(e, st);
        s.p_error = e.p_error;
        s.n = e.normal;
        if (picture) s.uv = picture->uv + st.x * picture->duv1 + st.y * picture->duv2;
    }
    float draw_by_area(Vec2 square, LightSample& s) const {
        put(area_coordinates(e, square), s);
        return e.area_pdf;
    }
    [[nodiscard]] Vec2 square(Vec3 p) const {
        Vec2 const st = coordinates(e, p);
        return e.shape == LightShape::Triangle ? within_square(triangle_to_square(st)) : st;
    }
    [[nodiscard]] float area_pdf(Vec3, Vec3) const { return e.area_pdf; }
    [[nodiscard]] Vec2 square(SurfaceHit const& hit) const { return square(hit.s.p); }
    [[nodiscard]] float area_pdf(SurfaceHit const&) const { return e.area_pdf; }
    bool draw_seen(Vec2 u, LightSample& s) const {
        if (view == FlatView::Between) {
            float square_pdf = 0;
            float const by_area = draw_by_area(bend_square(e, to, u, square_pdf), s);
            Way const way = aim(to, s);
            s.pdf = by_solid_angle(square_pdf * by_area, way.distance2, way.cosine);
            return way.distance2 > 0.0f;
        }
        Vec2 st;
        if (!sample_near_flat(e, to, u, st, s.pdf)) return false;
        put(st, s);
        return aim(to, s).distance2 > 0.0f;
    }
    [[nodiscard]] float seen_pdf(Vec3 p, Vec3 w) const {
        return view == FlatView::Near
                   ? near_flat_pdf(e, to, p)
                   : by_solid_angle(e.area_pdf * bent_square_pdf(e, to, square(p)), to.p, p, e.normal, w);
    }
};

/// What parts share that have no place of their own in the entry.
struct PartOfRecord {
    LightEntry const& e;
    ObjectRecord const& record;
    InstanceRecord const* instance;

    PartOfRecord(WorldParts const& parts, LightEntry const& entry)
        : e(entry),
          record(parts.records[entry.record]),
          instance(entry.instance == kNoInstance ? nullptr : &parts.instances[entry.instance]) {}

    float draw_by_area(Vec2 square, LightSample& s) const {
        ShapeSample const point = sample_part(record, instance, e.part, square);
        s.p = point.p, s.p_error = point.p_error, s.n = point.n, s.uv = point.uv;
        return point.pdf_area;
    }
    [[nodiscard]] float area_pdf(SurfaceHit const& hit) const {
        return part_pdf(record, instance, e.part, hit.hit_uv, hit.s.ng);
    }
};

/// A sphere, cylinder or disk, seen in its own space; directions change their density on the way to the world.
template <class S>
struct RoundEmitter : PartOfRecord {
    S const& shape;
    LightPlace const& place;
    Receiver const& to;
    decltype(seen(std::declval<S const&>(), Vec3{}, EmittingSides::Front)) view;
    bool has_view = false;

    RoundEmitter(S const& s, LightTable const& lights, WorldParts const& parts, LightEntry const& entry,
                 Receiver const& receiver, ShapeSampling how)
        : PartOfRecord(parts, entry), shape(s), place(lights.places[entry.more]), to(receiver) {
        if (how != ShapeSampling::SolidAngle) return;
        bool const two_sided = lights.emitters[e.emitter].two_sided;
        view = seen(shape, place.to_shape.point(to.p),
                    two_sided     ? EmittingSides::Both
                    : record.flip ? EmittingSides::Back
                                  : EmittingSides::Front);
        has_view = view.has_value();
    }

    using PartOfRecord::area_pdf;
    [[nodiscard]] Vec2 square(Vec3 p) const {
        Vec3 const local = place.to_shape.point(p);
        return invert_area(shape, 0, local, surface(shape, {}, local).uv).value_or(Vec2{0, 0});
    }
    [[nodiscard]] float area_pdf(Vec3, Vec3 n) const { return part_pdf(record, instance, e.part, {0, 0}, n); }
    [[nodiscard]] Vec2 square(SurfaceHit const& hit) const { return square(hit.s.p); }
    bool draw_seen(Vec2 u, LightSample& s) const {
        SeenSample local;
        if (!view->sample(u, local)) return false;
        s.p = place.to_world.point(local.p);
        s.p_error = error_of(local);
        // Normals keep their side, whether the map mirrors or not (model/surface.h).
        Vec3 const n = normalize(place.to_world.area_vector(local.n));
        s.n = (place.to_world.determinant() < 0.0f) != record.flip ? -n : n;
        s.uv = local.uv;
        if (!(aim(to, s).distance2 > 0.0f)) return false;
        s.pdf = local.pdf * density(s.wi);
        return true;
    }
    [[nodiscard]] float seen_pdf(Vec3 p, Vec3 w) const {
        return view->pdf(place.to_shape.point(p)) * density(w);
    }

  private:
    /// The bound of each map on the way to the world, not that of their product: what cancels in that does not in a ray's trip.
    [[nodiscard]] Vec3 error_of(SeenSample const& local) const {
        if (!instance) return place.to_world.point_error(local.p, local.p_error);
        ShapeSample s;
        s.p = local.p, s.p_error = local.p_error, s.n = local.n;
        if (record.place) s = transformed(record.place->shape_to_group, s);
        return transformed(instance->to_world, s).p_error;
    }
    /// d(directions in the shape's space) / d(directions in the world).
    [[nodiscard]] float density(Vec3 w) const {
        if (place.direction_scale == 0.0f) return 1.0f;
        return direction_density(place.direction_scale,
                                 place.to_world.vector(normalize(place.to_shape.vector(w))));
    }
};

/// Anything else: a bilinear patch, a triangle whose side changes. By area alone.
struct PartEmitter : PartOfRecord {
    static constexpr bool has_view = false;
    using PartOfRecord::area_pdf;
    using PartOfRecord::PartOfRecord;
    [[nodiscard]] Vec2 square(SurfaceHit const& hit) const {
        return within_square(std::holds_alternative<TriangleMesh>(record.object->shape)
                                 ? triangle_to_square(hit.hit_uv)
                                 : hit.hit_uv);
    }
    // Never asked for: nothing is drawn but by area.
    [[nodiscard]] static Vec2 square(Vec3) { return {0, 0}; }
    [[nodiscard]] static float area_pdf(Vec3, Vec3) { return 0.0f; }
    static bool draw_seen(Vec2, LightSample&) { return false; }
    [[nodiscard]] static float seen_pdf(Vec3, Vec3) { return 0.0f; }
};

/// The share of samples that a picture's bright places get; the rest is spread over what is seen. One sample of two strategies
/// with the balance heuristic (Veach 1997, 9.2.4): the density is the sum of theirs.
constexpr float kPictureShare = 0.5f;

Distribution2D const* picture_of(LightTable const& lights, LightEntry const& e, ShapeSampling how) {
    if (e.picture == LightEntry::kNone || how != ShapeSampling::SolidAngle) return nullptr;
    Distribution2D const& d = lights.pictures[e.picture].distribution;
    return d.empty() ? nullptr : &d;
}

template <class Emitting>
[[gnu::always_inline]] inline bool sample(Emitting const& emitter, Distribution2D const* picture,
                                          Receiver const& to, Vec2 u, LightSample& s) {
    bool const by_picture = picture && u.x < kPictureShare;
    if (picture)
        u.x = min(by_picture ? u.x / kPictureShare : (u.x - kPictureShare) / (1.0f - kPictureShare),
                  kOneMinusEpsilon);
    Vec2 square = u;
    float area_pdf = 0;
    if (by_picture || !emitter.has_view) {
        if (by_picture) square = picture->sample(u);
        area_pdf = emitter.draw_by_area(square, s);
        Way const way = aim(to, s);
        if (!(way.distance2 > 0.0f)) return false;
        s.pdf = emitter.has_view ? emitter.seen_pdf(s.p, s.wi)
                                 : by_solid_angle(area_pdf, way.distance2, way.cosine);
    } else {
        if (!emitter.draw_seen(u, s)) return false;
        if (picture) square = emitter.square(s.p), area_pdf = emitter.area_pdf(s.p, s.n);
    }
    if (picture)
        s.pdf =
            lerp(kPictureShare, s.pdf, by_solid_angle(picture->pdf(square) * area_pdf, to.p, s.p, s.n, s.wi));
    return s.pdf > 0.0f && std::isfinite(s.pdf);
}

template <class Emitting>
float pdf(Emitting const& emitter, Distribution2D const* picture, Receiver const& to, SurfaceHit const& hit,
          Vec3 w) {
    auto const by_area = [&](float level) {
        return by_solid_angle(level * emitter.area_pdf(hit), to.p, hit.s.p, hit.s.ng, w);
    };
    float const seen = emitter.has_view ? emitter.seen_pdf(hit.s.p, w) : by_area(1);
    return picture ? lerp(kPictureShare, seen, by_area(picture->pdf(emitter.square(hit)))) : seen;
}

/// The same for points that are drawn by area: a picture covers all that is bright, but for what falls between its cells.
constexpr float kPictureShareByArea = 0.875f;

/// A face by area, and a point of it uniformly.
float sample_box_area(BoxLight const& box, Vec2 u, LightSample& s) {
    float const half = box.area[0] + box.area[1] + box.area[2];
    float left = u.x * 2.0f * half;
    std::uint32_t face = 0;
    while (face < 5 && left >= box.area[face / 2]) left -= box.area[face++ / 2];
    std::size_t const axis = face / 2;
    bool const far_end = face % 2 != 0;
    u.x = clamp(left / box.area[axis], 0.0f, kOneMinusEpsilon);
    s.p = box.corner + u.x * box.edge[(axis + 1) % 3] + u.y * box.edge[(axis + 2) % 3];
    if (far_end) s.p += box.edge[axis];
    s.p_error = box.p_error;
    s.n = far_end == box.inwards ? -box.out[axis] : box.out[axis];
    return 0.5f / half;
}

/// f(how the entry is an emitter).
template <class F>
auto with_emitter(LightTable const& lights, WorldParts const& parts, LightEntry const& e, Receiver const& to,
                  ShapeSampling how, F const& f) {
    switch (e.shape) {
        case LightShape::Triangle:
        case LightShape::Rectangle:
        case LightShape::Parallelogram:
            return f(FlatEmitter(lights, e, to, how));
        case LightShape::Analytic: {
            Shape const& shape = parts.records[e.record].object->shape;
            if (auto const* sphere = std::get_if<Sphere>(&shape))
                return f(RoundEmitter<Sphere>(*sphere, lights, parts, e, to, how));
            if (auto const* cylinder = std::get_if<Cylinder>(&shape))
                return f(RoundEmitter<Cylinder>(*cylinder, lights, parts, e, to, how));
            return f(RoundEmitter<Disk>(std::get<Disk>(shape), lights, parts, e, to, how));
        }
        default:
            return f(PartEmitter(parts, e));
    }
}

SeenBox seen_box(LightTable const& lights, LightEntry const& e, Receiver const& to, ShapeSampling how) {
    return SeenBox(lights.boxes[e.more], to, how, lights.emitters[e.emitter].two_sided);
}

/// Any but those that sample_emitter draws itself. Out of line: its frame is large.
[[gnu::noinline]] bool sample_any(LightTable const& lights, WorldParts const& parts, LightEntry const& e,
                                  Receiver const& to, ShapeSampling how, Vec2 u, LightSample& s) {
    if (e.shape == LightShape::Box) return seen_box(lights, e, to, how).sample(u, s);
    Distribution2D const* picture = picture_of(lights, e, how);
    return with_emitter(lights, parts, e, to, how,
                        [&](auto const& emitter) { return sample(emitter, picture, to, u, s); });
}

}  // namespace

bool sample_emitter(LightTable const& lights, WorldParts const& parts, LightEntry const& e,
                    Receiver const& to, ShapeSampling how, Vec2 u, LightSample& s) {
    if (e.flat() && e.picture == LightEntry::kNone)
        return sample(FlatEmitter(lights, e, to, how), nullptr, to, u, s);
    return sample_any(lights, parts, e, to, how, u, s);
}

float emitter_pdf(LightTable const& lights, WorldParts const& parts, LightEntry const& e, Receiver const& to,
                  ShapeSampling how, SurfaceHit const& hit, Vec3 w) {
    if (e.shape == LightShape::Box) return seen_box(lights, e, to, how).pdf(hit.part, hit.s.p, w);
    Distribution2D const* picture = picture_of(lights, e, how);
    return with_emitter(lights, parts, e, to, how,
                        [&](auto const& emitter) { return pdf(emitter, picture, to, hit, w); });
}

float sample_emitter_area(LightTable const& lights, WorldParts const& parts, LightEntry const& e, Vec2 u,
                          LightSample& s) {
    if (e.shape == LightShape::Box) return sample_box_area(lights.boxes[e.more], u, s);
    Distribution2D const* picture = picture_of(lights, e, ShapeSampling::SolidAngle);
    return with_emitter(lights, parts, e, {}, ShapeSampling::Area, [&](auto const& emitter) {
        if (!picture) return emitter.draw_by_area(u, s);
        bool const by_picture = u.x < kPictureShareByArea;
        u.x = min(by_picture ? u.x / kPictureShareByArea
                             : (u.x - kPictureShareByArea) / (1.0f - kPictureShareByArea),
                  kOneMinusEpsilon);
        if (by_picture) u = picture->sample(u);
        return emitter.draw_by_area(u, s) * lerp(kPictureShareByArea, 1.0f, picture->pdf(u));
    });
}

float emitter_area_pdf(LightTable const& lights, WorldParts const& parts, LightEntry const& e,
                       SurfaceHit const& hit) {
    if (e.shape == LightShape::Box) return e.area_pdf;
    Distribution2D const* picture = picture_of(lights, e, ShapeSampling::SolidAngle);
    return with_emitter(lights, parts, e, {}, ShapeSampling::Area, [&](auto const& emitter) {
        float const uniform = emitter.area_pdf(hit);
        return picture ? uniform * lerp(kPictureShareByArea, 1.0f, picture->pdf(emitter.square(hit)))
                       : uniform;
    });
}

}  // namespace nephroid
