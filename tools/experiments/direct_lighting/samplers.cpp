// What the points alone change (Figure 11 of the report).
#include "points_shown.h"
#include "sections.h"

#include "closed_form.h"
#include "measure.h"
#include "plot.h"
#include "scenes.h"

#include <fmt/format.h>

#include <array>
#include <numbers>

namespace nephroid::experiment {

namespace {

constexpr float kReflectance = 0.5f;

struct Points {
    std::string name, directive;
};
std::vector<Points> const& kinds() {
    static std::vector<Points> const all{
        {"independent", R"(Sampler "independent")"},
        {"quadrant", R"(Sampler "quadrant")"},
        {"stratified, 4 × 4", R"(Sampler "stratified" "integer xsamples" 4 "integer ysamples" 4)"},
        {"stratified, 16 × 16", R"(Sampler "stratified" "integer xsamples" 16 "integer ysamples" 16)"},
        {"Sobol'", R"(Sampler "zsobol")"}};
    return all;
}

void errors(Lab const& lab, std::string const& title, std::string const& file, std::string const& what,
            Setup const& setup, Reference const& reference) {
    Page& page = lab.page;
    std::vector<int> const counts{1, 4, 16, 64, 256};
    std::vector<double> const x(counts.begin(), counts.end());
    page.subsection(title);
    page.text(what);
    std::vector<Line> lines;
    std::vector<std::vector<std::string>> rows;
    for (Points const& k : kinds()) {
        auto const e =
            rmse_over_samples(setup,
                              "Integrator \"direct\" \"string strategy\" \"light\" \"string shapesampling\" "
                              "\"area\"\n" +
                                  k.directive,
                              counts, lab.seeds(8), reference.picture);
        std::string const slope = fixed(log_log_slope(x, e), 2);
        lines.push_back({k.name, x, e, "slope " + slope});
        std::vector<std::string> row{k.name};
        for (double const v : e) row.push_back(percent(v));
        row.push_back(slope);
        rows.push_back(row);
    }
    page.save(file, line_plot(title, {"samples a pixel", true, x}, {"relative RMSE"}, lines));
    page.image(file, title + ": relative RMSE over samples by sampler");
    page.table({"", "1", "4", "16", "64", "256", "slope"}, rows);
    if (reference.error > 0) page.text("Error of the reference: " + percent(reference.error) + ".");
}

}  // namespace

void samplers(Lab const& lab) {
    Page& page = lab.page;
    points_shown(page);
    std::string code =
        "Integrator \"direct\" \"string strategy\" \"light\" \"string shapesampling\" \"area\"\n";
    for (Points const& k : kinds()) code += k.directive + "\n";
    page.code(code);

    int const n = lab.pixels(32);
    std::string const floor = scenes::floor_view(n, n, scenes::Pixels::Points, -1, 1, -1, 1) +
                              scenes::matte(kReflectance) + scenes::floor();
    Setup const open = prepare(floor + scenes::square_light(1, 1, 1));
    errors(lab, "Nothing in the way", "samplers-open.svg",
           "A square of side 1 at a height of 1 above 2 × 2 units of the floor, sampled by area: a smooth "
           "function of two "
           "random numbers. The truth is Lambert's formula.",
           open, closed_form(open, [](Vec3 p) {
               return kReflectance / std::numbers::pi *
                      parallelogram_irradiance(p, {-0.5, -0.5, 1}, {0, 1, 0}, {1, 0, 0});
           }));
    Setup const shadowed =
        prepare(floor + scenes::square_light(1, 1, 1.5f) +
                "AttributeBegin\nTranslate 0 0 0.9\nShape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n");
    errors(lab, "Half a shadow", "samplers-shadow.svg",
           "The square at a height of 1.5, and a ball of radius 0.3 at a height of 0.9 below it: what a "
           "receiver sees of the "
           "light has an edge.",
           shadowed,
           reference_by_samples(shadowed, "Integrator \"direct\"\nSampler \"zsobol\"", lab.passes(4096)));
    page.text(
        "A stratified sampler keeps its promise at whole blocks: 4 × 4 strata are good at 16 samples, and "
        "from there on blocks "
        "of 16 are independent of each other, so that the line turns back to slope −1/2; 16 × 16 strata are "
        "no better than "
        "chance until their 256 samples are there. Nobody has to know the number of Sobol' points "
        "beforehand: every prefix "
        "whose length is a power of two is stratified in all ways at once. Where the integrand has an edge "
        "all of them gain "
        "less.");
}

}  // namespace nephroid::experiment
