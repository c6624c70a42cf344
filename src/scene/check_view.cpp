// The camera and the settings.
#include "check.h"
#include "scene/match.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

constexpr int kMaxSide = 65536;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

void check_lens(Check const& c, float radius, float distance) {
    c.require(radius >= 0, "the lens radius must not be negative");
    c.require(distance > 0, "the focal distance must be above 0");
}

/// Filters are tabulated at 64 cells a pixel: what is finer than that, or wider than any picture needs, would become a
/// table of zeros, or one that does not fit into memory.
void check_filter(Check const& c, Filter const& filter) {
    check_finite(c, filter, "the pixel filter");
    match(filter, [&](auto const& f) {
        c.require(std::min(f.radius.x, f.radius.y) >= 0.001f && std::max(f.radius.x, f.radius.y) <= 64,
                  "the pixel filter's radii must be above 0 (from 0.001 to 64 pixels)");
        if constexpr (requires { f.sigma; })
            c.require(
                f.sigma >= 0.001f && f.sigma <= 100 * std::min(f.radius.x, f.radius.y),
                "the gaussian filter's sigma must be above 0 (from 0.001 pixels to 100 times its radius)");
        if constexpr (requires { f.tau; })
            c.require(f.tau >= 0.01f, "the sinc filter's tau must be above 0 (at least 0.01)");
        if constexpr (requires { f.b; })
            c.require(std::abs(f.b) <= 10 && std::abs(f.c) <= 10,
                      "the mitchell filter's B and C must be from -10 to 10 (1/3 each is usual)");
    });
}

void check_sampler(Check const& c, Sampler const& sampler) {
    auto const* s = std::get_if<StratifiedSampler>(&sampler);
    if (!s) return;
    c.require(s->x_strata >= 1 && s->y_strata >= 1,
              "the stratified sampler needs at least one stratum a side");
    if (std::int64_t{s->x_strata} * s->y_strata > kMaxPixels)
        c.limit("the stratified sampler has more than 2^28 strata: use fewer");
}

void check_film(Check const& c, FilmSettings const& film) {
    auto const [width, height] = std::array{film.resolution.x, film.resolution.y};
    c.require(width >= 1 && height >= 1, "the picture must be at least 1 pixel wide and high");
    if (width > kMaxSide || height > kMaxSide || std::int64_t{width} * height > kMaxPixels)
        c.limit(
            "the picture may be at most 65536 pixels wide and high, and have 2^28 pixels: make it smaller");
    if (film.crop) {
        auto const [x0, x1, y0, y1] = *film.crop;
        c.require(0 <= x0 && x0 < x1 && x1 <= width && 0 <= y0 && y0 < y1 && y1 <= height,
                  "the crop window must lie inside the picture and hold at least one pixel");
    }
    c.require(film.iso > 0 && std::isfinite(film.iso), "the film's ISO speed must be above 0 and finite");
    c.require(film.white_balance >= 0 && std::isfinite(film.white_balance),
              "the white balance must be a temperature in kelvin, or 0 for none");
    c.require(film.max_component > 0, "the largest component of a sample must be above 0");
}

}  // namespace

void check_camera(Check const& c, Camera const& camera) {
    check_matrix(c, camera.to_world, "the camera's transform");
    check_finite(c, camera, "the camera");
    match(
        camera.kind,
        [&](PerspectiveCamera const& k) {
            c.require(k.fov > 0 && k.fov < kPi, "the camera's fov must lie between 0 and 180 degrees");
            check_lens(c, k.lens_radius, k.focal_distance);
        },
        [&](OrthographicCamera const& k) { check_lens(c, k.lens_radius, k.focal_distance); },
        [](SphericalCamera const&) {});
    if (camera.screen_window) {
        auto const [x0, x1, y0, y1] = *camera.screen_window;
        c.require(x0 < x1 && y0 < y1, "the camera's screen window is empty: give x0 < x1 and y0 < y1");
    }
    c.require(!camera.frame_aspect_ratio || *camera.frame_aspect_ratio > 0,
              "the camera's frame aspect ratio must be above 0");
    c.require(camera.exposure_time >= 0, "the camera's shutter closes before it opens: swap the times");
}

namespace {

/// Each photon of an estimate has its place in every thread.
constexpr int kMostUsed = 1 << 24;

void check_photons(Check const& c, PhotonShooting const& shooting, PhotonEstimates const& estimates,
                   float alpha) {
    c.require(shooting.global_paths >= -1 && shooting.caustic_paths >= -1,
              "the number of photon paths must not be negative");
    c.require(shooting.max_depth >= 0, "the integrator's maxphotondepth must not be negative");
    c.require(estimates.nused >= 0, "the integrator's nused must not be negative");
    c.require(estimates.nused != 1,
              "an estimate by 1 photon knows nothing, for the farthest only tells the radius: nused must be "
              "0, for all "
              "within the radius, or at least 2");
    if (estimates.nused > kMostUsed)
        c.limit("an estimate uses at most 2^24 photons: make nused smaller, or 0 for all within the radius");
    c.require(estimates.radius >= 0 && estimates.caustic_radius >= 0,
              "the photons' radius must be above 0, or 0 for one that suits the scene");
    c.require(alpha > 0 && alpha <= 1, "the integrator's alpha must be above 0 and at most 1");
}

}  // namespace

void check_settings(Check const& c, Settings const& settings) {
    check_filter(c.at(settings.filter_where), settings.filter);
    check_sampler(c.at(settings.sampler_where), settings.sampler);
    check_film(c.at(settings.film.where), settings.film);
    c.at(settings.sampler_where).require(settings.spp >= 1, "there must be at least 1 sample a pixel");
    Check const here = c.at(settings.integrator_where);
    match(settings.integrator, [&](auto const& integrator) {
        check_finite(here, integrator, "the integrator");
        if constexpr (requires { integrator.max_depth; })
            here.require(integrator.max_depth >= 0, "the integrator's maxdepth must not be negative");
        if constexpr (requires { integrator.roulette; })
            here.require(integrator.roulette.alpha > 0 && integrator.roulette.alpha <= 1,
                         "the probability of Russian roulette must be above 0 and at most 1");
        if constexpr (requires { integrator.shooting; })
            check_photons(here, integrator.shooting, integrator.estimates, integrator.alpha);
        if constexpr (requires { integrator.gather_samples; })
            here.require(integrator.gather_samples >= 1,
                         "the integrator's finalgathersamples must be at least 1");
        if constexpr (requires { integrator.passes; })
            here.require(integrator.passes >= 1, "the integrator's passes must be at least 1");
        if constexpr (requires { integrator.paths; })
            here.require(integrator.paths == -1 || integrator.paths >= 1,
                         "the integrator's lightpaths must be at least 1");
    });
}

}  // namespace nephroid
