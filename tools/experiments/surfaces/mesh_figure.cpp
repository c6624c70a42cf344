// The knot as mirror and as glass; docs/report has Figures 12 and 13 with another mesh.
#include "sections.h"

#include "mesh_pictures.h"
#include "scene_files.h"

namespace nephroid::experiment {

void mesh_figure(Lab const& lab) {
    lab.page.text(
        "As in the report's Figures 12 and 13: the knot of 5040 triangles in `scenes/meshes`, in the Cornell "
        "box.");
    auto const knot_of = [&](std::string const& material) {
        return faithful(cornell(lab.pixels(100)) +
                            "AttributeBegin\nTranslate 278 220 290\nRotate -25 0 1 0\nRotate 20 1 0 "
                            "0\nScale 66 66 66\n" +
                            material +
                            "\nShape \"plymesh\" \"string filename\" \"meshes/knot.ply\"\nAttributeEnd\n",
                        scenes_folder());
    };
    mesh_pictures(
        lab, {"knot.png", "A knot as mirror and as glass, at 10 and 50 samples a pixel, and in the limit",
              knot_of("Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" "
                      "\"metal-Ag-k\""),
              knot_of("Material \"dielectric\"")});
}

}  // namespace nephroid::experiment
