// A pass: one sample of every pixel, a pure function of (world, settings, seed, i).
#pragma once

#include "film/film.h"
#include "model/camera.h"
#include "model/filter.h"
#include "sampling/path_sampler.h"
#include "scene/settings.h"
#include "spectrum/sensor.h"
#include "transport/interiors.h"
#include "world/world.h"

#include <array>

namespace nephroid {

/// What stays the same over all passes of a render.
class RenderJob {
  public:
    /// Throws Error(Input) for a camera that cannot be used or a crop window outside the picture.
    RenderJob(World const& world, Settings const& settings);

    [[nodiscard]] World const& world() const { return *world_; }
    [[nodiscard]] Settings const& settings() const { return settings_; }
    [[nodiscard]] PreparedCamera const& camera() const { return camera_; }
    [[nodiscard]] FilterSampler const& filter() const { return filter_; }
    [[nodiscard]] Sequence const& sequence() const { return sequence_; }
    [[nodiscard]] Sensor const& sensor() const { return sensor_; }
    /// The bodies that the camera is in.
    [[nodiscard]] Interiors const& camera_interiors() const { return interiors_; }
    /// Pixels x0 x1 y0 y1 that are rendered.
    [[nodiscard]] std::array<int, 4> crop() const { return crop_; }

    /// An empty film for this job.
    [[nodiscard]] Film make_film() const;

  private:
    World const* world_;
    Settings settings_;
    PreparedCamera camera_;
    FilterSampler filter_;
    Sequence sequence_;
    Sensor sensor_;
    std::array<int, 4> crop_{};
    Interiors interiors_;
};

/// Pixels [x0, x1) × [y0, y1).
struct Tile {
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

/// Adds the samples of `passes` (ascending) to the pixels of `tile`; returns how many were not finite and were dropped. Does
/// not mark the passes as finished. Tiles that do not overlap may run at the same time.
std::uint64_t render_tile(RenderJob const& job, Tile const& tile, PassRange passes, Film& film,
                          RayStats& stats);

/// The definition: every pixel of pass i, and the pass marked as finished.
void render_pass(RenderJob const& job, std::uint64_t i, Film& film, RayStats& stats);

}  // namespace nephroid
