// Whitted's tracer against path tracing (Figure 16 of the report).
#include "figures.h"
#include "light_classes.h"
#include "runs.h"

#include "sheet.h"

#include <fmt/format.h>

namespace nephroid::experiment {

void whitted_and_paths(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report's Figure 16. Whitted's tracer of 1980 knows direct light, mirrors and glass: what lies "
        "in the shadow of the lamp is black, and so are the ceiling and what glass gathers below it.");
    struct Way {
        std::string label, directives;
        std::uint64_t samples;
    };
    std::string const sampler = "\nSampler \"zsobol\"";
    std::string const path = "Integrator \"path\" \"integer maxdepth\" 16" + sampler;
    std::string const whitted = "Integrator \"whitted\" \"integer maxdepth\" 16" + sampler;
    std::vector<Way> const ways{{"whitted, 1", whitted, 1},
                                {"whitted, 25", whitted, 25},
                                {"path, 1", path, 1},
                                {"path, 25", path, 25}};
    page.code("Integrator \"whitted|path\" \"integer maxdepth\" 16" + sampler);
    int const n = lab.pixels(176);
    Setup const setup = sized_file("report/16-spheres.pbrt", n, n);
    std::uint64_t const many = lab.passes(512);
    ReferenceByClass const reference = reference_by_class(setup, path, many);
    SheetRow row{"", {}, exposure_for(reference.light.whole, 0.93)};
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> table;
    for (Way const& w : ways) {
        Run r = run(setup, w.directives, w.samples);
        labels.push_back(w.label);
        table.push_back({w.label + (w.samples > 1 ? " samples a pixel" : " sample a pixel"),
                         number(mean(r.picture)), percent(relative_rmse(r.picture, reference.light.whole)),
                         time_taken(lab, r.seconds)});
        row.pictures.push_back(std::move(r.picture));
    }
    labels.push_back(fmt::format("path, {}", 2 * many));
    table.push_back({labels.back() + " samples a pixel", number(mean(reference.light.whole)),
                     percent(reference.error) + " (estimated)", ""});
    row.pictures.push_back(reference.light.whole);
    show_sheet(lab, "whitted.png",
               "The Cornell box with a silver and a glass ball: Whitted's tracer and path tracing", labels,
               {row});
    page.table(
        {fmt::format("`scenes/report/16-spheres.pbrt`, {0} × {0}", n), "mean radiance", "error", "time"},
        table);
    auto const shares = shares_of_error(render_by_class(setup, path, ways.back().samples), reference.light);
    page.text(fmt::format(
        "Of the squared error of {} samples of path tracing {} are in direct light, {} in caustics (the "
        "first surface that is neither mirror nor glass is lit through those), {} in indirect light and {} "
        "in lamps seen in mirrors and glass. A caustic's path from the camera has to meet "
        "the lamp by chance.",
        ways.back().samples, percent(shares[0]), percent(shares[1]), percent(shares[2]), percent(shares[3])));
}

}  // namespace nephroid::experiment
