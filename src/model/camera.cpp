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

/// Moves the ray's origin onto the lens and aims it at where the pinhole ray meets the plane of focus (PBRT 4th ed., 5.2.3).
void apply_lens(float lens_radius, float focal_distance, Vec2 u, Vec3& o, Vec3& d) {
    if (!(lens_radius > 0.0f)) return;
    Vec2 const lens = lens_radius * square_to_disk(u);
    Vec3 const focus = o + d * (focal_distance / d.z);
    o += Vec3{lens.x, lens.y, 0};
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

CameraRay PreparedCamera::ray(Vec2 film, Vec2 lens) const {
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

}  // namespace nephroid
