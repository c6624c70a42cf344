// A mesh as mirror and as glass, at 10 and 50 samples a pixel (Figures 12 and 13 of the report).
#include "sections.h"

#include "measure.h"
#include "sheet.h"
#include "stage.h"

#include <fmt/format.h>

#include <array>
#include <chrono>

namespace nephroid::experiment {

void mesh_figure(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report's Figures 12 and 13, with a figure of our own: the knot of 5040 triangles in "
        "`scenes/meshes`, in the Cornell box.");
    std::string const directives = "Integrator \"path\" \"integer maxdepth\" 16\nSampler \"zsobol\"";
    page.code(directives);
    int const pixels = lab.pixels(100);
    std::uint64_t const many = lab.passes(320);
    std::vector<SheetRow> sheet;
    std::vector<std::vector<std::string>> rows;
    for (std::string const material : {"mirror", "glass"}) {
        Setup const setup =
            faithful(cornell(pixels) +
                         "AttributeBegin\nTranslate 278 220 290\nRotate -25 0 1 0\nRotate 20 1 0 "
                         "0\nScale 66 66 66\n" +
                         (material == "mirror" ? "Material \"conductor\" \"spectrum eta\" "
                                                 "\"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\""
                                               : "Material \"dielectric\"") +
                         "\nShape \"plymesh\" \"string filename\" \"meshes/knot.ply\"\nAttributeEnd\n",
                     scenes_folder());
        Reference const reference = reference_by_samples(setup, directives, many);
        SheetRow row{material, {}, exposure_for(reference.picture, 0.95)};
        for (std::uint64_t const samples : {10, 50}) {
            auto const start = std::chrono::steady_clock::now();
            row.pictures.push_back(render_picture(setup, directives, samples, 1));
            double const seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            // A quick run has to be the same twice.
            rows.push_back(
                {fmt::format("{}, {} samples", material, samples),
                 percent(relative_rmse(row.pictures.back(), reference.picture)),
                 lab.quick ? "not taken" : number(seconds, 2) + " s",
                 lab.quick
                     ? "not taken"
                     : number(static_cast<double>(samples) * pixels * pixels / seconds / 1e6) + " million"});
        }
        row.pictures.push_back(reference.picture);
        sheet.push_back(std::move(row));
    }
    show_sheet(lab, "knot.png",
               "A knot as mirror and as glass, at 10 and 50 samples a pixel, and in the limit",
               {"10 samples", "50 samples", fmt::format("{} samples", 2 * many)}, sheet);
    page.table({fmt::format("{0} × {0} pixels", pixels), "error", "time", "samples a second"}, rows);
    page.text(
        "Light that glass gathers on the walls is met by chance alone when paths come from the camera: what "
        "is left of the error at 50 samples is caustics.");
}

}  // namespace nephroid::experiment
