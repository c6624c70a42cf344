// Camera samples on their way together: numbers are drawn for many at once, their first rays are traced side by side, and so are those to
// the lights they sample (docs/decisions/0010-paths-in-step.md).
#pragma once

#include "path_in_flight.h"
#include "photon_maps.h"
#include "shadow_queue.h"
#include "transport/render_pass.h"
#include "walk.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace nephroid {

class CameraBatch {
  public:
    CameraBatch(RenderJob const& job, PassWork const& work, Film& film, RayStats& stats);
    // Its paths know where its other parts are.
    CameraBatch(CameraBatch const&) = delete;
    CameraBatch& operator=(CameraBatch const&) = delete;

    /// Sample `sample` of pixel (x, y), which belongs to `pass`: a pure function of (world, settings, seed, pixel, sample), whatever else
    /// is in the batch. In the film after the next run(), which a full batch does by itself.
    void add(int x, int y, std::uint64_t pass, std::uint64_t sample);
    /// Follows the paths of all samples that were added and adds them to the film in their order. `trace` hears of them, unless null.
    void run(PathTrace* trace = nullptr);
    /// Samples that were not finite.
    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

  private:
    struct Sample {
        int x = 0, y = 0;
        std::uint64_t pass = 0;
        PathSampler sampler;
        Vec2 on_film{0, 0};  // the numbers that choose …
        Vec2 at{0, 0};       // … where on the film, pixels
        float filter_weight = 1;
        Vec2 lens{0.5f, 0.5f};
        CameraRay camera;
    };

    template <std::size_t... I>
    CameraBatch(RenderJob const& job, PassWork const& work, Film& film, RayStats& stats,
                std::index_sequence<I...>);
    /// Draws what the camera asks for.
    void begin(std::size_t i);
    /// The rays of eight samples.
    void make_rays(std::size_t first);
    void trace_camera_rays();
    void finish(std::size_t i, PathTrace* trace);

    RenderJob const& job_;
    Film& film_;
    RayStats& stats_;
    std::uint64_t dropped_ = 0;
    std::size_t size_ = 0;
    std::array<Sample, kMostInStep> samples_;
    std::array<AovSample, kMostInStep> aovs_;
    std::array<RayPacket, kMostInStep / kLanes> rays_;  // of the camera
    std::array<PathInFlight, kMostInStep> paths_;
    NearestPhotons nearest_;
    ShadowQueue shadows_;
};

}  // namespace nephroid
