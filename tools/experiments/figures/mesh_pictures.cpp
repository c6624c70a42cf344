#include "mesh_pictures.h"

#include "light_classes.h"
#include "runs.h"
#include "sheet.h"

#include <fmt/format.h>

namespace nephroid::experiment {

void mesh_pictures(Lab const& lab, MeshFigure const& figure) {
    std::string const directives = "Integrator \"path\" \"integer maxdepth\" 16\nSampler \"zsobol\"";
    lab.page.code(directives);
    bool const by_paths = figure.limit.empty();
    if (!by_paths) lab.page.code(figure.limit);
    std::string const limit = by_paths ? directives : figure.limit;
    std::uint64_t const many = lab.passes(by_paths ? 320 : 96);
    std::string const reference_words = fmt::format("2 x {} {}", many, by_paths ? "samples" : "passes");
    Vec2i const size = figure.mirror.settings.film.resolution;
    std::vector<SheetRow> sheet;
    std::vector<std::vector<std::string>> rows;
    for (auto const& [material, setup] :
         {std::pair<std::string, Setup const&>{"mirror", figure.mirror}, {"glass", figure.glass}}) {
        ReferenceByClass const reference = reference_by_class(setup, limit, many);
        SheetRow row{material, {}, exposure_for(reference.light.whole, 0.95)};
        for (std::uint64_t const samples : {10, 50}) {
            Run r = run(setup, directives, samples);
            double const rate = static_cast<double>(samples) * size.x * size.y / r.seconds / 1e6;
            std::vector<std::string> cells{fmt::format("{}, {} samples", material, samples),
                                           number(mean(r.picture)),
                                           percent(relative_rmse(r.picture, reference.light.whole))};
            // Once more, with layers, which the time above is without.
            for (double const share :
                 shares_of_error(render_by_class(setup, directives, samples), reference.light))
                cells.push_back(fixed(100 * share, 1) + "%");
            cells.push_back(time_taken(lab, r.seconds));
            // A quick run has to be the same twice.
            cells.push_back(lab.quick ? "not taken" : number(rate) + " million");
            rows.push_back(std::move(cells));
            row.pictures.push_back(std::move(r.picture));
        }
        row.pictures.push_back(reference.light.whole);
        sheet.push_back(std::move(row));
        rows.push_back({material + ", " + reference_words, number(mean(reference.light.whole)),
                        percent(reference.error) + " (estimated)", "", "", "", "",
                        time_taken(lab, reference.light.seconds), ""});
    }
    show_sheet(lab, figure.sheet, figure.alt, {"10 samples", "50 samples", reference_words}, sheet);
    lab.page.table({fmt::format("{} × {} pixels", size.x, size.y), "mean radiance", "error",
                    "of its square: direct light", "caustics", "indirect light", "lamps in mirrors and glass",
                    "time", "samples a second"},
                   rows);
    lab.page.text(
        "The error of the reference is estimated from its two renders" +
        std::string(by_paths ? "" : ": what photon maps blur alike in both is not in it") +
        ". The squares of errors are parted by the ways of light, as `--aovs` keeps them: by the mean of "
        "each "
        "way's difference times the whole difference, so that they add up to the whole. Caustics are what "
        "mirrors and glass throw on the first surface that is neither: paths from the camera meet them by "
        "chance alone.");
}

}  // namespace nephroid::experiment
