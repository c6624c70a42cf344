// Shapes that shine, and the hyperbolae of a lamp in a shade (Figure 4 of the report).
#include "sections.h"

#include "closed_form.h"
#include "plot.h"
#include "runs.h"
#include "sheet.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace nephroid::experiment {

namespace {

using Color = std::array<double, 3>;

constexpr char const* kPath = "Integrator \"path\" \"integer maxdepth\" 6\nSampler \"zsobol\"";
constexpr char const* kDirect =
    "Integrator \"direct\" \"string strategy\" \"light\"\nSampler \"independent\"";
constexpr double kReflectance = 0.6;

/// The third has its lamp in an object, which pbrt would leave dark: a note.
Setup view(std::string const& file, int width, int height) {
    std::string const name = "report/" + file + ".pbrt";
    return sized(file == "04-cylinder" ? prepare_noted(name, "each instance emits") : prepare_file(name),
                 width, height);
}

void add(Color& sum, double irradiance, double scale, Color const& color) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += irradiance * scale * color[c];
}

// The lights of the files, seen whole from the floor at p.

/// Of a sphere above the horizon, of radiance 1.
double sphere_irradiance(Vec3 p, Point const& centre, double radius) {
    double const x = centre[0] - p.x, y = centre[1] - p.y, z = centre[2] - p.z;
    return std::numbers::pi * radius * radius * z / std::pow(x * x + y * y + z * z, 1.5);
}
Color under_spheres(Vec3 p) {
    Color sum{};
    add(sum, sphere_irradiance(p, {-2.1, -0.5, 0.5}, 0.25), 8, {1, 0.55, 0.2});
    add(sum, sphere_irradiance(p, {0, 0.4, 2.2}, 0.4), 5, {1, 1, 1});
    add(sum, sphere_irradiance(p, {2.1, -0.2, 0.6}, 0.3), 5, {0.25, 0.5, 1});
    return sum;
}
Color under_box_and_quad(Vec3 p) {
    Color sum{};
    add(sum, box_irradiance(p, {-2, -0.4, 0.4}, {-1.2, 0.2, 0.9}), 4, {1, 0.6, 0.25});
    add(sum, parallelogram_irradiance(p, {1.6, 0.9, 0.25}, {0.7, -0.7, 0}, {-0.15, -0.15, 1.1}), 6,
        {0.3, 0.55, 1});
    return sum;
}

/// The floor before the lights, where nothing hides any of them.
std::vector<std::string> before_lights(Lab const& lab, std::string const& name, Setup setup,
                                       std::function<Color(Vec3)> const& irradiance) {
    setup = at_centres(std::move(setup));
    std::vector<bool> chosen;
    Color truth{};
    double count = 0;
    for (Vec3 const& p : positions(setup)) {
        bool const there = std::abs(p.z) < 1e-3f && p.y < -1.5f && p.y > -4 && std::abs(p.x) < 1.2f;
        chosen.push_back(there);
        if (!there) continue;
        count += 1;
        add(truth, kReflectance / std::numbers::pi, 1, irradiance(p));
    }
    auto const e = means_by_channel(setup, kDirect, lab.passes(512), lab.seeds(8), chosen);
    std::vector<std::string> row{name};
    for (std::size_t c = 0; c < 3; ++c)
        row.insert(row.end(), {number(truth[c] / count, 4), with_error(e[c].mean, e[c].error)});
    return row;
}

// The lamp of scenes/report/04-cylinder.pbrt: around the point (0, 0, 1.6), leaning by 12 degrees in the plane of the wall y = 0.6.
constexpr double kLight = 0.05, kLightEnd = 0.15, kShade = 0.3, kShadeEnd = 0.4, kWall = 0.6, kHeight = 1.6,
                 kLean = 12 * std::numbers::pi / 180;

/// Above 0 where the wall at (x, z) sees some of the light. The last that is seen past the shade's rim are the points at the light's
/// end where a line from the wall touches it: along that line they lie sqrt(R^2 - r^2) before the rim and sqrt(d^2 - r^2) before
/// the wall, d from the axis, and height above the light's end grows in proportion. d^2 is a square plus a constant: a hyperbola.
double beyond_edge(double x, double z) {
    double const along = std::abs(x * std::sin(kLean) + (z - kHeight) * std::cos(kLean));
    double const across = x * std::cos(kLean) - (z - kHeight) * std::sin(kLean);
    double const r2 = kLight * kLight;
    return along - kLightEnd -
           (kShadeEnd - kLightEnd) *
               std::sqrt((across * across + kWall * kWall - r2) / (kShade * kShade - r2));
}

/// Where the edge crosses a vertical of the wall, between a height that is dark and one that is lit.
double edge_height(double x, double dark, double lit) {
    for (int i = 0; i < 60; ++i) {
        double const middle = (dark + lit) / 2;
        (beyond_edge(x, middle) > 0 ? lit : dark) = middle;
    }
    return dark;
}

void hyperbolae(Lab const& lab) {
    Page& page = lab.page;
    int const width = lab.measured(192), height = lab.measured(144);
    Setup const setup = at_centres(view("04-cylinder", width, height));
    auto const where = positions(setup);
    Picture const p = render_picture(setup, kDirect, lab.passes(1024), 1);
    std::size_t lit_wrongly = 0, lit = 0, edges = 0;
    double square = 0, sum = 0, pixel = 0;
    std::array<Line, 2> formula{Line{"upper branch, formula", {}, {}}, Line{"lower branch, formula", {}, {}}};
    std::array<Line, 2> found{Line{"upper branch, found", {}, {}}, Line{"lower branch, found", {}, {}}};
    for (int x = 0; x < width; ++x)
        for (std::size_t const branch : {0u, 1u}) {
            int const step = branch == 0 ? -1 : 1;
            bool before_edge = true;
            for (int y = height / 2; y > 0 && y < height - 1; y += step) {
                auto const i = static_cast<std::size_t>(y * width + x);
                auto const last = static_cast<std::size_t>((y - step) * width + x);
                if (std::abs(where[i].y - static_cast<float>(kWall)) > 1e-3f) continue;  // the floor
                if (p.rgb[i][0] <= 0) continue;
                double const u = where[i].x, v = where[i].z;
                lit += 1;
                if (beyond_edge(u, v) < 0) lit_wrongly += 1;
                if (!before_edge) continue;
                before_edge = false;
                double const inside = v + (branch == 0 ? 2.0 : -2.0) * 2;
                double const truth = edge_height(u, kHeight - u * std::tan(kLean), inside);
                double const measured = (v + static_cast<double>(where[last].z)) / 2;
                pixel = std::abs(v - static_cast<double>(where[last].z));
                edges += 1, square += std::pow(measured - truth, 2);
                sum += branch == 0 ? measured - truth : truth - measured;
                formula[branch].x.push_back(u), formula[branch].y.push_back(truth);
                found[branch].x.push_back(u), found[branch].y.push_back(measured);
            }
        }
    page.save("hyperbolae.svg",
              line_plot("Where the light begins on the wall", {"x", false}, {"height", false},
                        {formula[0], found[0], formula[1], found[1]}, {}, false));
    page.image("hyperbolae.svg", "The edge of the light on the wall: the formula, and the first lit pixels");
    auto const n = static_cast<double>(edges);
    page.table({"the third view's edge", ""},
               {{"pixels that see light", std::to_string(lit)},
                {"of these beyond the hyperbola, where none should", std::to_string(lit_wrongly)},
                {"verticals that cross the edge", std::to_string(edges)},
                {"size of a pixel on the wall", number(pixel)},
                {"found edge minus hyperbola, root mean square", number(std::sqrt(square / n), 2)},
                {"the same, mean, towards the light", number(sum / n, 2)}});
    page.text(
        "The light begins at nothing: just inside the hyperbola a sliver of the lamp's end is seen, and at "
        "this many samples the first that hits it lies a pixel or so further in.");
}

}  // namespace

void emissive_shapes(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report's Figure 4: any shape may shine. Spheres; a box and a rectangle; and a cylinder within a "
        "shade, both open at both ends, as one object whose instance leans by 12°: its light leaves as two "
        "cones, and the wall cuts them in the two branches of a hyperbola.");
    page.code(std::string("# scenes/report/04-spheres.pbrt, 04-box-and-quad.pbrt, 04-cylinder.pbrt\n") +
              kPath);
    struct View {
        std::string name, file;
        double share;  // of the pixels that are not overexposed
    };
    std::array<View, 3> const views{View{"spheres", "04-spheres", 0.96},
                                    {"box and rectangle", "04-box-and-quad", 0.94},
                                    {"cylinder in a shade", "04-cylinder", 0.99}};
    std::uint64_t const samples = lab.quick ? 16 : 128;
    SheetRow row{"", {}, 1};
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;
    for (View const& v : views) {
        Setup const small = view(v.file, lab.measured(64), lab.measured(48));
        Reference const reference = reference_by_samples(small, kPath, lab.passes(1024));
        double const error =
            rmse_over_samples(small, kPath, std::array{16}, lab.seeds(4), reference.picture)[0];
        Run r = run(view(v.file, lab.pixels(200), lab.pixels(150)), kPath, samples);
        rows.push_back({v.name, number(mean(r.picture)), percent(error), percent(reference.error),
                        time_taken(lab, r.seconds)});
        labels.push_back(v.name);
        row.pictures.push_back(exposed(std::move(r.picture), v.share));
    }
    show_sheet(lab, "emissive-shapes.png", "Spheres, a box and a rectangle, a cylinder in a shade: all shine",
               labels, {row});
    page.table({"view", "mean radiance", "error at 16 samples", "of the reference",
                fmt::format("time, {} samples", samples)},
               rows);
    page.text(
        "Direct light on the floor before the first two views' lights, where each light is seen whole, "
        "against the closed forms of spheres and polygons:");
    page.table({"mean radiance", "red, formula", "measured", "green, formula", "measured", "blue, formula",
                "measured"},
               {before_lights(lab, views[0].name, view(views[0].file, lab.measured(96), lab.measured(72)),
                              under_spheres),
                before_lights(lab, views[1].name, view(views[1].file, lab.measured(96), lab.measured(72)),
                              under_box_and_quad)});
    hyperbolae(lab);
    page.text(
        "How many samples such lights need, by area and by solid angle: [soft "
        "shadows](../experiments/direct-lighting.md#soft-shadows), [the shapes of "
        "lights](../experiments/direct-lighting.md#the-shapes-of-lights).");
}

}  // namespace nephroid::experiment
