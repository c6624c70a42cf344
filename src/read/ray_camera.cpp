#include "ray_camera.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

void RayCamera::read() {
    auto const where = in_.here();
    auto& context = in_.context();
    if (where_) context.note(where, "a second camera: what it says replaces what the first one said");
    where_ = where;
    std::optional<Triple> view, look_at, up;
    std::optional<std::array<double, 4>> quaternion;
    auto const triple = [this](std::optional<Triple>& out) {
        return [this, &out] { out = in_.value([this] { return in_.numbers<3>(); }); };
    };
    in_.block(
        "camera",
        {{"position", {}, [&] { position_ = in_.value([&] { return in_.numbers<3>(); }); }},
         {"viewdir", {}, triple(view)},
         {"updir", {}, triple(up)},
         {"look_at", {}, triple(look_at)},
         {"quaternian", "quaternion", [&] { quaternion = in_.value([&] { return in_.numbers<4>(); }); }},
         {"fov",
          {},
          [&] {
              auto const at = in_.here();
              double const degrees = in_.value([&] { return in_.number(); });
              if (!(degrees > 0 && degrees < 180))
                  context.fail(at, "\"fov\" must be above 0 and below 180 degrees");
              fov_ = degrees * double{kPi} / 180;
          }},
         {"aspectratio", {}, [&] {
              auto const at = in_.here();
              aspect_ = in_.value([&] { return in_.number(); });
              if (!(aspect_ >= 0.01 && aspect_ <= 100))
                  context.fail(at, "\"aspectratio\" (width over height) must be between 0.01 and 100");
          }}});
    if (quaternion) set_quaternion(where, *quaternion);
    if (quaternion && (view || look_at))
        context.note(where, "the camera's \"quaternian\" is not used: \"viewdir\" and \"look_at\" win");
    set_view(where, view, look_at, up);
}

void RayCamera::set_view(SourceLocation where, std::optional<Triple> const& view,
                         std::optional<Triple> const& look_at, std::optional<Triple> const& up) {
    auto const& context = in_.context();
    if (view && !up) context.fail(where, "the camera has \"viewdir\" without \"updir\"; add it");
    if (up && !view && !look_at) context.fail(where, "the camera has \"updir\" without \"viewdir\"; add it");
    if (view) view_ = *view;
    if (look_at)  // a point
        for (std::size_t i = 0; i < 3; ++i) view_[i] = (*look_at)[i] - position_[i];
    if (up) up_ = *up;
}

/// The rotation by x i + y j + z k + w of the view along -z.
void RayCamera::set_quaternion(SourceLocation where, std::array<double, 4> const& q) {
    double const size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(size > 0) || !std::isfinite(size))
        in_.context().fail(where, "the camera's \"quaternian\" has no length, or too much");
    double const x = q[0] / size, y = q[1] / size, z = q[2] / size, w = q[3] / size;
    view_ = {-2 * (x * z + y * w), -2 * (y * z - x * w), -(1 - 2 * (x * x + y * y))};
    up_ = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
}

void RayCamera::finish(SourceLocation file) const {
    auto& context = in_.context();
    auto const where = where_.value_or(file);
    if (!where_) context.note(file, "no camera: one at the origin that looks along -z stands in");
    auto const& p = position_;
    auto const view = look_at(p, {p[0] + view_[0], p[1] + view_[1], p[2] + view_[2]}, up_);
    // The camera's own space is left-handed.
    auto const to_world = view ? inverse(scale(-1, 1, 1) * *view) : std::nullopt;
    if (!to_world)
        context.fail(where,
                     "the camera's direction has no length, or is along \"updir\"; change one of them");
    constexpr int kWidth = 512;  // what those programs began with
    Vec2i const size{kWidth, std::max(1, static_cast<int>(std::lround(kWidth / aspect_)))};
    context.scene.settings.film.resolution = size;
    context.scene.settings.film.where = where;
    // Of the shorter side, where the file has the height's.
    double const shorter = aspect_ >= 1 ? fov_ : 2 * std::atan(aspect_ * std::tan(fov_ / 2));
    context.scene.camera.kind = PerspectiveCamera{static_cast<float>(shorter)};
    context.scene.camera.to_world = *to_world;
    context.scene.camera.where = where;
}

}  // namespace nephroid
