// Geometry of .ray files as our shapes: what a word such as `cylinder { … }` stands for, in its own space.
#pragma once

#include "ray_materials.h"

#include <vector>

namespace nephroid {

/// One of the shapes that a geometry consists of.
struct RayPiece {
    Shape shape;
    SharedPhong phong;
    bool open = false;  // there is no inside: both sides are seen
    bool reverse_orientation = false;
};

class RayShapes {
  public:
    RayShapes(RayInput& in, RayMaterials& materials) : in_(in), materials_(materials) {}

    static std::vector<std::string> const& names();
    /// Reads the block after one of names(). What the block says nothing about is of `parent`.
    std::vector<RayPiece> read(std::string_view name, SharedPhong const& parent);

  private:
    std::vector<RayPiece> cylinder(SharedPhong phong);
    std::vector<RayPiece> cone(SharedPhong phong, SourceLocation where);
    std::vector<RayPiece> mesh(std::string_view name, SharedPhong phong, SourceLocation where);
    [[nodiscard]] RayAttribute material(SharedPhong& phong);
    [[nodiscard]] RayAttribute name_attribute();

    RayInput& in_;
    RayMaterials& materials_;
    std::size_t cones_ = 0;
};

/// A frustum around z, from radius `bottom` at z = 0 to `top` at z = `height`, as triangles with the cone's normals; with
/// both ends when `capped`. Normals point outwards.
TriangleMesh cone_mesh(float height, float bottom, float top, bool capped);

}  // namespace nephroid
