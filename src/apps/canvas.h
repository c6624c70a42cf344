// Points and lines of the world, drawn over a picture as its camera sees them.
#pragma once

#include "image/image.h"
#include "transport/render_pass.h"

#include <array>
#include <optional>

namespace nephroid::cli {

class Canvas {
  public:
    /// As large as the job's crop window. What lies behind surfaces is left out, unless `hidden`.
    Canvas(RenderJob const& job, bool hidden);

    /// Radius of a point, pixels: seen on a large picture as on a small one.
    [[nodiscard]] float dot() const { return dot_; }
    /// R G B A, the colours times A.
    [[nodiscard]] Image take() { return std::move(image_); }

    /// A point of a surface, when the camera sees it.
    void point(Vec3 p, Vec3 color);
    /// `dashed`: every other few pixels.
    void line(Vec3 a, Vec3 b, Vec3 color, bool dashed = false);

    /// Scene units that are one pixel across, at p.
    [[nodiscard]] float pixel_at(Vec3 p) const;

  private:
    [[nodiscard]] bool visible(Vec3 p, Vec2 at);
    [[nodiscard]] bool inside(Vec2 at) const;
    struct Pen {
        Vec3 color;
        bool dashed = false;
        Vec2 from{0, 0};  // dashes are counted from there
    };
    void piece(Vec3 a, std::optional<Vec2> at_a, Vec3 b, std::optional<Vec2> at_b, Pen const& pen, int depth);
    void stamp(Vec2 at, Vec3 color, float radius);
    void blend(int x, int y, Vec3 color, float cover);

    RenderJob const& job_;
    bool hidden_;
    std::array<int, 4> crop_;
    Image image_;
    float dot_ = 1;
    RayStats stats_;
};

}  // namespace nephroid::cli
