// Five ways to draw a point on a box that shines (Figures 6, 7 and 8 of the report), one of them wrong.
#include "sections.h"

#include "closed_form.h"
#include "measure.h"
#include "plot.h"
#include "scenes.h"
#include "sheet.h"

#include <fmt/format.h>

#include <array>
#include <numbers>

namespace nephroid::experiment {

namespace {

constexpr std::array<char const*, 5> kShapes{"area", "visiblearea", "projected", "solidangle",
                                             "visibleunweighed"};
constexpr Point kLow{-0.5, -0.5, 0.5}, kHigh{0.5, 0.5, 1.3};
constexpr float kReflectance = 0.5f;

std::string direct(std::string const& shapes) {
    return "Integrator \"direct\" \"string strategy\" \"light\" \"string shapesampling\" \"" + shapes +
           "\"\nSampler \"independent\"";
}

Setup floor_under_box(int width, int height, float x0, float x1, float y0, float y1) {
    return prepare(
        scenes::floor_view(width, height, scenes::Pixels::Points, x0, x1, y0, y1) +
        scenes::matte(kReflectance) + scenes::floor() +
        scenes::light(1, "Shape \"box\" \"point3 lo\" [ -0.5 -0.5 0.5 ] \"point3 hi\" [ 0.5 0.5 1.3 ]\n"));
}
/// Receivers on the line y = 0.2, from under the box's middle to 2.5 sides beyond its edge.
Setup line_under_box(int pixels) { return floor_under_box(pixels, 1, 0, 3, 0.199f, 0.201f); }

double radiance(Vec3 p) { return kReflectance / std::numbers::pi * box_irradiance(p, kLow, kHigh); }

void crops(Lab const& lab) {
    Setup const setup = floor_under_box(lab.pixels(120), lab.pixels(120), -2, 2, -2, 2);
    Reference const reference = closed_form(setup, radiance);
    SheetRow row{"", {}, exposure_for(reference.picture)};
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> errors;
    for (char const* shapes : kShapes) {
        row.pictures.push_back(render_picture(setup, direct(shapes), 4, 1));
        columns.emplace_back(shapes == std::string("visibleunweighed") ? "unweighed" : shapes);
        errors.push_back(
            {fmt::format("`{}`", shapes), percent(relative_rmse(row.pictures.back(), reference.picture))});
    }
    row.pictures.push_back(reference.picture);
    columns.emplace_back("closed form");
    show_sheet(lab, "box-ways.png",
               "The floor below the box, seen from above, at 4 samples, five ways; and Lambert's closed form",
               columns, {row});
    lab.page.table({"`shapesampling`", "error at 4 samples"}, errors);
}

void noise(Lab const& lab) {
    Page& page = lab.page;
    int const pixels = lab.pixels(120);
    Setup const setup = line_under_box(pixels);
    std::vector<Line> lines;
    std::vector<std::vector<std::string>> rows;
    // Pixels whose centres are nearest to these x.
    constexpr std::array kAt{0.2, 0.4875, 0.5125, 1.0, 2.5};
    for (char const* shapes : kShapes) {
        auto const v = variance_by_pixel(setup, direct(shapes), lab.passes(16384));
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

void bias(Lab const& lab) {
    Page& page = lab.page;
    Setup const setup = line_under_box(6);
    Reference const exact = closed_form(setup, radiance);
    int const seeds = lab.seeds(16);
    std::uint64_t const passes = lab.passes(32768);
    std::vector<std::vector<std::string>> rows{{"Lambert, radiance"}};
    for (auto const& c : exact.picture.rgb) rows[0].push_back(number(c[0], 4));
    double worst = 0;
    double off = 0;
    for (char const* shapes : kShapes) {
        auto const m = means_by_pixel(setup, direct(shapes), passes, seeds);
        std::vector<std::string> row{fmt::format("`{}`", shapes)};
        for (std::size_t i = 0; i < m.size(); ++i) {
            double const truth = exact.picture.rgb[i][0];
            row.push_back(with_error(100 * (m[i].mean / truth - 1), 100 * m[i].error / truth) + "%");
            if (shapes == std::string("visibleunweighed")) {
                worst = std::max(worst, std::abs(m[i].mean / truth - 1));
            } else if (m[i].error > 0) {
                off = std::max(off, std::abs(m[i].mean - truth) / m[i].error);
            }
        }
        rows.push_back(row);
    }
    page.table({"mean against the closed form, x =", "0.25", "0.75", "1.25", "1.75", "2.25", "2.75"}, rows);
    page.text(
        fmt::format("Differences of the mean of {} samples, with their standard errors. Of the four that are "
                    "meant to be right, the "
                    "farthest is {} standard errors off (of 24, over sixteen seeds each, the largest is "
                    "below 3.8 nineteen times out of twenty). "
                    "`visibleunweighed` chooses any visible face with the same probability and divides by "
                    "the density of a choice by "
                    "area: it is there to show what that does, {} at most here, and is not for pictures. "
                    "Where one face alone is seen "
                    "there is nothing to choose, and it is right.",
                    passes * static_cast<std::uint64_t>(seeds), number(off, 2), percent(worst)));
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
    crops(lab);
    noise(lab);
    bias(lab);
}

}  // namespace nephroid::experiment
