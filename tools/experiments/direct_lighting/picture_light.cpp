// A light whose radiance is a picture with one bright spot.
#include "sections.h"

#include "image/write.h"
#include "measure.h"
#include "plot.h"
#include "scenes.h"
#include "sheet.h"

#include <cmath>

namespace nephroid::experiment {

namespace {

constexpr int kSide = 64;

/// 0.05 all over, and 40 within a twentieth of the side around (0.7, 0.35).
void write_spot(std::filesystem::path const& path) {
    Image image(PixelFormat::Float, kSide, kSide, default_channel_names(3));
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            float const u = (static_cast<float>(x) + 0.5f) / kSide - 0.7f;
            float const v = (static_cast<float>(y) + 0.5f) / kSide - 0.35f;
            float const value = std::hypot(u, v) < 0.05f ? 40.0f : 0.05f;
            for (int c = 0; c < 3; ++c) image.set(x, y, c, value);
        }
    write_pfm(path, image);
}

std::string direct(std::string const& shapes, std::string const& sampler) {
    return "Integrator \"direct\" \"string strategy\" \"light\" \"string shapesampling\" \"" + shapes +
           "\"\nSampler \"" + sampler + "\"";
}

std::string lamp() {
    return "AttributeBegin\n" + scenes::matte(0) +
           "AreaLightSource \"diffuse\" \"string filename\" \"spot.pfm\"\n"
           "Shape \"quad\" \"point3 origin\" [ -1 -1 1 ] \"vector3 u\" [ 0 2 0 ] \"vector3 v\" [ 2 0 0 "
           "]\nAttributeEnd\n";
}

}  // namespace

void picture_light(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "A square of side 2 at a height of 1 above 3 × 3 units of the floor, whose radiance is a picture of "
        "64 × 64 pixels: "
        "0.05 all over, and 40 in a spot of a twentieth of its side, which sends most of the light. A ball "
        "of radius 0.15 at a "
        "height of 0.6 throws the spot's shadow. The floor is seen from above; pictures: 16 samples, and the "
        "limit.");
    page.code(direct("area|solidangle", "independent"));
    write_spot(lab.scratch / "spot.pfm");
    auto const setup = [&](int n, scenes::Pixels pixels) {
        return prepare(scenes::floor_view(n, n, pixels, -1.5f, 1.5f, -1.5f, 1.5f) + scenes::matte(0.5f) +
                           scenes::floor() + lamp() +
                           "AttributeBegin\nTranslate -0.3 0.1 0.6\nShape \"sphere\" \"float radius\" "
                           "0.15\nAttributeEnd\n",
                       lab.scratch);
    };
    Setup const whole = setup(lab.pixels(150), scenes::Pixels::Whole);
    SheetRow row{"", {}, 1};
    for (std::string const shapes : {"area", "solidangle"})
        row.pictures.push_back(render_picture(whole, direct(shapes, "independent"), 16, 1));
    row.pictures.push_back(render_picture(whole, direct("solidangle", "zsobol"), lab.passes(512), 1));
    row.exposure = exposure_for(row.pictures.back());
    show_sheet(lab, "picture-light.png",
               "The floor below the picture at 16 samples, by area and by default; and the limit",
               {"area", "default", lab.quick ? "16" : "512 samples"}, {row});

    Setup const points = setup(lab.pixels(32), scenes::Pixels::Points);
    Reference const reference =
        reference_by_samples(points, "Integrator \"direct\"\nSampler \"zsobol\"", lab.passes(4096));
    constexpr std::array kCounts{16, 256};
    std::vector<std::vector<std::string>> rows;
    double by_area = 0;
    for (std::string const shapes : {"area", "solidangle"}) {
        auto const e = rmse_over_samples(points, direct(shapes, "independent"), kCounts, lab.seeds(4),
                                         reference.picture);
        auto const v =
            variance_per_sample(points, direct(shapes, "independent"), lab.passes(4096), lab.seeds(4));
        if (rows.empty()) by_area = v.relative;
        rows.push_back({shapes == "area" ? "`area`" : "`solidangle`, the default", percent(e[0]),
                        percent(e[1]), with_error(v.relative, v.error), number(by_area / v.relative)});
    }
    page.table({"`shapesampling`", "error at 16 samples", "at 256", "variance of a sample", "area / this"},
               rows);
    page.text(
        "Error of the reference: " + percent(reference.error) +
        ". To a way that does not look into the picture the spot is a small light that it meets by chance.");
}

}  // namespace nephroid::experiment
