// Path tracing, photon mapping and its progressive form, each as long as the others, against a converged picture.
#include "runs.h"
#include "sections.h"

#include "sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace nephroid::experiment {

namespace {

/// A part of a picture, in shares of its sides.
struct Window {
    double x0, x1, y0, y1;
};
Picture cut(Picture const& p, Window const& w) {
    auto const at = [](double share, int side) { return static_cast<int>(std::lround(share * side)); };
    int const x0 = at(w.x0, p.width), y0 = at(w.y0, p.height);
    Picture c{std::max(1, at(w.x1 - w.x0, p.width)), std::max(1, at(w.y1 - w.y0, p.height)), {}};
    for (int y = y0; y < y0 + c.height; ++y)
        for (int x = x0; x < x0 + c.width; ++x)
            c.rgb.push_back(p.rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) +
                                  static_cast<std::size_t>(x)]);
    return c;
}

struct Scene {
    std::string name;
    Window shown;  // where the caustic is
    int depth;
    // Where the camera sees the caustic on a diffuse surface, and nothing else: light tracing finds all of that.
    std::optional<Window> witnessed;
    bool meets_light = true;  // paths from the camera can
};
Scene const kScenes[] = {{"cup", {0.36, 0.76, 0.1, 0.55}, 10, Window{0.42, 0.62, 0.34, 0.52}},
                         {"ring", {0.3, 0.7, 0.25, 0.7}, 10, Window{0.39, 0.55, 0.46, 0.525}},
                         {"goblet", {0.5, 0.9, 0.5, 0.95}, 16, Window{0.56, 0.9, 0.62, 0.88}, false},
                         {"pool", {0.3, 0.7, 0.3, 0.75}, 10, std::nullopt}};

struct Way {
    std::string label, directives;
    std::uint64_t passes;  // of a quick run
};
std::vector<Way> ways(int depth) {
    return {
        {"path", fmt::format("Integrator \"path\" \"integer maxdepth\" {}\nSampler \"zsobol\"", depth), 16},
        {"photonmap",
         "Integrator \"photonmap\" \"integer passes\" 64 \"integer finalgathersamples\" 4\nSampler "
         "\"zsobol\" "
         "\"integer pixelsamples\" 256",
         1},
        {"sppm", fmt::format("Integrator \"sppm\" \"integer maxdepth\" {}\nSampler \"zsobol\"", depth), 8}};
}

/// What a way that is right in the mean says of a window: four renders, their mean and its standard error.
struct Witness {
    double mean = 0, error = 0;
};
Witness witness(Window const& window, std::function<Picture(std::uint64_t seed)> const& render_with) {
    constexpr int kRenders = 4;
    Witness w;
    double square = 0;
    for (int seed = 1; seed <= kRenders; ++seed) {
        double const m = mean(cut(render_with(static_cast<std::uint64_t>(seed) + 200), window));
        w.mean += m / kRenders, square += m * m / kRenders;
    }
    w.error = std::sqrt(std::max(0.0, square - w.mean * w.mean) / (kRenders - 1));
    return w;
}

}  // namespace

void equal_time(Lab const& lab) {
    Page& page = lab.page;
    double const seconds = 6, longer = 36;
    page.text(
        fmt::format("`scenes/cup.pbrt`, `ring`, `goblet` and `pool`, {} seconds each, in rgb mode; shown, "
                    "and measured, is where their caustics are. The reference is the mean of two renders "
                    "by `sppm` of {} seconds each, under other seeds; what lies between them says how far "
                    "it may be off. (It shares a little of the blur that `sppm` has.) The goblet's lamp is "
                    "a point: path tracing never finds its caustic.",
                    number(seconds, 1), number(longer, 2)));
    page.code(ways(10)[0].directives + "\n\n" + ways(10)[1].directives + "\n\n" + ways(10)[2].directives);
    int const width = lab.pixels(336), height = lab.pixels(252);
    std::vector<SheetRow> sheet;
    std::vector<std::vector<std::string>> rows, witnesses;
    for (Scene const& s : kScenes) {
        Setup const setup = sized_file(s.name + ".pbrt", width, height);
        auto const all = ways(s.depth);
        auto const take = [&](std::string const& directives, double time, std::uint64_t passes,
                              std::uint64_t seed) {
            return lab.quick ? run(setup, directives, passes, seed) : run_for(setup, directives, time, seed);
        };
        Picture const a = take(all[2].directives, longer, 24, 101).picture;
        Picture const b = take(all[2].directives, longer, 24, 102).picture;
        Picture reference = a;
        for (std::size_t i = 0; i < reference.rgb.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) reference.rgb[i][c] = (a.rgb[i][c] + b.rgb[i][c]) / 2;
        Picture const shown = cut(reference, s.shown);
        SheetRow row{s.name, {}, exposure_for(shown, 0.95)};
        std::vector<double> errors, of_all;
        std::vector<std::string> cells{s.name};
        for (Way const& w : all) {
            Run const r = take(w.directives, seconds, w.passes, 1);
            row.pictures.push_back(cut(r.picture, s.shown));
            errors.push_back(relative_mse(row.pictures.back(), shown));
            of_all.push_back(relative_mse(r.picture, reference));
            cells.push_back(
                number(errors.back()) +
                (lab.quick ? "" : fmt::format(" ({} passes, {} s)", r.passes, number(r.seconds, 2))));
        }
        row.pictures.push_back(shown);
        cells.push_back(number(relative_mse(cut(a, s.shown), cut(b, s.shown)) / 4, 2));
        for (auto const& e : {errors, of_all})
            for (std::size_t const i : {1u, 2u}) cells.push_back(number(e[0] / e[i]));
        rows.push_back(cells);
        if (s.witnessed) {
            auto const measured = [&](std::string const& directives) {
                return witness(*s.witnessed, [&](std::uint64_t seed) {
                    return take(directives, seconds / 2, 16, seed).picture;
                });
            };
            Witness const light = measured(
                fmt::format("Integrator \"lightpath\" \"integer maxdepth\" {}\nSampler \"zsobol\"", s.depth));
            witnesses.push_back({s.name, number(mean(cut(reference, *s.witnessed)), 4), with_error(light.mean, light.error),
                                 s.meets_light ? [&] {
                                     Witness const path = measured(all[0].directives);
                                     return with_error(path.mean, path.error);
                                 }() : "cannot"});
        }
        sheet.push_back(std::move(row));
    }
    show_sheet(lab, "equal-time.png",
               "Cup, ring, goblet and pool: path tracing, photon mapping, progressive photon mapping in "
               "equal time, and the reference",
               {"path", "photonmap", "sppm", "reference"}, sheet);
    page.table({"relMSE where the caustic is", "path", "photonmap", "sppm", "of the reference (estimated)",
                "path ÷ photonmap", "path ÷ sppm", "whole picture: path ÷ photonmap", "path ÷ sppm"},
               rows);
    page.subsection("A witness");
    page.text(
        "Light tracing estimates nothing by density: photon paths are connected to the camera and drawn "
        "where they are seen. What the camera sees in mirrors or through glass it misses, so that windows "
        "are compared that show the caustic on coffee, paper and table alone, and the pool is left out. It "
        "is not aimed, so that few of its paths come by where lamps are far. Path tracing, where it can "
        "meet the lamp, is a second witness. Four renders each, whose spread gives the standard error.");
    page.table({"mean radiance of the window", "reference", "light tracing", "path tracing"}, witnesses);
}

}  // namespace nephroid::experiment
