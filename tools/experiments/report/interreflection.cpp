// A box that is lit by interreflection alone (Figure 3 of the report).
#include "sections.h"

#include "runs.h"
#include "sheet.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::experiment {

namespace {

constexpr char const* kScene = "report/03-interreflection.pbrt";
constexpr char const* kPath = "Integrator \"path\" \"integer maxdepth\" 16\nSampler \"zsobol\"";

/// Rows below the tray, with the walls, the floor and the blocks.
constexpr double kBelow = 0.45;

/// What the walls lend the floor: red over green, in three crops of it.
void bleeding(Lab const& lab, int pixels) {
    struct Patch {
        std::string name;
        double x0, x1;
    };
    std::vector<std::vector<std::string>> rows;
    for (Patch const& p : {Patch{"by the red wall", 0.1, 0.2},
                           {"in the middle", 0.45, 0.55},
                           {"by the green wall", 0.8, 0.9}}) {
        Setup const crop = cropped(sized_file(kScene, pixels, pixels), p.x0, p.x1, 0.85, 0.97);
        auto const e = means_by_channel(crop, kPath, lab.quick ? 256 : 1024, lab.seeds(4));
        std::vector<std::string> row{p.name};
        for (Estimate const& c : e) row.push_back(with_error(c.mean, c.error));
        row.push_back(number(e[0].mean / e[1].mean));
        rows.push_back(row);
    }
    lab.page.table({"the floor", "red", "green", "blue", "red / green"}, rows);
    lab.page.text("The floor has one colour; what differs is the wall that it sees beside the ceiling.");
}

}  // namespace

void interreflection(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report's Figure 3. The lamp lies face up in a tray, whose rim keeps its light from the walls: "
        "they, the floor and the blocks see only what other surfaces scatter. A path tracer that asks the "
        "lamp at every bounce is answered on the ceiling alone. Columns: 10 samples a pixel, and 250, as in "
        "the report.");
    page.code(fmt::format("# scenes/{}\n{}", kScene, kPath));
    int const n = lab.pixels(200), m = lab.measured(60);
    Setup const setup = sized_file(kScene, n, n), small = sized_file(kScene, m, m);
    Reference const reference = reference_by_samples(small, kPath, lab.passes(4096));
    SheetRow row{"", {}, 1};
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;
    for (int const samples : {10, 250}) {
        Run r = run(setup, kPath, static_cast<std::uint64_t>(samples));
        double const error =
            rmse_over_samples(small, kPath, std::array{samples}, lab.seeds(2), reference.picture)[0];
        std::array<double, 3> sum{};
        for (auto const& color : r.picture.rgb)
            for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
        std::vector<std::string> cells{std::to_string(samples)};
        for (double const s : sum) cells.push_back(number(s / static_cast<double>(r.picture.rgb.size())));
        cells.insert(cells.end(), {percent(error), time_taken(lab, r.seconds)});
        rows.push_back(cells);
        labels.push_back(std::to_string(samples));
        row.pictures.push_back(std::move(r.picture));
    }
    row.exposure = exposure_for(row.pictures.back(), 0.9);
    show_sheet(lab, "interreflection.png", "A box lit by interreflection alone, at 10 and 250 samples",
               labels, {row});
    page.table({fmt::format("samples, {0} × {0}", n), "mean: red", "green", "blue", "error", "time"}, rows);

    Setup const below = cropped(sized_file(kScene, m, m), 0, 1, kBelow, 1);
    double const direct = mean(render_picture(
        below, "Integrator \"direct\" \"string strategy\" \"mis\"\nSampler \"zsobol\"", lab.passes(256), 1));
    double const all = mean(render_picture(below, kPath, lab.passes(256), 1));
    page.text(fmt::format(
        "Errors are those of a smaller picture, whose reference is off by {} itself. Of the light below the "
        "tray (the lower {} of the picture) the share that comes straight from the lamp is {}.",
        percent(reference.error), percent(1 - kBelow), direct > 0 ? percent(direct / all) : "0, exactly"));
    bleeding(lab, m);
}

}  // namespace nephroid::experiment
