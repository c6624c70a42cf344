// Scenes of the course ray tracers of the years around 2000: SBT-raytracer 0.9 to 1.1, extension .ray.
// docs/scene-formats.md says how its terms are mapped.
#pragma once

#include "ray_camera.h"
#include "ray_lights.h"
#include "ray_phong.h"
#include "ray_shapes.h"

#include <filesystem>

namespace nephroid {

class RayReader {
  public:
    /// `text` must outlive the reader. `shown` is what messages call it, `folder` where its pictures are.
    RayReader(std::string_view text, std::string const& shown, std::filesystem::path folder);
    Scene read();

  private:
    void header();
    void top_level();
    void top_material();
    /// Geometry, a transform of an element, or a group in braces; `parent` is what it is made of where it says nothing.
    void element(Mat4 const& to_world, SharedPhong const& parent, int depth);
    void group(Mat4 const& to_world, SharedPhong parent, int depth);
    void transformed(std::string_view name, Mat4 const& to_world, SharedPhong const& parent, int depth);
    Mat4 transform_of(std::string_view name);
    void geometry(std::string_view name, Mat4 const& to_world, SharedPhong const& parent);
    [[nodiscard]] bool skip_unsupported();
    [[noreturn]] void unknown(bool top) const;
    Scene finish();

    Context context_;
    SourceLocation file_;
    RayInput in_;
    RayMaterials materials_;
    RayShapes shapes_;
    RayLights lights_;
    RayCamera camera_;
    PhongMapper mapper_;
    SharedPhong default_;  // of what follows at the top level
    Bounds3 bounds_;       // of all geometry, in the world
};

}  // namespace nephroid
