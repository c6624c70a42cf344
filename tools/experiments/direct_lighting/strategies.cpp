// Light sampling, scattering and both, under a small light and a large one.
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

struct Way {
    std::string name, parameters;
};
std::vector<Way> const& ways() {
    static std::vector<Way> const all{
        {"light, by area", R"("string strategy" "light" "string shapesampling" "area")"},
        {"light, by solid angle", R"("string strategy" "light" "string shapesampling" "solidangle")"},
        {"BSDF, uniform", R"("string strategy" "bsdf" "string hemisphere" "uniform")"},
        {"BSDF, cosine", R"("string strategy" "bsdf" "string hemisphere" "cosine")"},
        {"MIS of solid angle, cosine", R"("string strategy" "mis")"}};
    return all;
}

void one_light(Lab const& lab, std::string const& title, std::string const& file, float side) {
    Page& page = lab.page;
    int const n = lab.pixels(32);
    double const s = static_cast<double>(side);
    Setup const setup =
        prepare(scenes::floor_view(n, n, scenes::Pixels::Points, -1, 1, -1, 1) + scenes::matte(kReflectance) +
                scenes::floor() + scenes::square_light(1, side, 1));
    Reference const exact = closed_form(setup, [&](Vec3 p) {
        return kReflectance / std::numbers::pi *
               parallelogram_irradiance(p, {-s / 2, -s / 2, 1}, {0, s, 0}, {s, 0, 0});
    });
    std::vector<int> const counts{1, 2, 4, 8, 16, 32, 64, 128, 256};
    std::vector<double> const x(counts.begin(), counts.end());
    page.subsection(title);
    page.text(
        fmt::format("A square of side {} at a height of 1, above 2 × 2 units of the floor.", number(s, 2)));
    std::vector<std::vector<std::string>> rows;
    for (Way const& w : ways()) rows.push_back({w.name});
    for (std::string const sampler : {"independent", "zsobol"}) {
        std::vector<Line> lines;
        for (std::size_t i = 0; i < ways().size(); ++i) {
            auto const e = rmse_over_samples(
                setup, "Integrator \"direct\" " + ways()[i].parameters + "\nSampler \"" + sampler + "\"",
                counts, lab.seeds(8), exact.picture);
            std::string const slope = fixed(log_log_slope(x, e), 2);
            rows[i].insert(rows[i].end(), {percent(e[0]), percent(e[8]), slope});
            lines.push_back({ways()[i].name, x, e, "slope " + slope});
        }
        std::string const name = file + "-" + sampler + ".svg";
        page.save(name, line_plot(title + ", sampler " + sampler,
                                  {"samples a pixel", true, {1, 4, 16, 64, 256}}, {"relative RMSE"}, lines));
        page.image(name, title + ": relative RMSE over samples, sampler " + sampler);
    }
    page.table({"", "independent: 1 sample", "256", "slope", "zsobol: 1 sample", "256", "slope"}, rows);
}

}  // namespace

void strategies(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "A floor of reflectance 0.5 below a square light, nothing between them; the truth is Lambert's "
        "formula. The light is "
        "sampled, by area or by solid angle; or found by scattering, uniformly over the hemisphere or by the "
        "cosine; or by "
        "both ways at once, weighed by the power heuristic (MIS).");
    std::string code;
    for (Way const& w : ways()) code += fmt::format("Integrator \"direct\" {}  # {}\n", w.parameters, w.name);
    page.code(code + "Sampler \"independent|zsobol\"");
    one_light(lab, "A small light", "small-light", 0.2f);
    one_light(lab, "A large light", "large-light", 4);
    page.text(
        "Scattering meets a small light rarely, sampling always: the distance between the lines is what "
        "next-event "
        "estimation is for. A light that fills most of the sky is met by nearly every direction, and then "
        "points "
        "by area are the worst of all at one sample, for most of them are far off and seen slantwise. MIS is "
        "told "
        "neither, and stays near the better of its two ways; where that one is good enough alone, the second "
        "ray "
        "adds a little noise instead of taking some. With independent samples every line has slope −1/2. "
        "Sobol' points go down faster the smoother the integrand is over the square of random numbers: light "
        "that "
        "is always found is smooth, light that is found by chance has an edge.");
}

}  // namespace nephroid::experiment
