// Cameras: from a point of the film and of the lens to a ray into the world (PBRT 4th ed., chapter 5).
#pragma once

#include "math/ray.h"
#include "math/transform.h"
#include "scene/camera.h"

#include <optional>

namespace nephroid {

struct CameraRay {
    Ray ray;  // world, unit direction
    float weight = 1;
};

/// A camera made ready for a resolution.
class PreparedCamera {
  public:
    PreparedCamera() = default;
    /// Throws std::invalid_argument never; a singular camera transform gives nothing.
    static std::optional<PreparedCamera> make(Camera const& camera, Vec2i resolution);

    /// `film`: raster coordinates, (0,0) the upper left corner, in pixels. `lens` in [0,1)^2.
    [[nodiscard]] CameraRay ray(Vec2 film, Vec2 lens) const;
    /// Does `lens` matter?
    [[nodiscard]] bool has_lens() const { return has_lens_; }
    /// Width of a pixel's footprint at unit distance along the axis (perspective) or anywhere (orthographic), about.
    [[nodiscard]] float pixel_spread() const { return pixel_spread_; }
    [[nodiscard]] Vec3 position() const { return to_world_.point({0, 0, 0}); }

  private:
    Camera camera_;
    Transform to_world_;
    // Film to the plane z = 1 (perspective) or to the camera's xy plane (orthographic), or to (u, v) (spherical).
    Vec2 scale_{1, 1}, shift_{0, 0};
    float pixel_spread_ = 0;
    bool has_lens_ = false;
};

}  // namespace nephroid
