// Whole pictures with the report's own settings (Figures 23 to 25), and their times next to the report's.
#include "figures.h"
#include "runs.h"

#include "sheet.h"

#include <fmt/format.h>

namespace nephroid::experiment {

namespace {

constexpr int kGatherRays = 8;  // a sample; the report gathered with each path

struct Figure {
    int number;
    std::string name;
    Setup setup;
    std::uint64_t global, caustic;  // stored, as the report counted them
    int k;
    int edge;  // samples along a pixel's edge
    int depth;
};

std::string directives(Figure const& f, std::uint64_t global_paths, std::uint64_t caustic_paths) {
    return fmt::format(
        "Integrator \"photonmap\" \"integer indirectphotons\" {} \"integer causticphotons\" {} \"integer "
        "nused\" "
        "{} \"integer maxspeculardepth\" {} \"integer finalgathersamples\" {}\nSampler \"zsobol\" \"integer "
        "pixelsamples\" {}",
        global_paths, caustic_paths, f.k, f.depth, kGatherRays, f.edge * f.edge);
}

}  // namespace

void pictures_of_the_report(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        fmt::format("Figures 23 to 25 of the report, with the numbers that it gives: photons stored, photons "
                    "an estimate, samples along a pixel's edge, and for the first a path depth of 4. "
                    "Direct light is sampled, caustics come from their map, and indirect light from {} "
                    "gather rays a sample. The report's pictures took two to three hours each; it does not "
                    "say how large they were.",
                    kGatherRays));
    int const n = lab.pixels(256);
    std::uint64_t const fewer = lab.quick ? 100 : 1;
    std::vector<Figure> figures;
    figures.push_back({23, "spheres", sized_file("report/16-spheres.pbrt", n, n), 44000, 500000, 88, 4, 4});
    figures.push_back({24, "reflective boxes", sized_file("report/21-mirror-boxes.pbrt", n, n), 604000,
                       220000, 445, 4, 16});
    figures.push_back({25, "water", sized_file("report/25-water.pbrt", n, n), 440000, 524000, 120, 6, 16});
    SheetRow row{"", {}, 1};
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;
    for (Figure const& f : figures) {
        std::string const pilot = directives(f, 1000, 1000);
        std::uint64_t const global = paths_that_store(f.setup, pilot, ShotKind::Global, f.global / fewer);
        std::uint64_t const caustic = paths_that_store(f.setup, pilot, ShotKind::Caustic, f.caustic / fewer);
        std::string const asked = directives(f, global, caustic);
        page.code(asked);
        Run r = run(f.setup, asked, 1);
        PhotonCounts const g = total(r.photons.global), c = total(r.photons.caustic);
        auto const counts = [&](std::uint64_t wanted, PhotonCounts const& found) {
            return std::vector<std::string>{thousands(wanted / fewer), thousands(found.emitted),
                                            thousands(found.stored)};
        };
        std::vector<std::string> cells{fmt::format("{}: {}", f.number, f.name)};
        for (auto const& some : {counts(f.global, g), counts(f.caustic, c)})
            cells.insert(cells.end(), some.begin(), some.end());
        cells.push_back(lab.quick ? "not taken" : number(r.photons.shooting_seconds, 2) + " s");
        cells.push_back(lab.quick ? "not taken" : number(r.photons.building_seconds, 2) + " s");
        cells.push_back(time_taken(lab, r.seconds));
        cells.push_back("2 to 3 hours");
        rows.push_back(cells);
        labels.push_back(f.name);
        row.pictures.push_back(exposed(std::move(r.picture), 0.95));
    }
    show_sheet(lab, "report.png", "Spheres, reflective boxes and water, with the report's settings", labels,
               {row});
    page.table({fmt::format("{0} × {0} pixels", n), "global: wanted", "emitted", "stored", "caustic: wanted",
                "emitted", "stored", "shooting", "making the maps", "in all", "the report's"},
               rows);
}

}  // namespace nephroid::experiment
