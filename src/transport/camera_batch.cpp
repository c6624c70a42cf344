#include "camera_batch.h"

#include "path_trace.h"
#include "scene/match.h"

#include <algorithm>
#include <limits>

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

CameraBatch::CameraBatch(RenderJob const& job, PassWork const& work, Film& film, RayStats& stats)
    : job_(job),
      work_(work),
      film_(film),
      stats_(stats),
      hemisphere_(hemisphere_of(job.settings().integrator)),
      lights_(lights_of(job.settings().integrator)),
      shadows_(job.world(), stats) {}

void CameraBatch::add(int x, int y, std::uint64_t pass, std::uint64_t sample) {
    Sample& s = samples_[size_];
    s.x = x, s.y = y, s.pass = pass;
    // The pixel's own name, whatever the crop window or the resolution.
    std::uint64_t const pixel =
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32 | static_cast<std::uint32_t>(x);
    s.sampler = PathSampler(job_.sequence(), stream::kCamera, pixel, sample);
    s.sampler.at(dimension::kFilm);
    FilterSample const f = job_.filter().sample(s.sampler.next_2d());
    s.filter_weight = f.weight;
    s.sampler.at(dimension::kLens);
    Vec2 const lens = job_.camera().has_lens() ? s.sampler.next_2d() : Vec2{0.5f, 0.5f};
    s.sampler.at(dimension::kWavelength);
    s.lambda = job_.prepares()                           ? job_.pass_wavelengths(pass)
               : job_.settings().color == ColorMode::Rgb ? Wavelengths::rgb()
                                                         : Wavelengths::spectral(s.sampler.next_1d());
    s.at = Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} + f.offset;
    s.camera = job_.camera().ray(s.at, lens);
    if (++size_ == samples_.size()) run();
}

void CameraBatch::run(PathTrace* trace) {
    std::array<RawHit, kLanes> first;
    for (std::size_t begin = 0; begin < size_; begin += kLanes) {
        std::size_t const end = std::min(begin + kLanes, size_);
        RayPacket rays;
        for (std::size_t i = begin; i < end; ++i) rays.set(i - begin, samples_[i].camera.ray, kInfinity);
        job_.world().intersect(rays, stats_, first);
        for (std::size_t i = begin; i < end; ++i) follow(i, first[i - begin], trace);
    }
    shadows_.settle();
    for (std::size_t i = 0; i < size_; ++i) finish(i, trace);
    size_ = 0;
}

void CameraBatch::follow(std::size_t i, RawHit const& first, PathTrace* trace) {
    Sample& s = samples_[i];
    PathContext c{job_,    job_.world(),        s.lambda, s.sampler, stats_, hemisphere_,
                  lights_, work_.photons.get(), &nearest_};
    c.camera_hit = &first;
    c.shadows = &shadows_;
    c.trace = trace;
    if (trace) trace->begins(c, s.at, s.camera);
    AovSample* aov = nullptr;
    if (film_.has_aovs()) {
        aovs_[i] = {};
        aov = &aovs_[i];
    }
    shadows_.begin_path(i);
    s.seen = match(
        job_.settings().integrator, [](LightPathIntegrator const&) { return SeenLight{}; },
        [&](auto const& integrator) { return radiance(integrator, c, s.camera.ray, aov); });
    s.tainted = c.tainted;
}

void CameraBatch::finish(std::size_t i, PathTrace* trace) {
    Sample& s = samples_[i];
    bool const wants_aovs = film_.has_aovs();
    s.seen += shadows_.arrived(i);
    Vec3 const value = s.tainted ? Vec3{std::numeric_limits<float>::quiet_NaN()}
                                 : sensor_value(job_, s.seen, s.camera.weight, s.lambda,
                                                wants_aovs ? &aovs_[i].light : nullptr);
    if (trace) trace->ends(s.seen, value, s.filter_weight);
    if (wants_aovs) film_.add_aov(s.x, s.y, s.pass, aovs_[i], s.filter_weight);
    if (!film_.add(s.x, s.y, value, s.filter_weight)) ++dropped_;
}

}  // namespace nephroid
