// From Phong's terms to materials that conserve energy. Those programs lit a diffuse surface of `diffuse` kd, head-on by a light
// of colour c, to kd c; with what is below and lights of irradiance pi c (ray_lights.h) it is the same here.
#pragma once

#include "ray_materials.h"

#include <array>

namespace nephroid {

/// What a shape is made of, and what it emits.
struct RaySurface {
    MaterialId material;
    std::optional<AreaLight> light;
};

class PhongMapper {
  public:
    explicit PhongMapper(Context& context) : context_(context) {}
    /// The same ids for the same terms. Says by notes what is an approximation. `open`: both sides of the shape are seen,
    /// and so both emit.
    RaySurface surface(Phong const& phong, bool open);

    /// The materials so far that reflect ambient light in another colour than that of lights.
    [[nodiscard]] std::vector<SourceLocation> const& other_ambient() const { return other_ambient_; }

  private:
    using Key = std::array<float, 26>;
    static Key key_of(Phong const& p);
    MaterialId material(Phong const& p);
    MaterialId base(Phong const& p, RayColour const& lobe, float factor);
    MaterialId mirror(Phong const& p, float factor);
    MaterialId transmission(Phong const& p, float factor);
    TextureId texture(RayColour const& colour, float factor, SourceLocation where,
                      SpectrumRole role = SpectrumRole::Albedo);
    TextureId number(float value, SourceLocation where);

    Context& context_;
    std::map<Key, MaterialId> known_;
    std::vector<SourceLocation> other_ambient_;
};

}  // namespace nephroid
