// Photons, their paths and the normals where they landed, drawn over the picture (Figures 17 to 19 of the report).
#include "runs.h"
#include "sections.h"

#include "sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::experiment {

namespace {

using Color = std::array<double, 3>;

/// Marks over a picture, at places of the world.
class Overlay {
  public:
    Overlay(RenderJob const& job, Picture picture, std::vector<Vec3> seen)
        : job_(job), picture_(std::move(picture)), seen_(std::move(seen)) {}

    /// The surface at p is what the camera sees there, nothing in front of it.
    [[nodiscard]] bool sees(Vec3 p) const {
        auto const at = job_.camera().project(p);
        if (!at || !inside(at->x, at->y)) return false;
        Vec3 const eye = job_.camera().ray(*at, {0.5f, 0.5f}).ray.o;
        return length(seen_[index(at->x, at->y)] - p) < 0.02f * length(p - eye);
    }
    void dot(Vec3 p, Color const& color) {
        if (auto const at = job_.camera().project(p)) set(at->x, at->y, color);
    }
    void line(Vec3 from, Vec3 to, Color const& color) {
        auto const a = job_.camera().project(from), b = job_.camera().project(to);
        if (!a || !b) return;
        Vec2 const d = *b - *a;
        int const steps = std::max(1, static_cast<int>(std::ceil(std::max(std::abs(d.x), std::abs(d.y)))));
        if (steps > 100000) return;  // nearly at the eye
        for (int i = 0; i <= steps; ++i) {
            Vec2 const p = *a + d * (static_cast<float>(i) / static_cast<float>(steps));
            set(p.x, p.y, color);
        }
    }
    [[nodiscard]] Picture const& picture() const { return picture_; }

  private:
    [[nodiscard]] bool inside(float x, float y) const {
        return x >= 0 && y >= 0 && x < static_cast<float>(picture_.width) &&
               y < static_cast<float>(picture_.height);
    }
    [[nodiscard]] std::size_t index(float x, float y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
               static_cast<std::size_t>(x);
    }
    void set(float x, float y, Color const& color) {
        if (inside(x, y)) picture_.rgb[index(x, y)] = color;
    }

    RenderJob const& job_;
    Picture picture_;
    std::vector<Vec3> seen_;
};

/// The hue of the power, as bright as can be.
Color hue(Spectrum const& power) {
    double const most = static_cast<double>(std::max({power[0], power[1], power[2], 1e-30f}));
    return {power[0] / most, power[1] / most, power[2] / most};
}

}  // namespace

void photons_and_paths(Lab const& lab) {
    Page& page = lab.page;
    page.section("Photons, paths and normals");
    page.text(
        "The report's Figures 17 to 19, over a dimmed picture of `scenes/cornell-spheres.pbrt`: photons "
        "where "
        "they landed, in the hue of their power, caustic ones in yellow; paths of photons, white; and "
        "normals "
        "of the surfaces, green, as the photons keep them, in 16 bits. Photons and normals are drawn where "
        "the "
        "camera sees them, paths all along.");
    int const n = lab.pixels(300);
    Setup const setup = sized_file("cornell-spheres.pbrt", n, n);
    RenderJob const job(
        setup.world,
        with(setup.settings, "Integrator \"photonmap\" \"float radius\" 10\nSampler \"zsobol\""));
    std::uint64_t const photons = lab.quick ? 200 : 12000, paths = lab.quick ? 10 : 60;
    auto const global = shoot(job, ShotKind::Global, 0, photons, {});
    auto const caustic = shoot(job, ShotKind::Caustic, 0, photons, {});

    Picture under = render_picture(setup, "Integrator \"path\" \"integer maxdepth\" 8\nSampler \"zsobol\"",
                                   lab.passes(64), 1);
    double const exposure = 0.3 * exposure_for(under, 0.93);
    for (Color& c : under.rgb)
        for (double& v : c) v = std::min(1.0, v * exposure);
    std::vector<Vec3> const seen = positions(setup);

    Overlay dots(job, under, seen), lines(job, under, seen), normals(job, under, seen);
    std::uint64_t shown = 0, shown_caustic = 0, segments = 0, drawn_normals = 0;
    for (Photon const& p : global->photons)
        if (dots.sees(p.p())) dots.dot(p.p(), hue(p.power())), ++shown;
    for (Photon const& p : caustic->photons)
        if (dots.sees(p.p())) dots.dot(p.p(), {1, 0.85, 0.1}), ++shown_caustic;
    for (std::uint64_t i = 0; i < paths; ++i) {
        TracedPath const path = trace_light_path(job, ShotKind::Global, 0, i, photons);
        for (std::size_t v = 1; v < path.vertices.size(); ++v, ++segments)
            lines.line(path.vertices[v - 1], path.vertices[v], {1, 1, 1});
    }
    for (std::size_t i = 0; i < global->photons.size(); i += 12) {
        Photon const& p = global->photons[i];
        if (!normals.sees(p.p())) continue;
        normals.line(p.p(), p.p() + 25.0f * p.n(), {0.1, 0.9, 0.2});
        ++drawn_normals;
    }
    write_sheet(page.file("photons.png"), {"photons", "paths", "normals"},
                {{"", {dots.picture(), lines.picture(), normals.picture()}, 1}});
    page.image("photons.png", "Photons, photon paths and normals over the Cornell box with two balls");
    page.table(
        {"", "emitted paths", "stored photons", "drawn"},
        {{"global map", thousands(photons), thousands(global->photons.size()), thousands(shown)},
         {"caustic map", thousands(photons), thousands(caustic->photons.size()), thousands(shown_caustic)},
         {"paths, segments of them", std::to_string(paths), "", std::to_string(segments)},
         {"normals, of every twelfth photon", "", "", std::to_string(drawn_normals)}});
}

}  // namespace nephroid::experiment
