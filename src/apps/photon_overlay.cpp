#include "photon_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace nephroid::cli {

namespace {

constexpr Vec3 kPathColor{1, 1, 1}, kNormalColor{0.05f, 0.9f, 0.1f};
constexpr int kPathsBeside = 20, kNormalsBeside = 200;  // of photons, where only they are asked for
constexpr float kNormalPixels = 12;                     // long
constexpr int kFinest = 12;                             // a line is halved so often at most
constexpr float kStep = 1.0f;                           // pixels between the dots of a line

class Canvas {
  public:
    Canvas(RenderJob const& job, bool hidden)
        : job_(job),
          hidden_(hidden),
          crop_(job.crop()),
          image_(PixelFormat::Float, crop_[1] - crop_[0], crop_[3] - crop_[2], {"R", "G", "B", "A"}) {
        // Points that are seen on a large picture as on a small one.
        dot_ = std::max(0.8f, static_cast<float>(job.settings().film.resolution.x) / 640.0f);
    }

    [[nodiscard]] float dot() const { return dot_; }
    [[nodiscard]] Image take() { return std::move(image_); }

    /// A point of a surface, when the camera sees it.
    void point(Vec3 p, Vec3 color) {
        if (auto const at = job_.camera().project(p); at && inside(*at) && visible(p, *at))
            stamp(*at, color, dot_);
    }

    void line(Vec3 a, Vec3 b, Vec3 color) {
        piece(a, job_.camera().project(a), b, job_.camera().project(b), color, 0);
    }

    /// Scene units that are one pixel across, at p.
    [[nodiscard]] float pixel_at(Vec3 p) const {
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

  private:
    /// Rays from the camera find nothing on the way. Media and openings in surfaces let through.
    [[nodiscard]] bool visible(Vec3 p, Vec2 at) {
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

    [[nodiscard]] bool inside(Vec2 at) const {
        return at.x >= static_cast<float>(crop_[0]) - dot_ && at.x < static_cast<float>(crop_[1]) + dot_ &&
               at.y >= static_cast<float>(crop_[2]) - dot_ && at.y < static_cast<float>(crop_[3]) + dot_;
    }

    /// Halves what is longer than a step in the picture; what the camera cannot see an end of is halved as well, to its edge.
    void piece(Vec3 a, std::optional<Vec2> at_a, Vec3 b, std::optional<Vec2> at_b, Vec3 color, int depth) {
        if (!at_a && !at_b && depth > 4) return;
        if (at_a && at_b && length(*at_b - *at_a) <= kStep) {
            if (inside(*at_a) && visible(a, *at_a)) stamp(*at_a, color, 0.6f * dot_);
            return;
        }
        if (depth == kFinest) return;
        Vec3 const middle = 0.5f * (a + b);
        auto const at = job_.camera().project(middle);
        piece(a, at_a, middle, at, color, depth + 1);
        piece(middle, at, b, at_b, color, depth + 1);
    }

    /// A soft disk of so many pixels' radius.
    void stamp(Vec2 at, Vec3 color, float radius) {
        auto const first = [&](float centre) { return static_cast<int>(std::floor(centre - radius - 0.5f)); };
        for (int y = first(at.y); static_cast<float>(y) < at.y + radius + 0.5f; ++y)
            for (int x = first(at.x); static_cast<float>(x) < at.x + radius + 0.5f; ++x) {
                if (x < crop_[0] || x >= crop_[1] || y < crop_[2] || y >= crop_[3]) continue;
                Vec2 const centre{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
                float const cover = std::clamp(radius + 0.5f - length(centre - at), 0.0f, 1.0f);
                if (cover > 0) blend(x - crop_[0], y - crop_[2], color, cover);
            }
    }
    void blend(int x, int y, Vec3 color, float cover) {
        std::array<float, 4> const over{color.x * cover, color.y * cover, color.z * cover, cover};
        float* const pixel = &image_.floats()[image_.index(x, y, 0)];
        for (std::size_t c = 0; c < 4; ++c) pixel[c] = pixel[c] * (1 - cover) + over[c];
    }

    RenderJob const& job_;
    bool hidden_;
    std::array<int, 4> crop_;
    Image image_;
    float dot_ = 1;
    RayStats stats_;
};

/// The first photons of each map, as many from one as from another.
struct Shown {
    PhotonRecord photon;
    Vec3 power;
};
std::vector<Shown> first_photons(RenderJob const& job, std::uint64_t pass, ShotKind kind, std::size_t count) {
    std::vector<Shown> shown;
    Wavelengths const lambda = job.pass_wavelengths(pass);
    std::uint64_t const paths = paths_of_pass(job, kind);
    for (std::uint64_t i = 0; i < paths && shown.size() < count; ++i)
        for (PhotonRecord const& photon : trace_light_path(job, kind, pass, i, paths).photons)
            if (shown.size() < count) shown.push_back({photon, power_rgb(photon, lambda)});
    return shown;
}

PhotonColors colors_of(std::vector<Shown> const& photons) {
    std::vector<float> most;
    most.reserve(photons.size());
    for (Shown const& s : photons) most.push_back(max_component(s.power));
    return PhotonColors(median_of(std::move(most)));
}

}  // namespace

bool draws(OverlayOptions const& o) { return o.photons > 0 || o.paths > 0 || o.normals > 0; }

Image draw_photons(RenderJob const& job, std::uint64_t pass, OverlayOptions const& o) {
    Canvas canvas(job, o.hidden);
    auto const maps = shots_of(shown_map(o.map));
    auto const share = [&](int asked, int otherwise) {
        int const n = asked >= 0 ? asked : o.photons > 0 ? otherwise : 0;
        return (static_cast<std::size_t>(n) + maps.size() - 1) / maps.size();
    };
    std::size_t const photons = share(o.photons, 0), paths = share(o.paths, kPathsBeside),
                      normals = share(o.normals, kNormalsBeside);
    std::vector<Shown> shown;
    for (ShotKind const kind : maps) {
        auto const some = first_photons(job, pass, kind, std::max(photons, normals));
        PhotonColors const colors = colors_of(some);
        for (std::size_t i = 0; i < std::min(photons, some.size()); ++i)
            canvas.point(some[i].photon.p, colors(some[i].power));
        for (std::size_t i = 0; i < std::min(normals, some.size()); ++i) shown.push_back(some[i]);
    }
    for (Shown const& s : shown)
        canvas.line(s.photon.p,
                    s.photon.p + s.photon.n * (kNormalPixels * canvas.dot() * canvas.pixel_at(s.photon.p)),
                    kNormalColor);
    for (ShotKind const kind : maps) {
        std::uint64_t const all = paths_of_pass(job, kind);
        for (std::uint64_t i = 0; i < std::min<std::uint64_t>(paths, all); ++i) {
            TracedPath const path = trace_light_path(job, kind, pass, i, all);
            for (std::size_t k = 1; k < path.vertices.size(); ++k)
                canvas.line(path.vertices[k - 1], path.vertices[k], kPathColor);
        }
    }
    return canvas.take();
}

}  // namespace nephroid::cli
