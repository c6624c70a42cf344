// What a pass does for one pixel.
#pragma once

#include "transport/render_pass.h"

namespace nephroid {

class NearestPhotons;
class PathTrace;

/// Sample `sample` of a pixel, which belongs to `pass`, into the film; false when it was not finite and was dropped. `trace` hears of
/// its path.
bool add_camera_sample(RenderJob const& job, PassWork const& work, int x, int y, std::uint64_t pass,
                       std::uint64_t sample, NearestPhotons& nearest, Film& film, RayStats& stats,
                       PathTrace* trace);

}  // namespace nephroid
