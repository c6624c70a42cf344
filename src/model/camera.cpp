#include "model/camera.h"

#include "math/frame.h"
#include "sampling/warp.h"
#include "scene/match.h"

namespace nephroid {

namespace {

/// The part of the camera's screen that the film covers: x0 x1 y0 y1; the shorter side spans [-1, 1] (pbrt).
std::array<float, 4> screen_of(Camera const& c, Vec2i resolution) {
    if (c.screen_window) return *c.screen_window;
    float const aspect = c.frame_aspect_ratio
                             ? *c.frame_aspect_ratio
                             : static_cast<float>(resolution.x) / static_cast<float>(resolution.y);
    if (aspect > 1.0f) return {-aspect, aspect, -1, 1};
    return {-1, 1, -1 / aspect, 1 / aspect};
}

/// The lens's point for u, in the camera's space.
Vec3 lens_point(float lens_radius, Vec2 u) {
    if (!(lens_radius > 0.0f)) return {0, 0, 0};
    Vec2 const lens = lens_radius * square_to_disk(u);
    return {lens.x, lens.y, 0};
}

/// Moves the ray's origin onto the lens and aims it at where the pinhole ray meets the plane of focus (PBRT 4th ed., 5.2.3).
void apply_lens(float lens_radius, float focal_distance, Vec2 u, Vec3& o, Vec3& d) {
    if (!(lens_radius > 0.0f)) return;
    Vec3 const focus = o + d * (focal_distance / d.z);
    o += lens_point(lens_radius, u);
    d = normalize(focus - o);
}

}  // namespace

std::optional<PreparedCamera> PreparedCamera::make(Camera const& camera, Vec2i resolution) {
    auto const to_world = make_transform(camera.to_world);
    if (!to_world) return std::nullopt;
    PreparedCamera c;
    c.camera_ = camera;
    c.to_world_ = *to_world;
    Vec2 const pixels{static_cast<float>(resolution.x), static_cast<float>(resolution.y)};
    c.resolution_ = pixels;
    c.direction_scale_ = direction_scale(c.to_world_);
    c.position_ = c.to_world_.point({0, 0, 0});
    c.axes_ = {c.to_world_.vector({1, 0, 0}), c.to_world_.vector({0, 1, 0}), c.to_world_.vector({0, 0, 1})};
    auto const screen = screen_of(camera, resolution);
    // Raster y runs down, screen y up.
    Vec2 const size{screen[1] - screen[0], screen[2] - screen[3]};
    Vec2 const corner{screen[0], screen[3]};
    match(
        camera.kind,
        [&](PerspectiveCamera const& p) {
            float const t = std::tan(p.fov / 2.0f);
            c.scale_ = t * size / pixels;
            c.shift_ = t * corner;
            c.pixel_spread_ = std::abs(c.scale_.x);
            c.has_lens_ = p.lens_radius > 0.0f;
            c.is_pinhole_ = !c.has_lens_;
        },
        [&](OrthographicCamera const& p) {
            c.scale_ = size / pixels;
            c.shift_ = corner;
            c.pixel_spread_ = 0;
            c.has_lens_ = p.lens_radius > 0.0f;
        },
        [&](SphericalCamera const&) {
            c.scale_ = 1.0f / pixels;
            c.shift_ = Vec2{0, 0};
            c.pixel_spread_ = kPi / pixels.y;
        });
    return c;
}

CameraRay PreparedCamera::general_ray(Vec2 film, Vec2 lens) const {
    Vec2 const q = film * scale_ + shift_;
    Vec3 o{0, 0, 0};
    Vec3 d{0, 0, 1};
    match(
        camera_.kind,
        [&](PerspectiveCamera const& p) {
            d = Vec3{q.x, q.y, 1};
            apply_lens(p.lens_radius, p.focal_distance, lens, o, d);
        },
        [&](OrthographicCamera const& p) {
            o = Vec3{q.x, q.y, 0};
            apply_lens(p.lens_radius, p.focal_distance, lens, o, d);
        },
        [&](SphericalCamera const& p) {
            if (p.mapping == SphericalMappingKind::EquiRectangular) {
                d = spherical_direction(std::sin(kPi * q.y), std::cos(kPi * q.y), kTwoPi * q.x);
            } else {
                d = equal_area_square_to_sphere(wrap_equal_area_square(q));
            }
            std::swap(d.y, d.z);  // the sphere's pole is up
        });
    return {{to_world_.point(o), normalize(to_world_.vector(d))}, 1.0f};
}

bool PreparedCamera::rays(Vec2Lanes const& __restrict film, Vec3Lanes& __restrict o,
                          Vec3Lanes& __restrict d) const {
    if (!is_pinhole_) return false;
    for (std::size_t i = 0; i < kLanes; ++i) {
        d.set(i, through_pinhole(film[i]));
        o.set(i, position_);
    }
    return true;
}

std::optional<Vec2> PreparedCamera::project(Vec3 p) const {
    auto const s = sample_importance(p, {0.5f, 0.5f});  // the lens's centre
    return s ? std::optional<Vec2>(s->raster) : std::nullopt;
}

std::optional<CameraSample> PreparedCamera::sample_importance(Vec3 p, Vec2 lens) const {
    Vec3 const local = to_world_.point_inverse(p);
    CameraSample s;
    Vec3 from{0, 0, 0};            // camera space
    float pixels_per_measure = 0;  // d raster / d omega; of parallel rays, d raster / d A across them
    // The square of a pixel where the camera is in focus, as the world sees it: the area that it shows along d.
    auto const pixel_area = [&](float scale, Vec3 d) {
        Vec3 const x = to_world_.vector({scale_.x * scale, 0, 0}),
                   y = to_world_.vector({0, scale_.y * scale, 0});
        return abs_dot(cross(x, y), d);
    };
    bool const seen = match(
        camera_.kind,
        [&](PerspectiveCamera const& c) {
            // Through the point of the lens to the plane of focus, where the picture is.
            from = lens_point(c.lens_radius, lens);
            Vec3 const w = local - from;
            if (!(w.z > 0.0f)) return false;
            float const focal = c.lens_radius > 0.0f ? c.focal_distance : 1.0f;
            Vec3 const focus = from + w * (focal / w.z);
            s.raster = (Vec2{focus.x, focus.y} / focal - shift_) / scale_;
            Vec3 const to_focus = to_world_.vector(focus - from);
            float const d2 = length_squared(to_focus);
            pixels_per_measure = d2 / pixel_area(focal, to_focus / std::sqrt(d2));
            return true;
        },
        [&](OrthographicCamera const& c) {
            // From one point of the lens all rays are parallel.
            Vec3 const shift = lens_point(c.lens_radius, lens);
            if (!(local.z > 0.0f)) return false;
            Vec3 const d = c.lens_radius > 0.0f ? Vec3{0, 0, c.focal_distance} - shift : Vec3{0, 0, 1};
            from = local - d * (local.z / d.z);
            s.raster = (Vec2{from.x - shift.x, from.y - shift.y} - shift_) / scale_;
            pixels_per_measure = 1.0f / pixel_area(1, normalize(to_world_.vector(d)));
            return true;
        },
        [&](SphericalCamera const& c) {
            float const len = length(local);
            if (!(len > 0.0f)) return false;
            Vec3 w = local / len;
            float const changed = direction_density(direction_scale_, to_world_.vector(w));
            std::swap(w.y, w.z);  // the sphere's pole is up
            float per_steradian = resolution_.x * resolution_.y / (4.0f * kPi);
            Vec2 q;
            if (c.mapping == SphericalMappingKind::EquiRectangular) {
                float const sine = std::hypot(w.x, w.y);
                if (!(sine > 0.0f)) return false;
                float const phi = std::atan2(w.y, w.x);
                q = {(phi < 0.0f ? phi + kTwoPi : phi) * kInvTwoPi, std::atan2(sine, w.z) * kInvPi};
                per_steradian = resolution_.x * resolution_.y / (2.0f * kPi * kPi * sine);
            } else {
                q = equal_area_sphere_to_square(w);
            }
            s.raster = q / scale_;
            pixels_per_measure = per_steradian * changed;
            return true;
        });
    if (!seen) return std::nullopt;
    s.from = to_world_.point(from);
    Vec3 const way = s.from - p;
    s.distance = length(way);
    if (!(s.distance > 0.0f)) return std::nullopt;
    s.wi = way / s.distance;
    bool const parallel = std::holds_alternative<OrthographicCamera>(camera_.kind);
    s.importance = parallel ? pixels_per_measure : pixels_per_measure / sqr(s.distance);
    if (!std::isfinite(s.importance)) return std::nullopt;
    return s;
}

Vec2 PreparedCamera::wrap(Vec2 film) const {
    auto const* spherical = std::get_if<SphericalCamera>(&camera_.kind);
    if (!spherical) return film;
    Vec2 q = film * scale_;
    if (spherical->mapping == SphericalMappingKind::EqualArea) return wrap_equal_area_square(q) / scale_;
    // Over a pole, and down on the other side.
    q.y -= 2.0f * std::floor(0.5f * q.y);
    if (q.y > 1.0f) q = {q.x + 0.5f, 2.0f - q.y};
    q.x -= std::floor(q.x);
    return q / scale_;
}

}  // namespace nephroid
