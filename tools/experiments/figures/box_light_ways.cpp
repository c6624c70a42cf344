// Five ways to draw a point on a box that shines, in pictures and by their means (Figures 7 and 8 of the report).
#include "box_light_ways.h"
#include "runs.h"

#include "closed_form.h"
#include "image/compare.h"
#include "scenes.h"
#include "sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::experiment {

namespace {

// As in scenes/include/floor-under-box.pbrt.
constexpr Point kLow{-0.5, -0.5, 0.5}, kHigh{0.5, 0.5, 1.3};
constexpr double kReflectance = 0.5;

double radiance(Vec3 p) { return kReflectance / std::numbers::pi * box_irradiance(p, kLow, kHigh); }

/// What the largest |t| of so many means over so many seeds is below with a probability of 95% at least, when all are right, and
/// however they depend on each other (Bonferroni).
double largest_of(int count, int seeds) {
    double const alpha = 0.05 / count;
    double low = 0, high = 1e6;
    while (high - low > 1e-6 * high) {
        double const middle = (low + high) / 2;
        (student_t_two_sided(middle, seeds - 1) > alpha ? low : high) = middle;
    }
    return high;
}

}  // namespace

std::string box_samples(std::string const& shapes) {
    return "Integrator \"direct\" \"string strategy\" \"light\" \"string shapesampling\" \"" + shapes +
           "\"\nSampler \"independent\"";
}

Setup line_under_box(int pixels) {
    return faithful(scenes::floor_view(pixels, 1, scenes::Pixels::Points, 0, 3, 0.199f, 0.201f) +
                        "Include \"include/floor-under-box.pbrt\"\n",
                    scenes_folder());
}

void box_light_pictures(Lab const& lab) {
    Setup const setup = sized_file("report/07-box-light.pbrt", lab.pixels(120), lab.pixels(120));
    Reference const reference = closed_form(setup, radiance);
    SheetRow row{"", {}, exposure_for(reference.picture)};
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> errors;
    for (char const* shapes : kBoxShapes) {
        row.pictures.push_back(render_picture(setup, box_samples(shapes), 4, 1));
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

void box_light_means(Lab const& lab) {
    Page& page = lab.page;
    Setup const setup = line_under_box(6);
    Reference const exact = closed_form(setup, radiance);
    int const seeds = lab.seeds(16);
    std::uint64_t const passes = lab.passes(32768);
    std::vector<std::vector<std::string>> rows{{"Lambert, radiance"}};
    for (auto const& c : exact.picture.rgb) rows[0].push_back(number(c[0], 4));
    double worst = 0;
    double off = 0;
    int compared = 0;
    for (char const* shapes : kBoxShapes) {
        auto const m = means_by_pixel(setup, box_samples(shapes), passes, seeds);
        std::vector<std::string> row{fmt::format("`{}`", shapes)};
        for (std::size_t i = 0; i < m.size(); ++i) {
            double const truth = exact.picture.rgb[i][0];
            row.push_back(with_error(100 * (m[i].mean / truth - 1), 100 * m[i].error / truth) + "%");
            if (shapes == std::string("visibleunweighed")) {
                worst = std::max(worst, std::abs(m[i].mean / truth - 1));
            } else if (m[i].error > 0) {
                off = std::max(off, std::abs(m[i].mean - truth) / m[i].error), ++compared;
            }
        }
        rows.push_back(row);
    }
    page.table({"mean against the closed form, x =", "0.25", "0.75", "1.25", "1.75", "2.25", "2.75"}, rows);
    page.text(
        fmt::format("Differences of the mean of {} samples, with their standard errors. Of the ways that are "
                    "meant to be right, the farthest is {} standard errors off (of {} means over {} seeds "
                    "each, the largest is below {} in 95% of runs or more). "
                    "`visibleunweighed` chooses any visible face with the same probability and divides by "
                    "the density of a choice by "
                    "area: it is there to show what that does, {} at most here, and is not for pictures. "
                    "Where one face alone is seen "
                    "there is nothing to choose, and it is right.",
                    passes * static_cast<std::uint64_t>(seeds), number(off, 2), compared, seeds,
                    number(largest_of(compared, seeds), 2), percent(worst)));
}

}  // namespace nephroid::experiment
