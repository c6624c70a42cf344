#include "mesh_pictures.h"

#include "runs.h"
#include "sheet.h"

#include <fmt/format.h>

namespace nephroid::experiment {

void mesh_pictures(Lab const& lab, MeshFigure const& figure) {
    std::string const directives = "Integrator \"path\" \"integer maxdepth\" 16\nSampler \"zsobol\"";
    lab.page.code(directives);
    bool const by_paths = figure.limit.empty();
    if (!by_paths) lab.page.code(figure.limit);
    std::uint64_t const many = lab.passes(by_paths ? 320 : 96);
    Vec2i const size = figure.mirror.settings.film.resolution;
    std::vector<SheetRow> sheet;
    std::vector<std::vector<std::string>> rows;
    for (auto const& [material, setup] :
         {std::pair<std::string, Setup const&>{"mirror", figure.mirror}, {"glass", figure.glass}}) {
        Run const limit = by_paths ? Run{} : run(setup, figure.limit, many);
        Picture const reference =
            by_paths ? reference_by_samples(setup, directives, many).picture : limit.picture;
        SheetRow row{material, {}, exposure_for(reference, 0.95)};
        for (std::uint64_t const samples : {10, 50}) {
            Run r = run(setup, directives, samples);
            double const rate = static_cast<double>(samples) * size.x * size.y / r.seconds / 1e6;
            // A quick run has to be the same twice.
            rows.push_back({fmt::format("{}, {} samples", material, samples),
                            percent(relative_rmse(r.picture, reference)), time_taken(lab, r.seconds),
                            lab.quick ? "not taken" : number(rate) + " million"});
            row.pictures.push_back(std::move(r.picture));
        }
        row.pictures.push_back(reference);
        sheet.push_back(std::move(row));
        if (!by_paths)
            rows.push_back(
                {fmt::format("{}, {} passes", material, many), "", time_taken(lab, limit.seconds), ""});
    }
    show_sheet(lab, figure.sheet, figure.alt,
               {"10 samples", "50 samples",
                by_paths ? fmt::format("{} samples", 2 * many) : fmt::format("{} passes", many)},
               sheet);
    lab.page.table({fmt::format("{} × {} pixels", size.x, size.y), "error", "time", "samples a second"},
                   rows);
    lab.page.text(
        "Light that glass gathers on the walls is met by chance alone when paths come from the camera: what "
        "is left of the error at 50 samples is caustics.");
}

}  // namespace nephroid::experiment
