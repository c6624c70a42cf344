// Directions uniform over the hemisphere against directions by the cosine, measured and in theory.
#include "figures.h"

#include "measure.h"
#include "scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace nephroid::experiment {

namespace {

std::string direct(std::string const& hemisphere) {
    return "Integrator \"direct\" \"string strategy\" \"bsdf\" \"string hemisphere\" \"" + hemisphere +
           "\"\nSampler \"independent\"";
}

/// Mean of squares over the squared mean, of one sample.
double second_moment(SampleVariance const& v) { return v.relative + 1; }

}  // namespace

void hemispheres(Lab const& lab) {
    Page& page = lab.page;
    page.text("A diffuse floor under the open sky, light found by scattering alone:");
    page.code(direct("uniform|cosine"));
    int const n = lab.measured(32);
    std::string const floor = scenes::floor_view(n, n, scenes::Pixels::Points, -0.05f, 0.05f, -0.05f, 0.05f) +
                              scenes::matte(0.5f) + scenes::floor();
    int const seeds = lab.seeds(4);

    Setup const sky = prepare(floor + "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n");
    auto const u = variance_per_sample(sky, direct("uniform"), lab.passes(1024), seeds);
    auto const c = variance_per_sample(sky, direct("cosine"), lab.passes(1024), seeds);
    page.subsection("A constant sky");
    page.text(
        "A direction of density 1/2π makes the sample (ρ/π)·L·cosθ·2π = 2ρL·cosθ. Cosθ is then uniform in "
        "[0, 1], with mean "
        "1/2 and mean square 1/3: the mean is ρL and the variance (4/3 − 1)(ρL)². A direction of density "
        "cosθ/π makes every "
        "sample ρL.");
    page.table({"hemisphere", "variance / mean², measured", "theory"},
               {{"`uniform`", with_error(u.relative, u.error), number(1.0 / 3)},
                {"`cosine`", c.relative < 1e-12 ? "0 (to rounding)" : number(c.relative), "0"}});

    page.subsection("A small light at an angle");
    page.text(
        "A sphere of radius 1 at a distance of 10, θ away from the zenith. The light is met with probability "
        "Ω/2π by the one "
        "and Ω·cosθ/π by the other, and what a sample is worth is the mean over that probability; so the "
        "mean squares are as "
        "2·cosθ : 1. The cosine wins up to 60°, where both are equal; a light near the horizon is found more "
        "often by the "
        "uniform one.");
    std::vector<std::vector<std::string>> rows;
    for (int const degrees : {0, 30, 60, 75}) {
        double const theta = degrees * std::numbers::pi / 180;
        Setup const setup = prepare(
            floor + scenes::light(1, fmt::format("Translate {} 0 {}\nShape \"sphere\" \"float radius\" 1\n",
                                                 10 * std::sin(theta), 10 * std::cos(theta))));
        auto const by_uniform = variance_per_sample(setup, direct("uniform"), lab.passes(2048), seeds);
        auto const by_cosine = variance_per_sample(setup, direct("cosine"), lab.passes(2048), seeds);
        double const ratio = second_moment(by_uniform) / second_moment(by_cosine);
        double const error = ratio * std::hypot(by_uniform.error / second_moment(by_uniform),
                                                by_cosine.error / second_moment(by_cosine));
        rows.push_back({fmt::format("{}°", degrees), with_error(by_uniform.relative, by_uniform.error),
                        with_error(by_cosine.relative, by_cosine.error), with_error(ratio, error),
                        number(2 * std::cos(theta))});
    }
    page.table(
        {"θ", "variance / mean², uniform", "cosine", "ratio of mean squares, measured", "theory, 2 cosθ"},
        rows);
}

}  // namespace nephroid::experiment
