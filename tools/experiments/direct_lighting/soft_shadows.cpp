// Shirley's trials: what 1, 4, 16 and 64 samples make of the shadows of lights of several sizes and shapes.
#include "scenes.h"
#include "sections.h"
#include "soft_shadow_trials.h"

namespace nephroid::experiment {

namespace {

/// One light, its points drawn by area and by solid angle.
void two_ways(Lab const& lab, std::string const& title, std::string const& what, std::string const& file,
              Trial trial, std::string const& learned) {
    lab.page.subsection(title);
    lab.page.text(what +
                  " Rows: points drawn uniformly over the surface (`area`), and by what the receiver sees "
                  "(`solidangle`, the default). Columns: samples a pixel.");
    lab.page.code(light_samples("area|solidangle", "zsobol"));
    std::string const name = trial.name;
    std::vector<Trial> trials;
    for (std::string const shapes : {"area", "solidangle"}) {
        trial.label = shapes == "area" ? "area" : "solid angle";
        trial.name = name + ", `" + shapes + "`";
        trial.shapes = shapes;
        trials.push_back(trial);
    }
    trial_sheet(lab, file, title + ", 1 to 64 samples and the limit", trials);
    trial_table(lab, trials);
    lab.page.text(learned);
}

}  // namespace

void soft_shadows(Lab const& lab) {
    lab.page.subsection("A square light of three sizes");
    square_lights(lab);
    two_ways(lab, "A sphere light", "The same ball under a sphere of radius 0.5 at (−1, 0.5, 2.6).",
             "sphere.png",
             {"", "sphere",
              ball_under(scenes::light(20, "Translate -1 0.5 2.6\nShape \"sphere\" \"float radius\" 0.5\n"))},
             "Half of a sphere's surface never sees the receiver: points drawn there are lost, and whether a "
             "sample is lost is noise even where nothing casts a shadow.");
    two_ways(
        lab, "A box light",
        "The same ball under a box of 1 × 0.6 × 0.5 at the same place, turned by 30° about the vertical.",
        "box.png",
        {"", "box",
         ball_under(scenes::light(18,
                                  "Translate -1 0.5 2.6\nRotate 30 0 0 1\nShape \"box\" \"point3 lo\" [ "
                                  "-0.5 -0.3 -0.25 ] \"point3 hi\" [ 0.5 0.3 0.25 ]\n"))},
        "A box shows at most three of its six faces. [Below](#a-box-light-five-ways) the ways to choose "
        "among them are held side by side.");
    two_ways(
        lab, "A cylinder light in a shade, open at both ends",
        "A cylinder light of radius 0.05 and length 0.3 stands within a black shade of radius 0.3 and length "
        "0.8; both are open at both ends. The lamp is one object, and its instance leans by 12° before a "
        "wall "
        "at a distance of 0.6.",
        "cylinder.png", {"", "cylinder in a shade", "Include \"report/04-cylinder.pbrt\"\n"},
        "Light leaves the shade as two cones, and the wall cuts them in the two branches of a hyperbola, "
        "whose axis leans with the lamp: an instance's transform moves an emitter as it moves a shade. The "
        "length of the light makes the penumbra.");
}

}  // namespace nephroid::experiment
