// Figures 12 and 13: a figure as mirror and as glass.
#include "sections.h"

#include "mesh_pictures.h"
#include "runs.h"

#include <fmt/format.h>

namespace nephroid::experiment {

void creature_in_the_box(Lab const& lab) {
    auto const scene = [&](std::string const& name) {
        return sized_file("report/" + name + ".pbrt", lab.pixels(200), lab.pixels(200));
    };
    MeshFigure const figure{
        "creature.png",
        "A toy creature as mirror and as glass, at 10 and 50 samples a pixel, and in the limit",
        scene("12-creature-mirror"), scene("13-creature-glass"),
        "Integrator \"sppm\" \"integer maxdepth\" 16 \"integer photonsperiteration\" 200000"};
    lab.page.text(
        "A figure of silver, and of glass, in the Cornell box. The report had a toy dinosaur; this is a "
        "creature of "
        "our own (`scenes/meshes/creature.ply`): tapered capsules that melt into each other, made into "
        "triangles by `tools/creature.cpp`. Scenes: `scenes/report/12-creature-mirror.pbrt`, "
        "`scenes/report/13-creature-glass.pbrt`. Errors are against pictures of progressive photon maps, "
        "which find caustics.");
    mesh_pictures(lab, figure);
}

}  // namespace nephroid::experiment
