#include "path_plot.h"

#include "canvas.h"
#include "outlines.h"
#include "path_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::cli {

namespace {

constexpr float kPanel = 460;  // pixels, the longer side of a view
constexpr float kMargin = 14, kTitle = 24, kLine = 17;
constexpr float kFarCamera = 1.0f;    // a camera farther away than the path is large is not drawn
constexpr float kLargeObject = 2.5f;  // objects that many times larger than the path do not widen the drawing
constexpr float kRays = 0.3f;         // length of rays that go nowhere, in parts of the view
constexpr float kLetter = 6.6f, kLetterHeight = 12;  // of a label, about

Vec3 axis_of(Mat4 const& m, std::size_t column) {
    return normalize(Vec3{static_cast<float>(m.m[0][column]), static_cast<float>(m.m[1][column]),
                          static_cast<float>(m.m[2][column])});
}

/// Right, up and forward of somebody who looks as the camera does but holds the head straight.
struct Axes {
    Vec3 right, up, forward;
};
Axes axes_of(Camera const& camera) {
    Axes a{axis_of(camera.to_world, 0), axis_of(camera.to_world, 1), axis_of(camera.to_world, 2)};
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(a.up[i]) > std::abs(a.up[axis])) axis = i;
    if (std::abs(a.up[axis]) < 0.8f) return a;
    Vec3 up{0, 0, 0};
    up[axis] = a.up[axis] > 0 ? 1.0f : -1.0f;
    float const handed = dot(cross(a.up, a.forward), a.right) < 0 ? -1.0f : 1.0f;
    Vec3 const forward = normalize(a.forward - up * dot(up, a.forward));
    return {cross(up, forward) * handed, up, forward};
}

struct Box2 {
    Vec2 lo{kInfinity, kInfinity}, hi{-kInfinity, -kInfinity};
    void add(Vec2 p) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
    [[nodiscard]] float overlap(Box2 const& b) const {
        float const w = std::min(hi.x, b.hi.x) - std::max(lo.x, b.lo.x);
        float const h = std::min(hi.y, b.hi.y) - std::max(lo.y, b.lo.y);
        return w > 0 && h > 0 ? w * h : 0;
    }
};

/// What is to be in the drawing.
struct Extent {
    Bounds3 box;
    bool camera = false;  // … is in it
};
Extent extent_of(PathRecord const& r, std::vector<Outline> const& shapes) {
    Bounds3 path;
    for (PathVertex const& v : r.vertices)
        if (v.surface) path.add(v.p);
    for (LightTried const& t : r.tried)
        if (!t.at_infinity) path.add(t.p);
    if (path.empty()) path.add(r.ray.o);
    // A path of one vertex has no size; that of the objects it met has.
    float size = max_component(path.diagonal());
    if (!(size > 0)) size = r.vertices.empty() || !r.vertices[0].surface ? 1 : r.vertices[0].distance;
    Extent e{path, false};
    for (Outline const& o : shapes)
        if (!o.bounds.empty() && max_component(o.bounds.diagonal()) <= kLargeObject * size &&
            max_component(max(o.bounds.lo - path.hi, path.lo - o.bounds.hi)) <= 0.5f * size)
            e.box.add(o.bounds);
    float const whole = max_component(e.box.diagonal());
    e.camera =
        max_component(max(r.ray.o - e.box.hi, e.box.lo - r.ray.o)) <= kFarCamera * std::max(whole, size);
    if (e.camera) e.box.add(r.ray.o);
    return e;
}

/// One view: to the right, and upwards, of the sheet.
class View {
  public:
    View(Vec3 across, Vec3 up, Extent const& extent) : across_(across), up_(up) {
        Box2 b;
        for (int i = 0; i < 8; ++i) b.add(flat(extent.box.corner(i)));
        float const size = std::max({b.hi.x - b.lo.x, b.hi.y - b.lo.y, 1e-20f});
        float const edge = 0.06f * size;
        lo_ = b.lo - Vec2{edge, edge};
        scale_ = kPanel / (size + 2 * edge);
        size_ = (b.hi - b.lo + Vec2{2 * edge, 2 * edge}) * scale_;
    }
    [[nodiscard]] Vec2 size() const { return size_; }
    [[nodiscard]] Vec2 operator()(Vec3 p) const {
        Vec2 const q = (flat(p) - lo_) * scale_;
        return {q.x, size_.y - q.y};
    }
    [[nodiscard]] float units(float pixels) const { return pixels / scale_; }

  private:
    [[nodiscard]] Vec2 flat(Vec3 p) const { return {dot(p, across_), dot(p, up_)}; }
    Vec3 across_, up_;
    Vec2 lo_{0, 0}, size_{1, 1};
    float scale_ = 1;
};

std::string escaped(std::string const& text) {
    std::string s;
    for (char const c : text)
        s += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return s;
}

/// A sheet's part with labels that keep out of each other's way.
class Panel {
  public:
    explicit Panel(View const& view) : view_(view) {}

    void line(std::vector<Vec2> const& points, std::string const& style) {
        text_ += "<polyline points=\"";
        for (Vec2 const p : points) text_ += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
        text_.back() = '"';
        text_ += fmt::format(" fill=\"none\" {}/>\n", style);
    }
    /// A line that labels shall not cross.
    void segment(Vec3 a, Vec3 b, std::string const& style) {
        segments_.push_back({view_(a), view_(b)});
        line(segments_.back(), style);
    }
    void dot(Vec2 p, float radius, char const* color) {
        text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", p.x, p.y, radius,
                             color);
    }
    void label(Vec2 at, std::string const& bold, std::string const& small) {
        wanted_.push_back({at, bold, small});
    }

    std::string take() {
        for (Wanted const& w : wanted_) place(w);
        return std::move(text_);
    }

  private:
    struct Wanted {
        Vec2 at;
        std::string bold, small;
    };
    void place(Wanted const& w) {
        float const width =
            kLetter * static_cast<float>(w.bold.size() + (w.small.empty() ? 0 : w.small.size() + 1));
        Box2 best;
        float least = kInfinity;
        for (float const away : {6.0f, 16.0f, 30.0f, 46.0f})
            for (int k = 0; k < 12; ++k) {
                float const a = kTwoPi * static_cast<float>(k) / 12 - 0.5f;
                Vec2 const centre = w.at + Vec2{(0.5f * width + away) * std::cos(a),
                                                (0.5f * kLetterHeight + away) * std::sin(a)};
                Vec2 const half{0.5f * width, 0.5f * kLetterHeight};
                Box2 const box{centre - half, centre + half};
                float const cost = this->cost(box) + 2 * away;
                if (cost < least) least = cost, best = box;
            }
        placed_.push_back(best);
        text_ += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"label\"><tspan "
            "font-weight=\"bold\">{}</tspan>{}</text>\n",
            best.lo.x, best.hi.y - 2.5f, w.bold,
            w.small.empty() ? "" : fmt::format(" <tspan fill=\"#333\">{}</tspan>", escaped(w.small)));
    }
    [[nodiscard]] float cost(Box2 const& box) const {
        Vec2 const size = view_.size();
        float sum = 0;
        auto const outside = [](float v) { return std::max(0.0f, v); };
        sum += 40 * (outside(2 - box.lo.x) + outside(2 - box.lo.y) + outside(box.hi.x - size.x + 2) +
                     outside(box.hi.y - size.y + 2));
        for (Box2 const& b : placed_) sum += 3 * box.overlap(b);
        for (auto const& s : segments_)
            for (int i = 0; i <= 60; ++i) {
                Vec2 const p = s[0] + (s[1] - s[0]) * (static_cast<float>(i) / 60);
                sum += p.x > box.lo.x && p.x < box.hi.x && p.y > box.lo.y && p.y < box.hi.y ? 8.0f : 0.0f;
            }
        return sum;
    }

    View const& view_;
    std::string text_;
    std::vector<std::vector<Vec2>> segments_;
    std::vector<Box2> placed_;
    std::vector<Wanted> wanted_;
};

Vec3 start_of(PathRecord const& r, PathVertex const& v) {
    return v.parent < 0 ? r.ray.o : r.vertices[static_cast<std::size_t>(v.parent)].p;
}
std::string beta_label(PathVertex const& v, Wavelengths const& lambda) {
    std::string text;
    for (Scattering const& s : v.scatterings)
        text += (text.empty() ? "β " : "; ") + beta_text(s.beta, lambda);
    return text;
}

std::string panel_of(View const& view, Extent const& extent, PathRecord const& r,
                     std::vector<Outline> const& shapes, bool with_beta) {
    Panel panel(view);
    for (Outline const& o : shapes)
        for (auto const& line : o.lines) {
            std::vector<Vec2> flat;
            for (Vec3 const p : line) flat.push_back(view(p));
            panel.line(flat, o.shines ? "stroke=\"#e0a800\" stroke-width=\"2.5\"" : "stroke=\"#b4b4b4\"");
        }
    float const far = view.units(kRays * kPanel);
    for (LightTried const& t : r.tried) {
        Vec3 const p = r.vertices[t.vertex].p;
        bool const reaches = t.passing > 0;
        panel.segment(p, t.at_infinity ? p + t.wi * far : t.p,
                      fmt::format("stroke=\"{}\" stroke-dasharray=\"6 4\" stroke-width=\"1.4\"",
                                  reaches ? "#d97000" : "#9a9a9a"));
        if (t.at_infinity) continue;
        panel.dot(view(t.p), 2.5f, reaches ? "#d97000" : "#9a9a9a");
        panel.label(view(t.p), fmt::format("y{}", t.vertex + 1), "");
    }
    for (PathVertex const& v : r.vertices) {
        // From a camera that is not in the drawing, the end of the ray.
        Vec3 a = start_of(r, v);
        Vec3 const b = v.surface ? v.p : a + v.direction * far;
        if (v.parent < 0 && !extent.camera)
            a = b - v.direction * std::min(length(b - a), 4 * view.units(kPanel));
        panel.segment(a, b, "stroke=\"#1257b8\" stroke-width=\"1.8\" marker-end=\"url(#tip)\"");
    }
    for (std::size_t i = 0; i < r.vertices.size(); ++i) {
        PathVertex const& v = r.vertices[i];
        if (!v.surface) continue;
        panel.segment(v.p, v.p + v.ng * view.units(24),
                      "stroke=\"#2a9d3a\" stroke-width=\"1.2\" marker-end=\"url(#normal)\"");
        panel.dot(view(v.p), 3.2f, "#1257b8");
        panel.label(view(v.p), vertex_label(i), with_beta ? beta_label(v, r.lambda) : "");
    }
    if (extent.camera) {
        panel.dot(view(r.ray.o), 4, "#000");
        panel.label(view(r.ray.o), "x0", "camera");
    }
    return panel.take();
}

std::vector<std::string> words_under(RenderJob const& job, PathRecord const& r) {
    std::vector<std::string> lines;
    lines.push_back(fmt::format("pass {}, pixel {},{} of {}x{}: the film adds {}", r.pass, r.pixel.x,
                                r.pixel.y, job.settings().film.resolution.x, job.settings().film.resolution.y,
                                numbers_text(r.value)));
    constexpr std::size_t kMostLines = 24;
    for (std::size_t i = 0; i < r.vertices.size() && lines.size() < kMostLines; ++i) {
        PathVertex const& v = r.vertices[i];
        std::string text = vertex_label(i) + ": ";
        for (LightMet const& m : r.met)
            if (m.vertex == i)
                text += fmt::format("meets light, weight {:.2g}, adds {}; ", m.weight, numbers_text(m.rgb));
        for (LightTried const& t : r.tried)
            if (t.vertex == i)
                text += t.passing > 0 ? fmt::format("light from y{}, weight {:.2g}, adds {}; ", i + 1,
                                                    t.weight, numbers_text(t.rgb))
                                      : fmt::format("light from y{} is occluded; ", i + 1);
        for (Scattering const& s : v.scatterings) text += kind_text(s) + "; ";
        if (v.end != PathEnd::GoesOn) text += end_text(v.end) + "; ";
        text.resize(text.size() - 2);
        lines.push_back(text);
    }
    return lines;
}

}  // namespace

std::string path_svg(RenderJob const& job, PathRecord const& r) {
    Axes const axes = axes_of(job.world().scene().camera);
    std::vector<Outline> const from_side = outlines(job.world(), axes.right),
                               from_above = outlines(job.world(), axes.up);
    Extent const extent = extent_of(r, from_side);
    View const side(axes.forward, axes.up, extent), above(axes.forward, -axes.right, extent);
    std::vector<std::string> const words = words_under(job, r);
    float const width = 3 * kMargin + side.size().x + above.size().x;
    float const panels = std::max(side.size().y, above.size().y);
    float const height = kTitle + panels + kMargin + kLine * static_cast<float>(words.size()) + kMargin;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} {1:.0f}\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"12\">\n"
        "<style>.label {{ font-size: 11px; paint-order: stroke; stroke: #fff; stroke-width: 3px; "
        "stroke-linejoin: round }}</style>\n"
        "<defs>\n",
        width, height);
    for (auto const& [id, color] : {std::pair{"tip", "#1257b8"}, {"normal", "#2a9d3a"}})
        svg += fmt::format(
            "<marker id=\"{}\" viewBox=\"0 0 8 8\" refX=\"{}\" refY=\"4\" markerWidth=\"6\" "
            "markerHeight=\"6\" orient=\"auto\">"
            "<path d=\"M0,1 L8,4 L0,7 z\" fill=\"{}\"/></marker>\n",
            id, id[0] == 't' ? 11 : 6, color);
    struct Placed {
        View const& view;
        std::vector<Outline> const& shapes;
        char const* title;
        float x;
        bool with_beta;
    };
    Placed const views[] = {{side, from_side, "from the side", kMargin, true},
                            {above, from_above, "from above", 2 * kMargin + side.size().x, false}};
    for (int i = 0; i < 2; ++i)
        svg += fmt::format("<clipPath id=\"clip{}\"><rect width=\"{:.1f}\" height=\"{:.1f}\"/></clipPath>\n",
                           i, views[i].view.size().x, views[i].view.size().y);
    svg += "</defs>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    for (int i = 0; i < 2; ++i) {
        Placed const& p = views[i];
        svg += fmt::format("<text x=\"{:.1f}\" y=\"16\">{}</text>\n", p.x, p.title);
        svg += fmt::format("<g transform=\"translate({:.1f} {:.1f})\" clip-path=\"url(#clip{})\">\n", p.x,
                           kTitle, i);
        svg += panel_of(p.view, extent, r, p.shapes, p.with_beta);
        svg += fmt::format("<rect width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#ddd\"/>\n</g>\n",
                           p.view.size().x, p.view.size().y);
    }
    float y = kTitle + panels + kMargin;
    for (std::string const& line : words) {
        y += kLine;
        svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\">{}</text>\n", kMargin, y - 4, escaped(line));
    }
    return svg + "</svg>\n";
}

Image draw_path(RenderJob const& job, PathRecord const& r) {
    constexpr Vec3 kPath{1, 1, 1}, kLight{1, 0.6f, 0.05f}, kDark{0.25f, 0.25f, 0.25f},
        kNormal{0.05f, 0.9f, 0.1f};
    constexpr float kNormalPixels = 18;
    Canvas canvas(job, true);
    float size = length(job.world().bounds().diagonal());
    if (!(size > 0)) size = 1;
    for (LightTried const& t : r.tried) {
        Vec3 const p = r.vertices[t.vertex].p;
        canvas.line(p, t.at_infinity ? p + t.wi * size : t.p, t.passing > 0 ? kLight : kDark, true);
    }
    for (PathVertex const& v : r.vertices) {
        if (v.surface)
            canvas.line(v.p, v.p + v.ng * (kNormalPixels * canvas.dot() * canvas.pixel_at(v.p)), kNormal);
        if (v.parent < 0) continue;  // to the camera it is a point
        Vec3 const a = start_of(r, v);
        canvas.line(a, v.surface ? v.p : a + v.direction * size, kPath);
    }
    for (PathVertex const& v : r.vertices)
        if (v.surface) canvas.point(v.p, kPath);
    return canvas.take();
}

}  // namespace nephroid::cli
