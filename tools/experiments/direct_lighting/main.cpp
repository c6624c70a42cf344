// experiment_direct_lighting [--quick] FOLDER: writes FOLDER/direct-lighting.md and FOLDER/direct-lighting/*, every number
// and picture of it from renders that it makes itself. Run by ./dev experiment direct-lighting.
#include "sections.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>

namespace {

using namespace nephroid::experiment;

struct Section {
    char const* name;
    void (*run)(Lab const&);
};
constexpr Section kSections[] = {{"soft shadows", soft_shadows}, {"naive or direct", naive_or_direct},
                                 {"box light", box_light},       {"strategies", strategies},
                                 {"samplers", samplers},         {"light shapes", light_shapes},
                                 {"many lights", many_lights},   {"picture light", picture_light},
                                 {"hemispheres", hemispheres}};

void introduction(Page& page, bool quick) {
    if (quick) page.text("**A quick run: the numbers show that the program works, and nothing else.**");
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

int run(std::filesystem::path const& folder, bool quick) {
    auto const start = std::chrono::steady_clock::now();
    Page page(folder, "direct-lighting", "Direct lighting");
    Lab const lab{
        page, quick,
        std::filesystem::temp_directory_path() / ("nephroid-experiment-" + std::to_string(getpid()))};
    std::filesystem::create_directories(lab.scratch);
    introduction(page, quick);
    for (Section const& s : kSections) {
        std::fprintf(stderr, "%5.1f s  %s\n",
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), s.name);
        s.run(lab);
    }
    page.write();
    std::filesystem::remove_all(lab.scratch);
    std::fprintf(stderr, "%5.1f s  done: %s\n",
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                 (folder / "direct-lighting.md").c_str());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    bool const quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    if (argc != (quick ? 3 : 2)) {
        std::fputs("experiment_direct_lighting [--quick] FOLDER\n", stderr);
        return 2;
    }
    try {
        return run(argv[argc - 1], quick);
    } catch (std::exception const& e) {
        std::fprintf(stderr, "experiment: %s\n", e.what());
        return 1;
    }
}
