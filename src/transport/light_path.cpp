#include "light_path_image.h"

namespace nephroid {

std::array<Vec3, 4> LightPathImage::at(int, int) const { return {}; }

std::optional<LightPathImage> draw_light_paths(RenderJob const&, std::uint64_t, PrepareControl const&,
                                               RayStats&) {
    return LightPathImage{};
}

}  // namespace nephroid
