// Materials of .ray files: Phong's terms as those programs added them up, and how they are read.
#pragma once

#include "ray_input.h"

#include <map>
#include <memory>
#include <optional>

namespace nephroid {

/// A colour, or a picture of colours over the surface's (u, v).
struct RayColour {
    Vec3 value{0, 0, 0};
    ImageId map;

    [[nodiscard]] bool black() const { return !map.valid() && value == Vec3{0}; }
    /// Its largest component; nobody has looked into pictures yet, so they count as white.
    [[nodiscard]] float top() const { return map.valid() ? 1.0f : max_component(value); }
};

/// Black, opaque and dull, as in those programs.
struct Phong {
    RayColour emissive, ambient, diffuse, specular, reflective, transmissive;
    float shininess = 0;  // of the mirror direction's cosine
    float index = 1;
    std::string name;
    SourceLocation where;
};
using SharedPhong = std::shared_ptr<Phong const>;

/// Reads materials and knows those that have names.
class RayMaterials {
  public:
    /// "{ … }", which begins as `parent`, or the name of one.
    SharedPhong read(RayInput& in, SharedPhong const& parent);

  private:
    static RayColour colour(RayInput& in, std::string_view what);
    static float scalar(RayInput& in, std::string_view what, float otherwise);
    void define(RayInput const& in, SharedPhong const& phong);

    std::map<std::string, SharedPhong, std::less<>> names_;
};

}  // namespace nephroid
