// experiment_direct_lighting [--quick] FOLDER: writes FOLDER/direct-lighting.md and FOLDER/direct-lighting/*, every number
// and picture of it from renders that it makes itself. Run by ./dev experiment direct-lighting.
#include "sections.h"

#include "experiment.h"
#include "figures.h"

namespace {

using namespace nephroid::experiment;

constexpr Section kSections[] = {{"Soft shadows", soft_shadows},
                                 {"Naive, or asking the light", naive_or_direct},
                                 {"A box light, five ways", box_light},
                                 {"Strategies side by side", strategies},
                                 {"Samplers", samplers},
                                 {"The shapes of lights", light_shapes},
                                 {"Many lights", many_lights},
                                 {"A picture that shines", picture_light},
                                 {"Uniform hemisphere or cosine", hemispheres}};

void introduction(Page& page) {
    page.text(
        "How direct light is found, and what it costs in noise: the trials of Shirley, Wang and Zimmerman "
        "(*Monte "
        "Carlo Techniques for Direct Lighting Calculations*, 1996) and of a student's ray tracer of 2010 "
        "(its Figures 5 "
        "to 8 and 11), repeated. Made by");
    page.code("./dev experiment direct-lighting");
    page.text(
        "which renders everything again and writes this page: no number or picture on it was put there by "
        "hand.");
    page.list({
        "**Error** is the relative RMSE: the root of the mean squared difference to a reference, over all "
        "pixels, as a "
        "share of the reference's mean. The reference is a closed form where there is one; otherwise many "
        "samples, and "
        "then its own error is given, from two renders that do not know of each other.",
        "**Variance** is that of one sample, averaged over the pixels, as a share of the squared mean. The "
        "relative RMSE "
        "after *n* independent samples is its root over √*n*; half the variance does with half the samples.",
        "**Slopes** are fitted to log error over log samples. Independent samples have −1/2.",
        "Scenes are grey and rendered in rgb mode, so that no colour adds noise. Where a formula is compared "
        "with, or a "
        "variance is taken, a pixel is its centre alone (`PixelFilter \"box\"` of radius 0.001): then the "
        "light is all "
        "that varies. Radiances are for lights of radiance 1 unless said otherwise; lengths are in units of "
        "the scene.",
        "All renders are functions of scene, settings and seed. The page is the same on any machine, up to "
        "the last bits "
        "of its C library. It says nothing about time: `docs/performance.md` does.",
    });
}

}  // namespace

int main(int argc, char** argv) {
    return run_experiment({"direct-lighting", "Direct lighting", introduction, kSections}, argc, argv);
}
