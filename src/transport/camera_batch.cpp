#include "camera_batch.h"

#include "path_trace.h"
#include "scene/match.h"

#include <algorithm>
#include <limits>
#include <new>

namespace nephroid {

namespace {

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

template <std::size_t... I>
CameraBatch::CameraBatch(RenderJob const& job, PassWork const& work, Film& film, RayStats& stats,
                         std::index_sequence<I...>)
    : job_(job),
      film_(film),
      stats_(stats),
      paths_{PathInFlight{{job, job.world(), {}, samples_[I].sampler, stats}, {}, {}, {}, {}}...},
      shadows_(job.world(), stats) {
    Integrator const& integrator = job.settings().integrator;
    bool const in_step = match(integrator, []<class Kind>(Kind const&) { return GoesInStep<Kind>; });
    for (std::size_t i = 0; i < kMostInStep; ++i) {
        PathInFlight& path = paths_[i];
        path.c.hemisphere = hemisphere_of(integrator);
        path.c.lights = lights_of(integrator);
        path.c.photons = work.photons.get();
        path.c.nearest = &nearest_;
        path.c.camera_hit = &path.met;
        path.c.shadows = &shadows_;
        path.c.path = static_cast<std::uint32_t>(i);
        path.v.drawn_ahead = in_step;
        if (film.has_aovs()) path.aov = &aovs_[i];
    }
}
CameraBatch::CameraBatch(RenderJob const& job, PassWork const& work, Film& film, RayStats& stats)
    : CameraBatch(job, work, film, stats, std::make_index_sequence<kMostInStep>{}) {}

void CameraBatch::add(int x, int y, std::uint64_t pass, std::uint64_t sample) {
    Sample& s = samples_[size_];
    s.x = x, s.y = y, s.pass = pass;
    // The pixel's own name, whatever the crop window or the resolution.
    std::uint64_t const pixel =
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32 | static_cast<std::uint32_t>(x);
    s.sampler = PathSampler(job_.sequence(), stream::kCamera, pixel, sample);
    if (++size_ == kMostInStep) run();
}

void CameraBatch::begin(std::size_t i) {
    Sample& s = samples_[i];
    PathContext& c = paths_[i].c;
    FilterSample const f = job_.filter().sample(s.on_film);
    s.filter_weight = f.weight;
    s.sampler.at(dimension::kLens);
    s.lens = job_.camera().has_lens() ? s.sampler.next_2d() : Vec2{0.5f, 0.5f};
    s.sampler.at(dimension::kWavelength);
    if (job_.prepares())
        c.lambda = job_.pass_wavelengths(s.pass);
    else if (job_.settings().color == ColorMode::Spectral)
        c.lambda = Wavelengths::spectral(s.sampler.next_1d());
    s.at = Vec2{static_cast<float>(s.x) + 0.5f, static_cast<float>(s.y) + 0.5f} + f.offset;
}

void CameraBatch::make_rays(std::size_t first) {
    std::size_t const n = std::min(kLanes, size_ - first);
    Vec2Lanes at;
    for (std::size_t i = 0; i < n; ++i) at.set(i, samples_[first + i].at);
    RayPacket& rays = rays_[first / kLanes];
    bool const together = job_.camera().rays(at, rays.o, rays.d);
    rays.used = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Sample& s = samples_[first + i];
        s.camera = together ? CameraRay{rays.ray(i), 1.0f} : job_.camera().ray(s.at, s.lens);
        rays.set(i, s.camera.ray, kInfinity);
    }
}

void CameraBatch::run(PathTrace* trace) {
    shadows_.begin();
    std::array<PathInFlight*, kMostInStep> going;
    for (std::size_t i = 0; i < size_; ++i) going[i] = &paths_[i];
    draw_2d({going.data(), size_}, dimension::kFilm,
            [&](PathInFlight const& path) -> Vec2& { return samples_[path.c.path].on_film; });
    for (std::size_t i = 0; i < size_; ++i) begin(i);
    for (std::size_t first = 0; first < size_; first += kLanes) make_rays(first);
    for (std::size_t i = 0; i < size_; ++i) {
        PathInFlight& path = paths_[i];
        path.c.tainted = false;
        path.c.trace = trace;
        path.seen = {};
        if (path.aov) *path.aov = {};
        // Not construct_at(), which would fill it with zeros before.
        (::new (&path.walk) Walk)->begin_at_camera(path.c, samples_[i].camera.ray);
        if (trace) trace->begins(path.c, samples_[i].at, samples_[i].camera);
    }
    trace_camera_rays();
    match(
        job_.settings().integrator, [](LightPathIntegrator const&) {},  // draws its picture elsewhere
        [&]<class Kind>(Kind const& integrator) {
            if constexpr (GoesInStep<Kind>)
                follow_paths(integrator, {going.data(), size_});
            else
                for (std::size_t i = 0; i < size_; ++i)
                    paths_[i].seen = radiance(integrator, paths_[i].c, samples_[i].camera.ray, paths_[i].aov);
        });
    shadows_.settle();
    for (std::size_t i = 0; i < size_; ++i) finish(i, trace);
    size_ = 0;
}

void CameraBatch::trace_camera_rays() {
    std::array<RawHit, kLanes> hits;
    for (std::size_t first = 0; first < size_; first += kLanes) {
        job_.world().intersect(rays_[first / kLanes], stats_, hits);
        for (std::size_t i = 0; i < std::min(kLanes, size_ - first); ++i) paths_[first + i].met = hits[i];
    }
}

void CameraBatch::finish(std::size_t i, PathTrace* trace) {
    Sample const& s = samples_[i];
    PathInFlight& path = paths_[i];
    path.seen += shadows_.arrived(i);
    Vec3 const value = path.c.tainted ? Vec3{std::numeric_limits<float>::quiet_NaN()}
                                      : sensor_value(job_, path.seen, s.camera.weight, path.c.lambda,
                                                     path.aov ? &path.aov->light : nullptr);
    if (trace) trace->ends(path.seen, value, s.filter_weight);
    if (path.aov) film_.add_aov(s.x, s.y, s.pass, *path.aov, s.filter_weight);
    if (!film_.add(s.x, s.y, value, s.filter_weight)) ++dropped_;
}

}  // namespace nephroid
