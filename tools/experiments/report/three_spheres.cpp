// Three spheres that touch, under a uniform sky (Figure 2 of the report).
#include "sections.h"

#include "runs.h"
#include "scenes.h"
#include "sheet.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace nephroid::experiment {

namespace {

constexpr char const* kPath = "Integrator \"path\" \"integer maxdepth\" 12\nSampler \"zsobol\"";

/// The same spheres, straight from above around (x, y), from a height.
Setup from_above(double x, double y, double height) {
    return at_centres(faithful(
        fmt::format(
            "Option \"string color\" \"rgb\"\nFilm \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" "
            "8\nScale -1 1 1\nLookAt {0} {1} {2}  {0} {1} 0  0 1 0\nCamera \"orthographic\" \"float "
            "screenwindow\" [ -0.001 0.001 -0.001 0.001 ]\nWorldBegin\nInclude "
            "\"include/three-spheres.pbrt\"\n",
            x, y, height),
        scenes_folder()));
}

void closed_forms(Lab const& lab) {
    // A unit sphere on the floor takes (cos of its centre's direction)/(distance^2) of the light of a point of the floor. The three
    // are seen side by side from the point below all of them, and overlap from no point between.
    double const distance = 2 / std::sqrt(3.0);
    double const below = 0.5 * (1 - 3 / std::pow(1 + distance * distance, 1.5));
    struct Place {
        std::string name, directives;
        Setup setup;
        double radiance;
    };
    std::array<Place, 2> const places{
        Place{"floor, in the middle between the spheres: sky alone, ρ(1 − 3·(3/7)^1.5)",
              "Integrator \"direct\"\nSampler \"independent\"", from_above(0, 0, 0.4), below},
        Place{"top of a sphere, which sees the sky alone: ρ",
              "Integrator \"path\" \"integer maxdepth\" 12\nSampler \"independent\"",
              from_above(0, distance, 5), 0.8}};
    std::vector<std::vector<std::string>> rows;
    for (Place const& p : places) {
        Estimate const e = means_by_channel(p.setup, p.directives, lab.passes(2048), lab.seeds(8))[0];
        rows.push_back({p.name, number(p.radiance, 5),
                        e.error > 1e-6 ? with_error(e.mean, e.error) : number(e.mean, 5) + " (no noise)"});
    }
    lab.page.table({"radiance where a formula knows it", "formula", "measured"}, rows);
}

}  // namespace

void three_spheres(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report's Figure 2. Three spheres that touch each other and a floor (reflectances 0.8 and 0.5) "
        "under a sky of radiance 1 all around: no direction is preferred, and only what surfaces hide from "
        "each other makes them darker. Columns: samples a pixel.");
    page.code(std::string("# scenes/report/02-three-spheres.pbrt\n") + kPath);
    Setup const setup = sized_file("report/02-three-spheres.pbrt", lab.pixels(200), lab.pixels(150));
    Setup const small = sized_file("report/02-three-spheres.pbrt", lab.measured(80), lab.measured(60));
    Reference const reference = reference_by_samples(small, kPath, lab.passes(1024));
    SheetRow row{"", {}, 1};
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;
    for (int const samples : {1, 16, 256}) {
        Run r = run(setup, kPath, static_cast<std::uint64_t>(samples));
        double const error =
            rmse_over_samples(small, kPath, std::array{samples}, lab.seeds(2), reference.picture)[0];
        rows.push_back(
            {std::to_string(samples), number(mean(r.picture)), percent(error), time_taken(lab, r.seconds)});
        labels.push_back(std::to_string(samples));
        row.pictures.push_back(std::move(r.picture));
    }
    row.exposure = exposure_for(row.pictures.back(), 0.995);
    show_sheet(lab, "spheres-under-sky.png", "Three touching spheres under a uniform sky, 1 to 256 samples",
               labels, {row});
    page.table(
        {fmt::format("samples, {} × {}", setup.settings.film.resolution.x, setup.settings.film.resolution.y),
         "mean radiance", "error", "time"},
        rows);
    page.text(fmt::format("Errors are those of a smaller picture, whose reference is off by {} itself.",
                          percent(reference.error)));
    closed_forms(lab);
}

}  // namespace nephroid::experiment
