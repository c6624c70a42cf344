// Which of two thousand lights is asked.
#include "sections.h"

#include "measure.h"
#include "scenes.h"
#include "sheet.h"

#include <fmt/format.h>

namespace nephroid::experiment {

namespace {

constexpr int kLights = 2000;
constexpr char const* kChoices[] = {"uniform", "power", "bvh"};

std::string direct(std::string const& choice, std::string const& sampler) {
    return "Integrator \"direct\" \"string strategy\" \"light\" \"string lightsampler\" \"" + choice +
           "\"\nSampler \"" + sampler + "\"";
}

Setup room(int width, int height, scenes::Pixels pixels) {
    return prepare(
        scenes::view(width, height, pixels, {-4.5f, -3.6f, 2.6f}, {1, 1, 0.6f}, 60) + scenes::matte(0.5f) +
        scenes::room({-5, -4, 0}, {5, 4, 4}) +
        "AttributeBegin\nTranslate 0.3 -0.2 0.8\nShape \"sphere\" \"float radius\" 0.8\nAttributeEnd\n"
        "AttributeBegin\nTranslate -2 1.5 0.75\nRotate 30 0 0 1\nShape \"box\" \"point3 lo\" [ -0.7 -0.7 "
        "-0.75 ] "
        "\"point3 hi\" [ 0.7 0.7 0.75 ]\nAttributeEnd\n" +
        scenes::scattered_lights(kLights));
}

}  // namespace

void many_lights(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        fmt::format("{} emitting triangles hang in a room of 10 × 8 × 4 with a ball and a box; they look in "
                    "all directions, their sizes "
                    "range over a factor of 10 and their radiances over one of 100. One of them is asked a "
                    "sample: any, one by its power, "
                    "or one by what it may contribute at the receiver. Pictures: 16 samples, and the limit.",
                    kLights));
    page.code(direct("uniform|power|bvh", "independent"));
    Setup const whole = room(lab.pixels(150), lab.pixels(112), scenes::Pixels::Whole);
    SheetRow row{"", {}, 1};
    std::vector<std::string> columns;
    for (char const* choice : kChoices) {
        row.pictures.push_back(render_picture(whole, direct(choice, "independent"), 16, 1));
        columns.emplace_back(choice);
    }
    row.pictures.push_back(render_picture(whole, direct("bvh", "zsobol"), lab.passes(256), 1));
    columns.emplace_back(lab.quick ? "8 samples" : "256 samples");
    row.exposure = exposure_for(row.pictures.back(), 0.93);
    show_sheet(lab, "many-lights.png",
               "The room at 16 samples, the lights chosen uniformly, by power and by the tree; and the limit",
               columns, {row});

    Setup const points = room(lab.pixels(40), lab.pixels(30), scenes::Pixels::Points);
    Reference const reference =
        reference_by_samples(points, "Integrator \"direct\"\nSampler \"zsobol\"", lab.passes(4096));
    constexpr std::array kCounts{16, 256};
    std::vector<std::vector<std::string>> rows;
    double uniform = 0;
    for (char const* choice : kChoices) {
        auto const e = rmse_over_samples(points, direct(choice, "independent"), kCounts, lab.seeds(8),
                                         reference.picture);
        auto const v =
            variance_per_sample(points, direct(choice, "independent"), lab.passes(2048), lab.seeds(4));
        if (rows.empty()) uniform = v.relative;
        rows.push_back({fmt::format("`{}`", choice), percent(e[0]), percent(e[1]),
                        with_error(v.relative, v.error), number(uniform / v.relative)});
    }
    page.table({"`lightsampler`", "error at 16 samples", "at 256", "variance of a sample", "uniform / this"},
               rows);
    page.text("Error of the reference: " + percent(reference.error) +
              ". Receivers are the centres of pixels, and the lights that the camera sees have no part in "
              "the noise. Power says "
              "nothing about where a light is and where it looks: a near one is asked as often as a far one "
              "that is turned away.");
}

}  // namespace nephroid::experiment
