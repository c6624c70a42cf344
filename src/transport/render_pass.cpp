#include "transport/render_pass.h"

#include "camera_batch.h"
#include "light_path_image.h"
#include "photon_maps.h"
#include "photon_plan.h"
#include "scene/match.h"
#include "walk.h"

#include <algorithm>

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
        find_onward(*this, *plan);
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

TileRenderer::TileRenderer(RenderJob const& job, PassWork const& work, Film& film, RayStats& stats)
    : job_(job), work_(work), film_(film) {
    if (!work.light_paths) camera_ = std::make_unique<CameraBatch>(job, work, film, stats);
}
TileRenderer::~TileRenderer() = default;

std::uint64_t TileRenderer::add(Tile const& tile, PassRange passes) {
    if (!camera_) return add_light_paths(tile, passes);
    auto const samples = static_cast<std::uint64_t>(samples_per_pass(job_.settings()));
    std::uint64_t const before = camera_->dropped();
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            for (std::uint64_t pass = passes.begin; pass < passes.end; ++pass)
                for (std::uint64_t k = pass * samples; k < (pass + 1) * samples; ++k)
                    camera_->add(x, y, pass, k);
    camera_->run();
    return camera_->dropped() - before;
}

/// The pass is one sample of every pixel: the sum of what was splatted there.
std::uint64_t TileRenderer::add_light_paths(Tile const& tile, PassRange passes) {
    std::uint64_t dropped = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            if (!film_.add(x, y, work_.light_paths->total(x, y), 1)) ++dropped;
            if (!film_.has_aovs()) continue;
            AovSample aov;
            aov.light = work_.light_paths->at(x, y);
            film_.add_aov(x, y, passes.begin, aov, 1);
        }
    return dropped;
}

void render_pass(RenderJob const& job, std::uint64_t i, Film& film, RayStats& stats) {
    auto const crop = job.crop();
    auto const work = prepare_pass(job, i, {});
    TileRenderer renderer(job, *work, film, stats);
    film.add_dropped(renderer.add({crop[0], crop[1], crop[2], crop[3]}, {i, i + 1}));
    film.finish_pass(i);
}

}  // namespace nephroid
