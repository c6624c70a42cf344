// Lights of .ray files. A colour of 1 there lights a surface that faces it so that it shows its `diffuse`; here that takes an
// irradiance of pi.
#pragma once

#include "ray_input.h"

#include <optional>
#include <vector>

namespace nephroid {

class RayLights {
  public:
    explicit RayLights(RayInput& in) : in_(in) {}

    static bool is_light(std::string_view name);
    /// Reads the block after `name`.
    void read(std::string_view name);
    /// Makes the lights that depend on where the scene is: `bounds` of all its geometry.
    void finish(Bounds3 const& bounds);
    /// Of the first ambient light that is not black.
    [[nodiscard]] std::optional<SourceLocation> ambient() const { return ambient_; }

  private:
    /// Colour over constant + linear d + quadratic d^2, where d is the distance.
    struct Attenuated {
        Vec3 position{0, 0, 0}, colour{0, 0, 0};
        float constant = 0, linear = 0, quadratic = 1;
        float radius = 0;  // above 0: a ball
        SourceLocation where;
    };

    void ambient_light();
    void directional_light();
    void point_light();
    void area_light();
    void parallelogram(Vec3 position, Vec3 colour, Vec3 u, Vec3 v, SourceLocation where);
    float intensity(Attenuated const& light, Bounds3 const& bounds);
    [[nodiscard]] RayAttribute triple(std::string_view name, std::optional<Vec3>& out);
    [[nodiscard]] RayAttribute colour(std::string_view what, std::optional<Vec3>& out);
    [[nodiscard]] RayAttribute coefficient(std::string_view name, float& out);
    Vec3 needed(std::optional<Vec3> const& value, std::string const& what, SourceLocation where) const;

    RayInput& in_;
    std::vector<Attenuated> attenuated_;
    std::optional<SourceLocation> ambient_;
};

}  // namespace nephroid
