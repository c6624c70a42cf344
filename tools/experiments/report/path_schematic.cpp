// Figure 1: the drawing of a path by which path tracing is explained, made from a path that was rendered.
#include "sections.h"

#include "apps/path_plot.h"
#include "apps/path_words.h"
#include "runs.h"
#include "sheet.h"
#include "transport/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace nephroid::experiment {

namespace {

constexpr char const* kScene = "report/01-path.pbrt";

constexpr std::size_t kFewest = 5, kMost = 8;  // vertices: short enough to draw

/// What happens along a path.
struct Events {
    int mirrors = 0, glass = 0,
        diffuse = 0;                   // where it goes on: specular reflection and transmission, diffuse
    std::ptrdiff_t lit = 0, dark = 0;  // where it asks the lamp: found, and hidden
};
Events events_of(PathRecord const& r) {
    Events e;
    for (PathVertex const& v : r.vertices)
        for (Scattering const& s : v.scatterings) {
            if (v.end != PathEnd::GoesOn) continue;
            e.mirrors += s.kind == ScatterKind::Specular && !s.transmitted;
            e.glass += s.kind == ScatterKind::Specular && s.transmitted;
            e.diffuse += s.kind == ScatterKind::Diffuse;
        }
    e.lit = std::count_if(r.tried.begin(), r.tried.end(), [](auto const& t) { return t.passing > 0; });
    e.dark = std::count_if(r.tried.begin(), r.tried.end(), [](auto const& t) { return t.passing == 0; });
    return e;
}

/// Diffuse, thrown back by a mirror and through glass, lit where it asked and where it did not.
bool shows_everything(PathRecord const& r) {
    if (r.vertices.size() < kFewest || r.vertices.size() > kMost) return false;
    Events const e = events_of(r);
    return e.mirrors >= 1 && e.glass >= 2 && e.diffuse >= 2 && e.lit >= 1 && e.dark >= 1;
}

PathRecord first_that_shows_everything(RenderJob const& job) {
    Vec2i const size = job.settings().film.resolution;
    for (std::uint64_t pass = 0; pass < 1000; ++pass)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (PathRecord r = replay(job, pass, {x, y}); shows_everything(r)) return r;
    throw std::runtime_error("no path of the scene shows everything");
}

/// A render of that pass has these bits there.
void check(RenderJob const& job, PathRecord const& r) {
    Film film = job.make_film();
    RayStats stats;
    render_pass(job, r.pass, film, stats);
    for (int c = 0; c < 3; ++c) {
        double const added = static_cast<double>(r.weight) * static_cast<double>(r.value[c]);
        double const there = film.pixel(r.pixel.x, r.pixel.y).rgb[static_cast<std::size_t>(c)];
        if (added != there) throw std::runtime_error("the replayed path is not the one that is rendered");
    }
}

std::string list_of(std::vector<std::string> const& parts) {
    std::string text;
    for (std::string const& p : parts) text += (text.empty() ? "" : "; ") + p;
    return text.empty() ? "-" : text;
}

std::vector<std::vector<std::string>> rows_of(RenderJob const& job, PathRecord const& r) {
    Scene const& scene = job.world().scene();
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < r.vertices.size(); ++i) {
        PathVertex const& v = r.vertices[i];
        std::vector<std::string> event, pdf, survival, beta, lamp, met;
        for (Scattering const& s : v.scatterings) {
            event.push_back(cli::kind_text(s));
            pdf.push_back(number(static_cast<double>(s.pdf)));
            survival.push_back(number(static_cast<double>(s.survival)));
            beta.push_back(cli::beta_text(s.beta, r.lambda));
        }
        if (v.end != PathEnd::GoesOn) event.push_back(cli::end_text(v.end));
        for (LightTried const& t : r.tried)
            if (t.vertex == i)
                lamp.push_back(t.passing > 0 ? fmt::format("{} (weight {})", cli::numbers_text(t.rgb),
                                                           number(static_cast<double>(t.weight)))
                                             : "occluded");
        for (LightMet const& m : r.met)
            if (m.vertex == i)
                met.push_back(fmt::format("{} (weight {})", cli::numbers_text(m.rgb),
                                          number(static_cast<double>(m.weight))));
        std::string surface = "-";
        if (v.surface && v.material.valid()) {
            Material const& m = scene[v.material];
            surface = fmt::format("{}{}", v.shape, m.name.empty() ? "" : ", " + m.name);
        }
        rows.push_back({cli::vertex_label(i), surface, list_of(event), list_of(pdf), list_of(survival),
                        list_of(beta), list_of(lamp), list_of(met)});
    }
    return rows;
}

}  // namespace

void path_schematic(Lab const& lab) {
    Page& page = lab.page;
    int const n = lab.pixels(200);
    Setup const setup = sized_file(kScene, n, n);
    RenderJob const job(setup.world, setup.settings);
    PathRecord const record = first_that_shows_everything(job);
    check(job, record);
    page.text(
        fmt::format("A path of the renderer: pass {} in pixel {},{}, the first (pass by pass, row by row) of "
                    "{} to {} vertices that goes through the glass ball, is thrown back by a mirror (the "
                    "block, or the ball's surface), is scattered by two diffuse surfaces or more, and asks "
                    "for the lamp both where it is seen and where something hides it. It was replayed: a "
                    "pass is a pure function, so the path of one pixel is walked again by the code that "
                    "renders, which says what it does. A render of that pass alone has the same bits in that "
                    "pixel.",
                    record.pass, record.pixel.x, record.pixel.y, kFewest, kMost));
    Events const e = events_of(record);
    page.table({"vertices", "specular reflections", "specular transmissions", "diffuse reflections",
                "lamp found", "lamp hidden"},
               {{std::to_string(record.vertices.size()), std::to_string(e.mirrors), std::to_string(e.glass),
                 std::to_string(e.diffuse), std::to_string(e.lit), std::to_string(e.dark)}});
    page.code(fmt::format(
        "nephroid render scenes/{} --size {}x{} --color rgb --replay {},{},{} -o path.svg -o path.png",
        kScene, n, n, record.pass, record.pixel.x, record.pixel.y));
    page.save("path.svg", cli::path_svg(job, record));
    page.image("path.svg", "A path in the Cornell box, from the side and from above");
    page.text(
        "Blue: the path, from the camera on. Green: geometric normals. Dashed: the lamp is asked for, grey "
        "where something is in the "
        "way; after glass and mirrors there is nothing to ask. β is the throughput after a scattering. By "
        "vertex (colours are linear "
        "sRGB):");
    page.table({"", "surface", "what happens", "pdf", "survival", "β after it", "light asked for adds",
                "light met adds"},
               rows_of(job, record));
    page.text(fmt::format("The sum, {}, is what the film adds, with weight {} of the pixel's filter.",
                          cli::numbers_text(record.value), number(static_cast<double>(record.weight))));
    Picture const picture =
        exposed(render_picture(setup, "Integrator \"path\" \"integer maxdepth\" 12\nSampler \"zsobol\"",
                               lab.passes(256), 1),
                0.95);
    Picture dimmed = picture;
    for (auto& color : dimmed.rgb)
        for (double& v : color) v = 0.4 * std::min(1.0, v);
    page.text("The same as the camera sees it:");
    show_sheet(lab, "path.png", "The scene, and the path drawn over it", {"scene", "path"},
               {{"", {picture, over(cli::draw_path(job, record), dimmed)}, 1}});
}

}  // namespace nephroid::experiment
