// experiment_surfaces [--quick] FOLDER: writes FOLDER/surfaces.md and FOLDER/surfaces/*, every number and picture of it from
// renders and samples that it makes itself. Run by ./dev experiment surfaces.
#include "sections.h"

#include "experiment.h"
#include "figures.h"

namespace {

using namespace nephroid::experiment;

constexpr Section kSections[] = {{"A ball of every model", material_balls},
                                 {"Mirrors and glass", mirrors_and_glass},
                                 {"A mesh as mirror and as glass", mesh_figure},
                                 {"Roughness and anisotropy", roughness_sweep},
                                 {"White furnace", white_furnace},
                                 {"A prism", prism},
                                 {"Glass, juice and ice", nested_dielectrics}};

void introduction(Page& page) {
    page.text("What surfaces do to light: each scattering model seen, and its energy counted. Made by");
    page.code("./dev experiment surfaces");
    page.text(
        "which renders everything again and writes this page: no number or picture on it was put there by "
        "hand.");
    page.list({
        "**Error** of a picture is its relative RMSE, as a share of its mean, from two renders that do not "
        "know of each other.",
        "**alpha** is the roughness of the microfacet distributions; `roughness` in a scene file is "
        "alpha² unless `remaproughness` is false, as it is in all scenes here; "
        "glTF's is the root of alpha.",
        "**Compensation** is the option `multiscatter`: what microfacets reflect among themselves comes "
        "back (Kulla & Conty 2017). pbrt-v4's materials have none, so that it is off by default.",
        "All renders are functions of scene, settings and seed. Times alone are the machine's: it had " +
            processors() + ".",
    });
}

}  // namespace

int main(int argc, char** argv) {
    return run_experiment({"surfaces", "Surfaces", introduction, kSections}, argc, argv);
}
