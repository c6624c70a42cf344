#include "transport/render_pass.h"

#include "camera_sample.h"
#include "light_path_image.h"
#include "path_trace.h"
#include "photon_maps.h"
#include "photon_plan.h"
#include "scene/match.h"
#include "walk.h"

#include <algorithm>
#include <limits>

namespace nephroid {

namespace {

Sequence sequence_of(Settings const& s) {
    Sequence q;
    q.seed = s.seed;
    match(
        s.sampler, [&](SobolSampler const&) { q.kind = SequenceKind::Sobol; },
        [&](StratifiedSampler const& t) {
            q.kind = SequenceKind::Stratified;
            q.x_strata = static_cast<std::uint32_t>(t.x_strata);
            q.y_strata = static_cast<std::uint32_t>(t.y_strata);
            q.jitter = t.jitter;
        },
        [&](IndependentSampler const&) { q.kind = SequenceKind::Independent; });
    return q;
}

PreparedCamera camera_of(World const& world, Settings const& settings) {
    auto c = PreparedCamera::make(world.scene().camera, settings.film.resolution);
    if (!c)
        world.scene().fail(world.scene().camera.where,
                           "the camera's transform cannot be inverted; check LookAt and Scale");
    return *c;
}

HemisphereSampling hemisphere_of(Integrator const& integrator) {
    return match(integrator, [](auto const& i) {
        if constexpr (requires { i.hemisphere; }) return i.hemisphere;
        return HemisphereSampling::Cosine;
    });
}
LightSampling lights_of(Integrator const& integrator) {
    return match(integrator, [](auto const& i) { return i.lights; });
}

/// The sensor's value of one camera sample, linear sRGB, and by class what it is the sum of.
Vec3 sensor_value(RenderJob const& job, SeenLight const& seen, float weight, Wavelengths const& lambda,
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

}  // namespace

RenderJob::RenderJob(World const& world, Settings const& settings)
    : world_(&world),
      settings_(settings),
      camera_(camera_of(world, settings)),
      filter_(settings.filter),
      sequence_(sequence_of(settings)),
      light_sequence_(sequence_),
      // pbrt-v4: exposure time * ISO / 100, so that the defaults leave radiance as it is.
      sensor_(world.scene().camera.exposure_time * settings.film.iso / 100.0f,
              settings.film.white_balance > 0 ? std::optional<float>(settings.film.white_balance)
                                              : std::nullopt) {
    light_sequence_.jitter = true;
    Vec2i const r = settings.film.resolution;
    crop_ = settings.film.crop.value_or(std::array<int, 4>{0, r.x, 0, r.y});
    crop_ = {std::max(0, crop_[0]), std::min(r.x, crop_[1]), std::max(0, crop_[2]), std::min(r.y, crop_[3])};
    if (crop_[0] >= crop_[1] || crop_[2] >= crop_[3])
        throw Error(ErrorKind::Input,
                    "the crop window holds no pixel of the picture; give x0,y0,x1,y1 inside the resolution");
    RayStats uncounted;
    if (world.encloses()) interiors_ = interiors_at(world, camera_.position(), uncounted);
    if (auto plan = make_photon_plan(*this)) {
        plan_ = plan;
        find_radii(*this, *plan);
    }
}

Film RenderJob::make_film() const {
    return Film(settings_.film.resolution, crop_, settings_.film.aovs,
                {world_->scene_hash(), hash(settings_), settings_.seed});
}

bool RenderJob::prepares() const {
    return plan_ || std::holds_alternative<LightPathIntegrator>(settings_.integrator);
}

Wavelengths RenderJob::pass_wavelengths(std::uint64_t i) const {
    if (settings_.color == ColorMode::Rgb) return Wavelengths::rgb();
    PathSampler sampler(sequence_, stream::kWavelengths, 0, i);
    return Wavelengths::spectral(sampler.next_1d());
}

bool add_camera_sample(RenderJob const& job, PassWork const& work, int x, int y, std::uint64_t pass,
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

std::uint64_t render_tile(RenderJob const& job, PassWork const& work, Tile const& tile, PassRange passes,
                          Film& film, RayStats& stats) {
    auto const samples = static_cast<std::uint64_t>(samples_per_pass(job.settings()));
    std::uint64_t dropped = 0;
    if (work.light_paths) {
        // The pass is one sample of every pixel: the sum of what was splatted there.
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                if (!film.add(x, y, work.light_paths->total(x, y), 1)) ++dropped;
                if (!film.has_aovs()) continue;
                AovSample aov;
                aov.light = work.light_paths->at(x, y);
                film.add_aov(x, y, passes.begin, aov, 1);
            }
        return dropped;
    }
    NearestPhotons nearest;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            for (std::uint64_t pass = passes.begin; pass < passes.end; ++pass)
                for (std::uint64_t k = pass * samples; k < (pass + 1) * samples; ++k)
                    if (!add_camera_sample(job, work, x, y, pass, k, nearest, film, stats, nullptr))
                        ++dropped;
    return dropped;
}

void render_pass(RenderJob const& job, std::uint64_t i, Film& film, RayStats& stats) {
    auto const crop = job.crop();
    auto const work = prepare_pass(job, i, {});
    film.add_dropped(render_tile(job, *work, {crop[0], crop[1], crop[2], crop[3]}, {i, i + 1}, film, stats));
    film.finish_pass(i);
}

}  // namespace nephroid
