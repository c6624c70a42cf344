// What the light paths of a pass drew: power that arrived at each pixel (light_path.cpp).
#pragma once

#include "transport/pass_work.h"
#include "transport/render_pass.h"

#include <optional>

namespace nephroid {

class LightPathImage {
  public:
    /// By class of path, sensor values of pixel (x, y) of the whole picture.
    [[nodiscard]] std::array<Vec3, 4> at(int x, int y) const;
};

std::optional<LightPathImage> draw_light_paths(RenderJob const& job, std::uint64_t pass,
                                               PrepareControl const& control, RayStats& stats);

}  // namespace nephroid
