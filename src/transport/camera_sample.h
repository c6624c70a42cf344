// What a pass does for one pixel. The code is here so that a render has it where it is called, without a trace, and costs nothing for
// what a replay asks: each of the two files that include this compiles its own.
#pragma once

#include "path_trace.h"
#include "scene/match.h"
#include "transport/render_pass.h"
#include "walk.h"

#include <limits>

namespace nephroid {

static HemisphereSampling hemisphere_of(Integrator const& integrator) {
    return match(integrator, [](auto const& i) {
        if constexpr (requires { i.hemisphere; }) return i.hemisphere;
        return HemisphereSampling::Cosine;
    });
}
static LightSampling lights_of(Integrator const& integrator) {
    return match(integrator, [](auto const& i) { return i.lights; });
}

/// The sensor's value of one camera sample, linear sRGB, and by class what it is the sum of.
static Vec3 sensor_value(RenderJob const& job, SeenLight const& seen, float weight, Wavelengths const& lambda,
                         std::array<Vec3, kLightClasses>* by_class) {
    Vec3 rgb = job.sensor()(seen.total() * weight, lambda);
    float const m = max_component(rgb);
    float const most = job.settings().film.max_component;
    float const scale = m > most ? most / m : 1.0f;
    if (m > most) rgb *= scale;
    if (by_class && is_finite(rgb))
        for (std::size_t i = 0; i < kLightClasses; ++i)
            (*by_class)[i] = job.sensor()(seen.of[i] * weight, lambda) * scale;
    return rgb;
}

/// Sample `sample` of a pixel, which belongs to `pass`, into the film; false when it was not finite and was dropped. `trace` hears of
/// its path, unless null.
static bool add_camera_sample(RenderJob const& job, PassWork const& work, int x, int y, std::uint64_t pass,
                              std::uint64_t sample, NearestPhotons& nearest, Film& film, RayStats& stats,
                              PathTrace* trace) {
    Settings const& settings = job.settings();
    bool const wants_aovs = film.has_aovs();
    // The pixel's own name, whatever the crop window or the resolution.
    std::uint64_t const pixel =
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32 | static_cast<std::uint32_t>(x);
    PathSampler sampler(job.sequence(), stream::kCamera, pixel, sample);
    sampler.at(dimension::kFilm);
    FilterSample const f = job.filter().sample(sampler.next_2d());
    sampler.at(dimension::kLens);
    Vec2 const lens = job.camera().has_lens() ? sampler.next_2d() : Vec2{0.5f, 0.5f};
    sampler.at(dimension::kWavelength);
    Wavelengths const lambda = job.prepares()                     ? job.pass_wavelengths(pass)
                               : settings.color == ColorMode::Rgb ? Wavelengths::rgb()
                                                                  : Wavelengths::spectral(sampler.next_1d());
    Vec2 const at = Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} + f.offset;
    CameraRay const camera = job.camera().ray(at, lens);
    PathContext c{job,
                  job.world(),
                  lambda,
                  sampler,
                  stats,
                  hemisphere_of(settings.integrator),
                  lights_of(settings.integrator),
                  work.photons.get(),
                  &nearest};
    c.trace = trace;
    if (trace) trace->begins(c, at, camera);
    AovSample aov;
    SeenLight const seen = match(
        settings.integrator, [](LightPathIntegrator const&) { return SeenLight{}; },
        [&](auto const& integrator) {
            return radiance(integrator, c, camera.ray, wants_aovs ? &aov : nullptr);
        });
    Vec3 const value =
        c.tainted ? Vec3{std::numeric_limits<float>::quiet_NaN()}
                  : sensor_value(job, seen, camera.weight, lambda, wants_aovs ? &aov.light : nullptr);
    if (trace) trace->ends(seen, value, f.weight);
    if (wants_aovs) film.add_aov(x, y, pass, aov, f.weight);
    return film.add(x, y, value, f.weight);
}

}  // namespace nephroid
