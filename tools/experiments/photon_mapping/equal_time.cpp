// Path tracing, photon mapping and its progressive form, each as long as the others, against a converged picture.
#include "runs.h"
#include "sections.h"

#include "sheet.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::experiment {

namespace {

struct Scene {
    std::string name;
    double x0, x1, y0, y1;  // the crop, in shares of the picture: where the caustic is
    int depth;
    bool
        direct;  // the camera sees the caustic on a diffuse surface, and not through glass: light tracing finds it
};
Scene const kScenes[] = {{"cup", 0.3, 0.7, 0.25, 0.7, 10, true},
                         {"ring", 0.3, 0.7, 0.3, 0.75, 10, true},
                         {"goblet", 0.4, 0.9, 0.5, 0.95, 16, true},
                         {"pool", 0.3, 0.7, 0.35, 0.8, 10, false}};

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

/// Averages of blocks, so that two unbiased pictures can be told apart by less than their pixels' noise.
Picture blocks(Picture const& p, int size) {
    Picture b{std::max(1, p.width / size), std::max(1, p.height / size), {}};
    for (int y = 0; y < b.height; ++y)
        for (int x = 0; x < b.width; ++x) {
            std::array<double, 3> sum{};
            int const w = std::min(size, p.width), h = std::min(size, p.height);
            for (int v = 0; v < h; ++v)
                for (int u = 0; u < w; ++u)
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[c] +=
                            p.rgb[static_cast<std::size_t>((y * size + v) * p.width + x * size + u)][c] /
                            (w * h);
            b.rgb.push_back(sum);
        }
    return b;
}

}  // namespace

void equal_time(Lab const& lab) {
    Page& page = lab.page;
    page.section("Path tracing, photon maps and progressive maps in equal time");
    double const seconds = 4, longer = 50;
    page.text(fmt::format(
        "Where the caustics of `scenes/cup.pbrt`, `ring`, `goblet` and `pool` are, {} seconds each, in rgb "
        "mode. "
        "The reference is `sppm` for {} seconds in two renders under other seeds. As relMSE weighs pixels by "
        "their brightness, a few very bright ones can still make most of that of path tracing.",
        number(seconds), number(2 * longer)));
    page.code(ways(10)[0].directives + "\n\n" + ways(10)[1].directives + "\n\n" + ways(10)[2].directives);
    int const width = lab.pixels(360), height = lab.pixels(270);
    std::vector<SheetRow> sheet;
    std::vector<std::vector<std::string>> rows, witnesses;
    for (Scene const& s : kScenes) {
        Setup const setup = cropped(sized_file(s.name + ".pbrt", width, height), s.x0, s.x1, s.y0, s.y1);
        auto const all = ways(s.depth);
        auto const take = [&](std::string const& directives, double time, std::uint64_t passes,
                              std::uint64_t seed) {
            return lab.quick ? run(setup, directives, passes, seed) : run_for(setup, directives, time, seed);
        };
        Run const a = take(all[2].directives, longer, 24, 101), b = take(all[2].directives, longer, 24, 102);
        Picture reference = a.picture;
        for (std::size_t i = 0; i < reference.rgb.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                reference.rgb[i][c] = (a.picture.rgb[i][c] + b.picture.rgb[i][c]) / 2;
        SheetRow row{s.name, {}, exposure_for(reference, 0.97)};
        std::vector<double> errors;
        std::vector<std::string> cells{s.name};
        for (Way const& w : all) {
            Run r = take(w.directives, seconds, w.passes, 1);
            errors.push_back(relative_mse(r.picture, reference));
            cells.push_back(
                number(errors.back()) +
                (lab.quick ? "" : fmt::format(" ({} passes, {} s)", r.passes, number(r.seconds, 2))));
            row.pictures.push_back(std::move(r.picture));
        }
        cells.push_back(number(errors[0] / errors[1]));
        cells.push_back(number(errors[0] / errors[2]));
        cells.push_back(number(relative_mse(a.picture, b.picture) / 4, 2));
        rows.push_back(cells);
        row.pictures.push_back(reference);
        if (s.direct) {
            std::string const light =
                fmt::format("Integrator \"lightpath\" \"integer maxdepth\" {}\nSampler \"zsobol\"", s.depth);
            Run const r = take(light, seconds * 4, 16, 1);
            Picture const p = blocks(r.picture, 6), q = blocks(reference, 6);
            witnesses.push_back({s.name, number(mean(r.picture), 4), number(mean(reference), 4),
                                 percent(relative_rmse(p, q))});
        }
        sheet.push_back(std::move(row));
    }
    write_sheet(page.file("equal-time.png"), {"path", "photonmap", "sppm", "reference"}, sheet);
    page.image("equal-time.png",
               "Cup, ring, goblet and pool: path tracing, photon mapping, progressive photon "
               "mapping in equal time, and the reference");
    page.table({"relMSE", "path", "photonmap", "sppm", "path ÷ photonmap", "path ÷ sppm",
                "of the reference (estimated)"},
               rows);
    page.subsection("A witness");
    page.text(
        "Light tracing estimates nothing by density: photon paths are connected to the camera and drawn "
        "where "
        "they are seen. What the camera sees in mirrors or through glass it misses, so that the pool is left "
        "out.");
    page.table({"lightpath against the reference", "mean, light tracing", "mean, reference",
                "difference of 6 × 6 blocks, RMS"},
               witnesses);
}

}  // namespace nephroid::experiment
