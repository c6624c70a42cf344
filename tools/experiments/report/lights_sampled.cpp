// Figures 5 to 8 of the report: what the page on direct lighting shows of them, and where it goes on.
#include "sections.h"

#include "box_light_ways.h"
#include "figures.h"
#include "sheet.h"
#include "soft_shadow_trials.h"

#include <fmt/format.h>

namespace nephroid::experiment {

void soft_shadow_trials(Lab const& lab) {
    square_lights(lab);
    lab.page.text(
        "Spheres, boxes and cylinders, by area and by solid angle: [soft "
        "shadows](../experiments/direct-lighting.md#soft-shadows).");
}

void box_light_wrong_and_right(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report's Figures 7 and 8. A box of 1 × 1 × 0.8 and radiance 1 hangs 0.5 above a floor of "
        "reflectance 0.5, which is seen from above, from below the box. Right: faces that the receiver sees, "
        "chosen by their area (`visiblearea`) or by the area that they show it (`projected`), or directions "
        "uniform in solid angle. Wrong: any visible face with the same probability, and the sample not "
        "divided by it (`visibleunweighed`).");
    page.code("# scenes/report/07-box-light.pbrt\n" +
              box_samples("area|visiblearea|projected|solidangle|visibleunweighed"));
    box_light_pictures(lab);
    box_light_means(lab);
    page.text(
        "Where each way is noisy: [a box light, five "
        "ways](../experiments/direct-lighting.md#a-box-light-five-ways).");
}

}  // namespace nephroid::experiment
