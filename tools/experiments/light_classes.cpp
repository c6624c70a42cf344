#include "light_classes.h"

#include "render/render.h"

#include <cmath>
#include <stdexcept>

namespace nephroid::experiment {

namespace {

Picture average(Picture a, Picture const& b) {
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) a.rgb[i][c] = (a.rgb[i][c] + b.rgb[i][c]) / 2;
    return a;
}

Picture layer(Film const& film, std::size_t light_class) {
    Picture p{film.width(), film.height(), {}};
    auto const [x0, x1, y0, y1] = film.crop();
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            auto rgb = film.aov(x, y).light[light_class];
            for (double& v : rgb) v /= film.pixel(x, y).weight;
            p.rgb.push_back(rgb);
        }
    return p;
}

void check(ByClass const& p) {
    double sum = 0;
    for (Picture const& part : p.of) sum += mean(part);
    if (!(std::abs(sum - mean(p.whole)) <= 1e-5 * mean(p.whole)))
        throw std::runtime_error("the ways of light do not add up to the picture");
}

}  // namespace

ByClass render_by_class(Setup const& setup, std::string const& directives, std::uint64_t passes,
                        std::uint64_t seed) {
    Settings settings = with(setup.settings, directives);
    settings.seed = seed;
    settings.film.aovs = true;
    RenderJob const job(setup.world, settings);
    Film film = job.make_film();
    RenderControl control;
    control.passes = {0, passes};
    ByClass p;
    p.seconds = render(job, control, film).seconds;
    if (film.tainted()) throw std::runtime_error("samples or rays were not numbers");
    p.whole = picture(film);
    for (std::size_t i = 0; i < kLightClasses; ++i) p.of[i] = layer(film, i);
    check(p);
    return p;
}

ReferenceByClass reference_by_class(Setup const& setup, std::string const& directives, std::uint64_t passes) {
    ByClass a = render_by_class(setup, directives, passes, kReferenceSeeds[0]);
    ByClass const b = render_by_class(setup, directives, passes, kReferenceSeeds[1]);
    ReferenceByClass r{{}, relative_rmse(a.whole, b.whole) / 2};
    r.light.whole = average(std::move(a.whole), b.whole);
    for (std::size_t i = 0; i < kLightClasses; ++i) r.light.of[i] = average(std::move(a.of[i]), b.of[i]);
    r.light.seconds = a.seconds + b.seconds;
    return r;
}

std::array<double, kLightClasses> shares_of_error(ByClass const& p, ByClass const& reference) {
    std::array<double, kLightClasses> shares{};
    double all = 0;
    for (std::size_t i = 0; i < p.whole.rgb.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            double const d = p.whole.rgb[i][c] - reference.whole.rgb[i][c];
            all += d * d;
            for (std::size_t k = 0; k < kLightClasses; ++k)
                shares[k] += (p.of[k].rgb[i][c] - reference.of[k].rgb[i][c]) * d;
        }
    if (!(all > 0)) throw std::runtime_error("there is no error to share");
    for (double& s : shares) s /= all;
    return shares;
}

}  // namespace nephroid::experiment
