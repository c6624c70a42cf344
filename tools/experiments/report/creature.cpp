// Figures 12 and 13: a figure as mirror and as glass.
#include "sections.h"

#include "mesh_pictures.h"
#include "scene_files.h"

#include <fmt/format.h>

namespace nephroid::experiment {

void creature_in_the_box(Lab const& lab) {
    auto const scene = [&](std::string const& name) {
        Setup setup = prepare_file("report/" + name + ".pbrt");
        setup.settings.film.resolution = {lab.pixels(200), lab.pixels(200)};
        return setup;
    };
    MeshFigure const figure{
        "creature.png",
        "A toy creature as mirror and as glass, at 10 and 50 samples a pixel, and in the limit",
        scene("12-creature-mirror"), scene("13-creature-glass"), 96};
    lab.page.text(
        "A figure of silver, and of glass, in the Cornell box. The report had a toy dinosaur; this is a "
        "creature of "
        "our own (`scenes/meshes/creature.ply`): tapered capsules that melt into each other, made into "
        "triangles by `tools/creature.cpp`. Scenes: `scenes/report/12-creature-mirror.pbrt`, "
        "`scenes/report/13-creature-glass.pbrt`.");
    mesh_pictures(lab, figure);
}

}  // namespace nephroid::experiment
