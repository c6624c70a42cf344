// Cameras: from a point of the film and of the lens to a ray into the world (PBRT 4th ed., chapter 5), and back from a point of
// the world to the film, for light that is traced forward (Veach 1997, 4.3 and 8.3; PBRT 3rd ed., 16.1.1).
#pragma once

#include "math/lanes.h"
#include "math/ray.h"
#include "math/transform.h"
#include "scene/camera.h"

#include <array>
#include <optional>

namespace nephroid {

struct CameraRay {
    Ray ray;  // world, unit direction
    float weight = 1;
};

/// How the camera takes in light that leaves a point of the world. A pixel is the mean of L over its square (weighed by the
/// filter) and over the lens; in terms of the surfaces that are seen, an integral of L * importance * |cos| over their area, with
/// the cosine of the surface alone. Light of unit radiance per unit area across the line of sight so adds `importance` to the film,
/// spread over which it is a density at `raster`.
struct CameraSample {
    Vec2 raster{0, 0};   // pixels; beyond the picture's edge is not an error
    Vec3 from{0, 0, 0};  // where the camera's ray begins
    Vec3 wi{0, 0, 1};    // unit, from the point towards the camera
    float distance = 0;  // scene units
    float importance =
        0;  // pixels / (scene unit)^2: (d raster / d omega) / distance^2; the lens's density has cancelled
};

/// A camera made ready for a resolution.
class PreparedCamera {
  public:
    PreparedCamera() = default;
    /// Throws std::invalid_argument never; a singular camera transform gives nothing.
    static std::optional<PreparedCamera> make(Camera const& camera, Vec2i resolution);

    /// `film`: raster coordinates, (0,0) the upper left corner, in pixels. `lens` in [0,1)^2.
    [[nodiscard]] CameraRay ray(Vec2 film, Vec2 lens) const {
        return is_pinhole_ ? CameraRay{{position_, through_pinhole(film)}, 1.0f} : general_ray(film, lens);
    }
    /// The same of eight places where every ray goes through one point and neither lens nor weight matter; false, and nothing done, elsewhere.
    bool rays(Vec2Lanes const& __restrict film, Vec3Lanes& __restrict o, Vec3Lanes& __restrict d) const;
    /// Where a point of the world is seen, in raster coordinates, also beyond the picture's edge; nothing where no ray of the
    /// camera goes (behind it, or at its very place). Through a lens, as its centre sees it.
    [[nodiscard]] std::optional<Vec2> project(Vec3 p) const;
    /// The camera as p sees it, through the point of the lens that ray() makes of `lens`.
    [[nodiscard]] std::optional<CameraSample> sample_importance(Vec3 p, Vec2 lens) const;
    /// Rays beyond the edge of a picture that shows all directions are rays within it: the point of the film whose ray it is.
    /// Other pictures end at their edges, and the point stays where it is.
    [[nodiscard]] Vec2 wrap(Vec2 film) const;
    /// A picture by latitude and longitude goes on beyond its poles half a turn away: half a pixel off its columns, where their
    /// number is odd.
    [[nodiscard]] bool by_latitude() const {
        auto const* s = std::get_if<SphericalCamera>(&camera_.kind);
        return s && s->mapping == SphericalMappingKind::EquiRectangular;
    }
    /// Does `lens` matter?
    [[nodiscard]] bool has_lens() const { return has_lens_; }
    /// Width of a pixel's footprint at unit distance along the axis (perspective) or anywhere (orthographic), about.
    [[nodiscard]] float pixel_spread() const { return pixel_spread_; }
    [[nodiscard]] Vec3 position() const { return position_; }

  private:
    [[nodiscard]] CameraRay general_ray(Vec2 film, Vec2 lens) const;
    [[nodiscard]] Vec3 through_pinhole(Vec2 film) const {
        Vec2 const q = film * scale_ + shift_;
        return normalize(axes_[0] * q.x + axes_[1] * q.y + axes_[2]);
    }

    Camera camera_;
    Transform to_world_;
    // Film to the plane z = 1 (perspective) or to the camera's xy plane (orthographic), or to (u, v) (spherical).
    Vec2 scale_{1, 1}, shift_{0, 0};
    Vec2 resolution_{1, 1};
    Vec3 position_{0, 0, 0};      // in the world, as …
    std::array<Vec3, 3> axes_{};  // … x, y and z
    float pixel_spread_ = 0;
    float direction_scale_ = 0;  // of to_world_ (math/transform.h)
    bool is_pinhole_ = false;
    bool has_lens_ = false;
};

}  // namespace nephroid
