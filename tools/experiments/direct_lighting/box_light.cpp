// Five ways to draw a point on a box that shines (Figures 6, 7 and 8 of the report), one of them wrong.
#include "box_light_ways.h"
#include "sections.h"

#include "plot.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::experiment {

namespace {

void noise(Lab const& lab) {
    Page& page = lab.page;
    int const pixels = lab.pixels(120);
    Setup const setup = line_under_box(pixels);
    std::vector<Line> lines;
    std::vector<std::vector<std::string>> rows;
    // Pixels whose centres are nearest to these x.
    constexpr std::array kAt{0.2, 0.4875, 0.5125, 1.0, 2.5};
    for (char const* shapes : kBoxShapes) {
        auto const v = variance_by_pixel(setup, box_samples(shapes), lab.passes(16384));
        Line line{shapes, {}, v, {}};
        for (int i = 0; i < pixels; ++i) line.x.push_back(3.0 * (i + 0.5) / pixels);
        std::vector<std::string> row{fmt::format("`{}`", shapes)};
        for (double const x : kAt) {
            auto const i = std::min(static_cast<int>(x / 3 * pixels), pixels - 1);
            row.push_back(number(v[static_cast<std::size_t>(i)]));
        }
        rows.push_back(row);
        lines.push_back(std::move(line));
    }
    page.save("box-noise.svg",
              line_plot("Noise along a line below the box", {"x of the receiver", false},
                        {"variance / mean²", false}, lines, {{0.5, "a side face appears"}}, false));
    page.image("box-noise.svg", "Variance of a sample over the receiver's place, five ways");
    std::vector<std::string> head{"variance at"};
    for (double const x : kAt) head.push_back("x = " + number(x, 4));
    page.table(head, rows);
    page.text(
        "Up to x = 0.5 a receiver sees the lower face alone; from there on a side face too, at first "
        "edge-on: it sends "
        "nothing, but a way that chooses faces by their area gives it a share of the samples at once, and "
        "the noise jumps. "
        "A share by the area that a face *shows* begins at nothing, as does one by solid angle.");
}

}  // namespace

void box_light(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "A box of 1 × 1 × 0.8 and radiance 1 hangs 0.5 above a floor of reflectance 0.5, seen from above, "
        "from below the "
        "box, 4 × 4 units. Points on it are drawn: uniformly over all six faces (`area`, the report's Figure "
        "6); on the faces "
        "that the receiver sees, chosen by area (`visiblearea`, Figure 7) or by the area that they show it "
        "(`projected`, "
        "Figure 8); uniformly by solid angle (`solidangle`); or on any visible face with the same "
        "probability, without that "
        "being accounted for (`visibleunweighed`). The truth is the sum of the faces by Lambert's formula.");
    page.code(
        "Integrator \"direct\" \"string strategy\" \"light\" \"string shapesampling\" "
        "\"area|visiblearea|projected|solidangle|visibleunweighed\"\nSampler \"independent\"");
    box_light_pictures(lab);
    noise(lab);
    box_light_means(lab);
}

}  // namespace nephroid::experiment
