// A pass: one sample of every pixel, a pure function of (world, settings, seed, i).
#pragma once

#include "film/film.h"
#include "model/camera.h"
#include "model/filter.h"
#include "sampling/path_sampler.h"
#include "scene/settings.h"
#include "spectrum/sensor.h"
#include "transport/interiors.h"
#include "transport/pass_work.h"
#include "world/world.h"

#include <array>
#include <memory>
#include <optional>

namespace nephroid {

class PhotonPlan;   // photon_plan.h
class CameraBatch;  // camera_batch.h

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
    /// Of light paths: centres of strata would send them all to a few places.
    [[nodiscard]] Sequence const& light_sequence() const { return light_sequence_; }
    [[nodiscard]] Sensor const& sensor() const { return sensor_; }
    /// The bodies that the camera is in.
    [[nodiscard]] Interiors const& camera_interiors() const { return interiors_; }
    /// Pixels x0 x1 y0 y1 that are rendered.
    [[nodiscard]] std::array<int, 4> crop() const { return crop_; }

    /// Of integrators that shoot photons: how many, whereto, and the radii of pass 0. Null for the others.
    [[nodiscard]] PhotonPlan const* photon_plan() const { return plan_.get(); }
    /// Passes have to be prepared: see prepare_pass().
    [[nodiscard]] bool prepares() const;
    /// The wavelengths that all paths of pass i share, where paths meet (DESIGN 5): well spread over the passes.
    [[nodiscard]] Wavelengths pass_wavelengths(std::uint64_t i) const;

    /// An empty film for this job.
    [[nodiscard]] Film make_film() const;

  private:
    World const* world_;
    Settings settings_;
    PreparedCamera camera_;
    FilterSampler filter_;
    Sequence sequence_, light_sequence_;
    Sensor sensor_;
    std::array<int, 4> crop_{};
    Interiors interiors_;
    std::shared_ptr<PhotonPlan const> plan_;
};

/// Pixels [x0, x1) × [y0, y1).
struct Tile {
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

/// What pass i needs before its first pixel, made by all threads of the caller's arena: a pure function of (world, settings, seed,
/// i). Nothing when `control` stopped it.
std::optional<PassWork> prepare_pass(RenderJob const& job, std::uint64_t i, PrepareControl const& control);

/// What one thread needs to render tiles, one after the other. `work` is of the passes; where the job prepares passes there is but one.
class TileRenderer {
  public:
    /// All of them are to outlive it.
    TileRenderer(RenderJob const& job, PassWork const& work, Film& film, RayStats& stats);
    TileRenderer(RenderJob const&, PassWork&&, Film&, RayStats&) = delete;
    ~TileRenderer();

    /// Adds the samples of `passes` (ascending) to the pixels of `tile`; returns how many were not finite and were dropped. Does
    /// not mark the passes as finished. Tiles that do not overlap may be rendered at the same time, by others.
    std::uint64_t add(Tile const& tile, PassRange passes);

  private:
    std::uint64_t add_light_paths(Tile const& tile, PassRange passes);

    RenderJob const& job_;
    PassWork const& work_;
    Film& film_;
    std::unique_ptr<CameraBatch> camera_;  // none: light paths draw the picture
};

/// The definition: every pixel of pass i, and the pass marked as finished.
void render_pass(RenderJob const& job, std::uint64_t i, Film& film, RayStats& stats);

}  // namespace nephroid
