#include "runs.h"

#include "image/compare.h"
#include "sheet.h"

#include <cmath>
#include <stdexcept>

namespace nephroid::experiment {

namespace {

Run finished(RenderJob const& job, RenderControl const& control) {
    Film film = job.make_film();
    RenderResult result = render(job, control, film);
    if (film.tainted()) throw std::runtime_error("samples or rays were not numbers");
    return {picture(film), result.seconds, result.passes, std::move(result.photons)};
}

Settings seeded(Setup const& setup, std::string const& directives, std::uint64_t seed) {
    Settings s = with(setup.settings, directives);
    s.seed = seed;
    return s;
}

}  // namespace

Run run(Setup const& setup, std::string const& directives, std::uint64_t passes, std::uint64_t seed) {
    RenderControl control;
    control.passes = {0, passes};
    return finished(RenderJob(setup.world, seeded(setup, directives, seed)), control);
}

Run run_for(Setup const& setup, std::string const& directives, double seconds, std::uint64_t seed) {
    RenderControl control;
    control.passes = {0, 1u << 20};
    control.seconds = seconds;
    return finished(RenderJob(setup.world, seeded(setup, directives, seed)), control);
}

std::string time_taken(Lab const& lab, double seconds) {
    return lab.quick ? "not taken" : number(seconds) + " s";
}

PhotonCounts total(std::vector<PhotonCounts> const& by_light) {
    PhotonCounts sum;
    for (PhotonCounts const& c : by_light) sum.add(c);
    return sum;
}

std::uint64_t paths_that_store(Setup const& setup, std::string const& directives, ShotKind kind,
                               std::uint64_t photons) {
    RenderJob const job(setup.world, seeded(setup, directives, 1));
    // What a render shoots into its global map.
    if (kind == ShotKind::Global) kind = global_shot(job);
    double const stored = photons_per_path(job, kind).photons;
    if (!(stored > 0)) throw std::runtime_error("no photon is stored");
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(photons) / stored));
}

Setup sized_file(std::string const& name, int width, int height) {
    Setup setup = sized(prepare_file(name), width, height);
    setup.settings.color = ColorMode::Rgb;
    return setup;
}

Setup sized(Setup setup, int width, int height) {
    setup.settings.film.resolution = {width, height};
    return setup;
}

Setup at_centres(Setup setup) {
    setup.settings.filter = BoxFilter{{0.001f, 0.001f}};  // there is no smaller one
    return setup;
}

Setup box_with(std::string const& contents, int pixels) {
    Setup setup = faithful(cornell(pixels) + contents, scenes_folder());
    setup.settings.color = ColorMode::Rgb;
    return setup;
}

Setup cropped(Setup setup, double x0, double x1, double y0, double y1) {
    Vec2i const size = setup.settings.film.resolution;
    auto const at = [](double share, int side) { return static_cast<int>(std::lround(share * side)); };
    setup.settings.film.crop = {at(x0, size.x), at(x1, size.x), at(y0, size.y), at(y1, size.y)};
    return setup;
}

Picture exposed(Picture p, double share) {
    double const exposure = exposure_for(p, share);
    for (auto& color : p.rgb)
        for (double& v : color) v *= exposure;
    return p;
}

double relative_mse(Picture const& p, Picture const& reference) {
    return rel_mse(image_of(p), image_of(reference));
}

std::string thousands(std::uint64_t n) {
    return n < 1000 ? std::to_string(n) : number(static_cast<double>(n) / 1000) + "k";
}

}  // namespace nephroid::experiment
