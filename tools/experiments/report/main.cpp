// experiment_report [--quick] FOLDER: writes FOLDER/figures.md, figures.html, figures/* and full/*, every number and picture of them
// from renders that it makes itself. Run by ./dev report.
#include "sections.h"

#include "experiment.h"
#include "figures.h"

namespace {

using namespace nephroid::experiment;

constexpr Section kSections[] = {
    {"Figure 1. A path", path_schematic},
    {"Figure 2. Three spheres under a uniform sky", three_spheres},
    {"Figure 3. Light from interreflection alone", interreflection},
    {"Figure 4. Shapes that shine", emissive_shapes},
    {"The furnace", furnace_table},
    {"Figure 5. Naive, or asking the light", naive_or_direct},
    {"Figure 6. Soft shadows", soft_shadow_trials},
    {"Figures 7 and 8. A box light, wrong and right", box_light_wrong_and_right},
    {"Figures 9 and 10. Mirrors and glass", mirrors_and_glass},
    {"Figure 11. Unstratified and stratified points", stratified_points},
    {"Figures 12 and 13. A figure as mirror and as glass", creature_in_the_box},
    {"Figures 14 and 15. A caustic, and one from a faulty basis", faulty_basis},
    {"Figure 16. Whitted's tracer and path tracing", whitted_and_paths},
    {"Figures 17 to 19. Photons, their paths, and normals", photons_and_paths},
    {"Figures 20 to 22. The maps, seen", estimates_shown},
    {"Figures 23 to 25. Spheres, mirror boxes, water", pictures_of_the_report},
    {"Uniform hemisphere or cosine, which was left to do", hemispheres_shown},
};

void introduction(Page& page) {
    page.text(
        "nephroid began with a student's report of 2010: a Monte Carlo ray tracer, and the photon maps that "
        "it needed to get "
        "caustics. Here are that report's twenty-five figures, made anew from the scenes in `scenes/report`, "
        "by");
    page.code("./dev report");
    page.text(
        "which renders and measures everything again and writes this page, also as HTML: no number or "
        "picture on it was put there by hand. Times are the machine's, which had " +
        processors() + ".");
    page.text(
        "Pictures in full size (EXR and PNG), to which the HTML page links, are in the folder `full/` beside "
        "it. That folder is not in the repository: it appears after `./dev report`.");
}

}  // namespace

int main(int argc, char** argv) {
    return run_experiment({"figures", "The report, reproduced", introduction, kSections, 2}, argc, argv);
}
