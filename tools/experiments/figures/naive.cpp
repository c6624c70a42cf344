// Light found by chance alone against light that is asked (Figure 5 of the report).
#include "figures.h"
#include "runs.h"

#include "plot.h"
#include "sheet.h"

#include <fmt/format.h>

namespace nephroid::experiment {

namespace {

struct Way {
    std::string name, directives;
};
std::vector<Way> ways() {
    std::string const path = "Integrator \"path\" \"integer maxdepth\" 5 \"string roulette\" \"none\" ";
    std::string const sampler = "\nSampler \"independent\"";
    return {{"naive", path + "\"bool samplelights\" false" + sampler},
            {"lights sampled", path + "\"bool samplelights\" true \"bool mis\" false" + sampler},
            {"both, MIS", path + "\"bool samplelights\" true" + sampler}};
}

Setup room(int width, int height) { return sized_file("report/05-naive.pbrt", width, height); }

}  // namespace

void naive_or_direct(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "A closed room of 4 × 5 × 3 (reflectance 0.5) with a ball and a box; a square of side 3 under its "
        "ceiling is the "
        "light, large enough that chance finds it. Path tracing of up to five bounces without roulette, at "
        "equal samples: "
        "naive (light counts only where a path runs into it), with lights sampled at each bounce, and with "
        "both, weighed by "
        "the power heuristic. It is the report's Figure 5. Pictures: 16 samples, and the limit.");
    std::string code;
    for (Way const& w : ways()) code += "# " + w.name + "\n" + w.directives + "\n";
    page.code(code);

    Setup const large = room(lab.pixels(150), lab.pixels(112));
    SheetRow row{"", {}, 1};
    std::vector<std::string> columns;
    for (Way const& w : ways()) {
        row.pictures.push_back(render_picture(large, w.directives, 16, 1));
        columns.push_back(w.name);
    }
    columns[2] = "both, mis";
    row.pictures.push_back(render_picture(
        large, "Integrator \"path\" \"string roulette\" \"none\"\nSampler \"zsobol\"", lab.passes(256), 1));
    columns.push_back(fmt::format("{} samples", lab.passes(256)));
    row.exposure = exposure_for(row.pictures.back(), 0.90);
    show_sheet(lab, "naive.png", "The room at 16 samples: naive, lights sampled, both; and the limit",
               columns, {row});

    Setup const small = room(lab.measured(48), lab.measured(36));
    Reference const reference = reference_by_samples(
        small, "Integrator \"path\" \"string roulette\" \"none\"\nSampler \"zsobol\"", lab.passes(2048));
    std::vector<int> const counts{1, 2, 4, 8, 16, 32, 64, 128, 256};
    std::vector<double> const x(counts.begin(), counts.end());
    std::vector<Line> lines;
    std::vector<std::vector<std::string>> rows;
    for (Way const& w : ways()) {
        auto const e = rmse_over_samples(small, w.directives, counts, lab.seeds(4), reference.picture);
        std::string const slope = fixed(log_log_slope(x, e), 2);
        lines.push_back({w.name, x, e, "slope " + slope});
        rows.push_back({w.name, percent(e[0]), percent(e[4]), percent(e[8]), slope,
                        number(lines.front().y[8] * lines.front().y[8] / (e[8] * e[8]))});
    }
    page.save("naive.svg",
              line_plot("A room under a large light", {"samples a pixel", true, {1, 4, 16, 64, 256}},
                        {"relative RMSE"}, lines));
    page.image("naive.svg", "Relative RMSE over samples: naive, lights sampled, both");
    page.table({"", "1 sample", "16", "256", "slope", "naive samples that one is worth"}, rows);
    page.text("Error of the reference (2 × " + std::to_string(lab.passes(2048)) +
              " samples): " + percent(reference.error) +
              ". All ways fall with the same slope: to ask the light moves the line down, at any number of "
              "samples, and "
              "never bends it.");
}

}  // namespace nephroid::experiment
