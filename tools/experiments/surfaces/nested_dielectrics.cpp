// Glass, juice and ice in one tumbler, by priority; and two slabs, against Beer's law.
#include "sections.h"

#include "measure.h"
#include "sheet.h"
#include "stage.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>

namespace nephroid::experiment {

namespace {

/// Light that passes an absorbing slab inside another one, straight ahead, against Beer's law.
void slabs(Lab const& lab) {
    // Indices of 1: nothing is reflected, and the picture is exp(-what was absorbed).
    std::vector<std::vector<std::string>> rows;
    for (auto const& [name, outer, inner] :
         {std::tuple("inner above outer", 1, 2), std::tuple("outer above inner", 2, 1)}) {
        auto const slab = [&](double lo, double hi, double absorption, int priority) {
            return fmt::format(
                "Material \"dielectric\" \"float eta\" 1 \"float absorption\" {} \"integer priority\" {}\n"
                "Shape \"box\" \"point3 lo\" [ {} -50 -50 ] \"point3 hi\" [ {} 50 50 ]\n",
                absorption, priority, lo, hi);
        };
        Setup const setup = faithful(
            "Option \"string color\" \"rgb\"\nFilm \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" "
            "4\n"
            "LookAt -5 0 0  0 0 0  0 0 1\nCamera \"orthographic\"\nWorldBegin\nLightSource \"infinite\" "
            "\"rgb L\" "
            "[ 1 1 1 ]\n" +
                slab(0, 4, 0.1, outer) + slab(1, 3, 0.4, inner),
            ".");
        Picture const p = render_picture(
            setup, "Integrator \"path\" \"string roulette\" \"none\"\nSampler \"zsobol\"", lab.passes(64), 1);
        double const formula = std::exp(inner > outer ? -(2 * 0.1 + 2 * 0.4) : -4 * 0.1);
        rows.push_back({name, number(mean(p), 5), number(formula, 5)});
    }
    lab.page.table({"priority", "light that is left, rendered", "Beer's law"}, rows);
}

}  // namespace

void nested_dielectrics(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "`scenes/iced-juice.pbrt`: bodies that overlap, the one of the highest priority being there, and "
        "absorption inside.");
    Setup setup{prepare_file("iced-juice.pbrt")};
    int const width = lab.pixels(200);
    setup.settings.film.resolution = {width, width * 9 / 8};
    SheetRow row{"", {}, 1};
    row.pictures.push_back(render_picture(
        setup, "Integrator \"path\" \"integer maxdepth\" 32\nSampler \"zsobol\"", lab.passes(512), 1));
    show_sheet(lab, "iced-juice.png", "A tumbler of juice with ice and a straw", {}, {row});
    page.text(
        "A slab inside a slab, of indices 1, seen straight through: where they overlap (2 of 4 units) the "
        "one of the higher priority absorbs, 0.4 a unit the inner one and 0.1 the outer one.");
    slabs(lab);
}

}  // namespace nephroid::experiment
