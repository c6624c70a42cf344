#include "canvas.h"

#include <algorithm>
#include <cmath>

namespace nephroid::cli {

namespace {
constexpr int kFinest = 12;    // a line is halved so often at most
constexpr float kStep = 1.0f;  // pixels between the dots of a line
constexpr float kDash = 5.0f;  // dots long, and as far apart
}  // namespace

Canvas::Canvas(RenderJob const& job, bool hidden)
    : job_(job),
      hidden_(hidden),
      crop_(job.crop()),
      image_(PixelFormat::Float, crop_[1] - crop_[0], crop_[3] - crop_[2], {"R", "G", "B", "A"}),
      dot_(std::max(0.8f, static_cast<float>(job.settings().film.resolution.x) / 640.0f)) {}

void Canvas::point(Vec3 p, Vec3 color) {
    if (auto const at = job_.camera().project(p); at && inside(*at) && visible(p, *at))
        stamp(*at, color, dot_);
}

void Canvas::line(Vec3 a, Vec3 b, Vec3 color, bool dashed) {
    auto const at = job_.camera().project(a);
    piece(a, at, b, job_.camera().project(b), {color, dashed, at.value_or(Vec2{0, 0})}, 0);
}

float Canvas::pixel_at(Vec3 p) const {
    auto const at = job_.camera().project(p);
    if (!at) return 0;
    Ray const ray = job_.camera().ray(*at, {0.5f, 0.5f}).ray;
    Vec3 const across = frame_from_z(ray.d).x;
    float const step = 1e-3f * std::max(length(p - ray.o), 1e-20f);
    auto const beside = job_.camera().project(p + across * step);
    if (!beside) return 0;
    float const pixels = length(*beside - *at);
    return pixels > 0 ? step / pixels : 0;
}

/// Rays from the camera find nothing on the way. Media and openings in surfaces let through.
bool Canvas::visible(Vec3 p, Vec2 at) {
    if (hidden_) return true;
    Ray ray = job_.camera().ray(at, {0.5f, 0.5f}).ray;
    Vec3 const to = p - ray.o;
    float left = nephroid::dot(to, ray.d) *
                 (1 - 1e-3f);  // a picture's precision: what is this near is the surface itself
    SurfaceHit hit;
    while (left > 0 && job_.world().intersect(ray, left, RayKind::Shadow, stats_, hit)) {
        if (hit.passage != Passage::Interface) return false;
        ray = hit.spawn(ray.d);
        left -= hit.t;
    }
    return true;
}

bool Canvas::inside(Vec2 at) const {
    return at.x >= static_cast<float>(crop_[0]) - dot_ && at.x < static_cast<float>(crop_[1]) + dot_ &&
           at.y >= static_cast<float>(crop_[2]) - dot_ && at.y < static_cast<float>(crop_[3]) + dot_;
}

/// Halves what is longer than a step in the picture; what the camera cannot see an end of is halved as well, to its edge.
void Canvas::piece(Vec3 a, std::optional<Vec2> at_a, Vec3 b, std::optional<Vec2> at_b, Pen const& pen,
                   int depth) {
    if (!at_a && !at_b && depth > 4) return;
    if (at_a && at_b && length(*at_b - *at_a) <= kStep) {
        bool const gap = pen.dashed && std::fmod(length(*at_a - pen.from), 2 * kDash * dot_) > kDash * dot_;
        if (!gap && inside(*at_a) && visible(a, *at_a)) stamp(*at_a, pen.color, 0.6f * dot_);
        return;
    }
    if (depth == kFinest) return;
    Vec3 const middle = 0.5f * (a + b);
    auto const at = job_.camera().project(middle);
    piece(a, at_a, middle, at, pen, depth + 1);
    piece(middle, at, b, at_b, pen, depth + 1);
}

/// A soft disk of so many pixels' radius.
void Canvas::stamp(Vec2 at, Vec3 color, float radius) {
    auto const first = [&](float centre) { return static_cast<int>(std::floor(centre - radius - 0.5f)); };
    for (int y = first(at.y); static_cast<float>(y) < at.y + radius + 0.5f; ++y)
        for (int x = first(at.x); static_cast<float>(x) < at.x + radius + 0.5f; ++x) {
            if (x < crop_[0] || x >= crop_[1] || y < crop_[2] || y >= crop_[3]) continue;
            Vec2 const centre{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
            float const cover = std::clamp(radius + 0.5f - length(centre - at), 0.0f, 1.0f);
            if (cover > 0) blend(x - crop_[0], y - crop_[2], color, cover);
        }
}
void Canvas::blend(int x, int y, Vec3 color, float cover) {
    std::array<float, 4> const over{color.x * cover, color.y * cover, color.z * cover, cover};
    float* const pixel = &image_.floats()[image_.index(x, y, 0)];
    for (std::size_t c = 0; c < 4; ++c) pixel[c] = pixel[c] * (1 - cover) + over[c];
}

}  // namespace nephroid::cli
