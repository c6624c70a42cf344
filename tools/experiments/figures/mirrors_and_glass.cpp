// Delta reflection and refraction (Figures 9 and 10 of the report), with Fresnel's equations and without; and the equations
// themselves, read off a sphere under a white sky.
#include "figures.h"
#include "runs.h"

#include "closed_form.h"
#include "plot.h"
#include "sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace nephroid::experiment {

namespace {

struct Way {
    std::string label, file;
};
struct Figure {
    std::string sheet, alt;
    std::vector<Way> ways;
};
std::array<Figure, 2> const kFigures{
    {{"reflection.png",
      "A ball in the Cornell box: a mirror without Fresnel's equations, silver and copper",
      {{"mirror, f=1", "09-mirror"}, {"silver", "09-silver"}, {"copper", "09-copper"}}},
     {"refraction.png",
      "A ball in the Cornell box: glass without Fresnel's equations, glass and diamond",
      {{"glass, f=0", "10-glass-without-fresnel"},
       {"glass 1.5", "10-glass"},
       {"diamond 2.42", "10-diamond"}}}}};

void pictures(Lab const& lab) {
    std::string const directives = fmt::format(
        "Integrator \"photonmap\" \"integer indirectphotons\" {} \"integer causticphotons\" {} \"integer "
        "nused\" "
        "80 \"integer maxspeculardepth\" 16 \"integer finalgathersamples\" 4\n"
        "Sampler \"zsobol\" \"integer pixelsamples\" 36",
        lab.quick ? 2000 : 200000, lab.quick ? 6000 : 600000);
    lab.page.code(directives);
    std::vector<std::vector<std::string>> rows;
    double exposure = 0;
    for (Figure const& f : kFigures) {
        SheetRow row{"", {}, 1};
        std::vector<std::string> labels;
        for (Way const& w : f.ways) {
            Setup const setup = sized_file("report/" + w.file + ".pbrt", lab.pixels(200), lab.pixels(200));
            Run r = run(setup, directives, 1);
            labels.push_back(w.label);
            rows.push_back({w.label + ": `scenes/report/" + w.file + ".pbrt`", number(mean(r.picture)),
                            time_taken(lab, r.seconds)});
            row.pictures.push_back(std::move(r.picture));
        }
        if (exposure == 0) exposure = exposure_for(row.pictures.front(), 0.9);
        row.exposure = exposure;
        show_sheet(lab, f.sheet, f.alt, labels, {row});
    }
    lab.page.table({"", "mean radiance", "time"}, rows);
    lab.page.text(
        "Without Fresnel's equations a mirror throws back all light, and a glass lets all of it pass (but "
        "for "
        "total reflection): it has no lamp in its front and no rim. Caustics come from a photon map.");
}

/// Reflectance over the angle, from the pixels of a sphere on the row through its middle.
struct Profile {
    Line measured;
    double off = 0;  // the largest difference
};
Profile profile(Lab const& lab, std::string const& name, std::string const& material,
                std::complex<double> index) {
    // One row of pixels, each but its centre: then a pixel is one angle.
    int const n = lab.pixels(60);
    Setup const setup = faithful(
        fmt::format("Option \"string color\" \"rgb\"\nFilm \"rgb\" \"integer xresolution\" {} \"integer "
                    "yresolution\" 1\nPixelFilter \"box\" \"float xradius\" 0.001 \"float yradius\" 0.001\n"
                    "LookAt 0 -4 0  0 0 0  0 0 1\nCamera \"orthographic\" \"float screenwindow\" [ 0 1 "
                    "-0.001 0.001 ]\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n",
                    n) +
            material + "\n" + "Shape \"sphere\"\n",
        ".");
    std::uint64_t const passes = lab.passes(4096);
    Picture const p = render_picture(setup, "Integrator \"path\"\nSampler \"zsobol\"", passes, 1);
    Profile r{{name, {}, {}, {}}, 0};
    for (int i = 0; i < n; ++i) {
        double const x = (i + 0.5) / n;
        double const angle = std::asin(x) * 180 / std::numbers::pi;
        double const truth = fresnel_reflectance(std::sqrt(1 - x * x), index);
        double const value = p.rgb[static_cast<std::size_t>(i)][1];
        r.off = std::max(r.off, std::abs(value - truth));
        if (i % 3 == 1) r.measured.x.push_back(angle), r.measured.y.push_back(value);
    }
    return r;
}

void curves(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "Fresnel's reflectance can be read off a picture: a sphere under a white sky shows at the distance "
        "sin θ from its middle what comes back at the angle θ. (So that nothing but the first reflection "
        "comes back from glass, the light inside is absorbed.)");
    auto const conductor = [&](std::string const& name, double eta, double k) {
        return profile(
            lab, fmt::format("{}, {} + {}i", name, eta, k),
            fmt::format(R"(Material "conductor" "rgb eta" [ {0} {0} {0} ] "rgb k" [ {1} {1} {1} ])", eta, k),
            {eta, k});
    };
    auto const dielectric = [&](std::string const& name, double eta) {
        return profile(lab, fmt::format("{}, {}", name, eta),
                       fmt::format(R"(Material "dielectric" "float eta" {} "float absorption" 1e6)", eta),
                       eta);
    };
    std::array const profiles{conductor("copper-like", 0.2, 2.6), conductor("iron-like", 2.9, 3.1),
                              dielectric("diamond", 2.42), dielectric("glass", 1.5)};
    std::vector<Line> lines;
    std::vector<std::vector<std::string>> rows;
    for (Profile const& p : profiles) {
        lines.push_back(p.measured);
        auto const at = [&](std::size_t i) { return number(p.measured.y[i]); };
        rows.push_back({p.measured.name, at(0), at(p.measured.y.size() / 2), at(p.measured.y.size() - 1),
                        number(p.off, 2)});
    }
    page.save("fresnel.svg",
              line_plot("Fresnel's reflectance", {"angle, degrees", false, {0, 20, 40, 60, 80}},
                        {"reflectance", false}, lines));
    page.image("fresnel.svg", "Reflectance over the angle, as rendered");
    auto const angle = [&](std::size_t i) { return "at " + number(profiles[0].measured.x[i]) + "°"; };
    std::size_t const n = profiles[0].measured.x.size();
    page.table({"eta + ik", angle(0), angle(n / 2), angle(n - 1), "largest difference to the formula"}, rows);
    page.text(
        "The formula: Fresnel's two amplitudes in complex numbers of double precision, written for this page "
        "(`tools/experiments/closed_form.cpp`) and unknown to the renderer. Paths choose by chance whether "
        "they enter glass; metals leave nothing to choose.");
}

}  // namespace

void mirrors_and_glass(Lab const& lab) {
    lab.page.text("The report's Figures 9 and 10: delta reflection and delta refraction.");
    pictures(lab);
    curves(lab);
}

}  // namespace nephroid::experiment
