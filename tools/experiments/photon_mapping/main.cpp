// experiment_photon_mapping [--quick] FOLDER: writes FOLDER/photon-mapping.md and FOLDER/photon-mapping/*, every number and
// picture of it from photons and renders that it makes itself. Run by ./dev experiment photon-mapping.
#include "sections.h"

#include "experiment.h"
#include "figures.h"

namespace {

using namespace nephroid::experiment;

constexpr Section kSections[] = {
    {"Whitted against path tracing", whitted_and_paths},
    {"Photons, paths and normals", photons_and_paths},
    {"The maps, seen", estimates_shown},
    {"The report's pictures", pictures_of_the_report},
    {"Bias and noise", bias_and_noise},
    {"Kernels", kernels},
    {"Aim", aimed_paths},
    {"Passes", progressive_passes},
    {"Path tracing, photon maps and progressive maps in equal time", equal_time}};

void introduction(Page& page) {
    page.text(
        "Light that is sent out by lamps, kept where it lands, and asked for by what the camera sees: "
        "Figures 16 to 25 of the student's report of 2010 that this renderer began with, made anew with "
        "its settings, and what it did not measure. Made by");
    page.code("./dev experiment photon-mapping");
    page.text(
        "which shoots and renders everything again and writes this page: no number or picture on it was "
        "put there by hand.");
    page.list({
        "The **global map** keeps photons wherever they land on a surface that is not specular; the "
        "**caustic map** those that mirrors and glass alone have thrown there.",
        "The report counts photons that are **stored**. A pass of ours **emits** a number of paths that is "
        "fixed beforehand, and divides the lamp's power by it; how many to emit so that about the wanted "
        "number is stored is found by a small shot beforehand. Both numbers are given, as they were "
        "counted in the render.",
        "**relMSE** is the mean of (a − b)² / (b² + 0.01) over pixels and channels, b being the reference. "
        "**Error** is the relative RMSE: the root of the mean squared difference as a share of the "
        "reference's mean.",
        "Renders are functions of scene, settings and seed. Times alone are the machine's: it had " +
            processors() + ". A quick run takes none.",
    });
}

}  // namespace

int main(int argc, char** argv) {
    return run_experiment({"photon-mapping", "Photon mapping", introduction, kSections}, argc, argv);
}
