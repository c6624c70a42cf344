// Cameras look along +z of their own space, y up, x right: pbrt's left-handed convention. Angles are radians.
#pragma once

#include "math/transform.h"
#include "scene/id.h"

#include <array>
#include <optional>
#include <variant>

namespace nephroid {

struct PerspectiveCamera {
    float fov = 1.57079633f;  // of the shorter side of the picture
    float lens_radius = 0, focal_distance = 1e6f;
};
struct OrthographicCamera {
    float lens_radius = 0, focal_distance = 1e6f;
};
enum class SphericalMappingKind : std::uint8_t { EquiRectangular, EqualArea };
struct SphericalCamera {
    SphericalMappingKind mapping = SphericalMappingKind::EquiRectangular;
};
using CameraKind = std::variant<PerspectiveCamera, OrthographicCamera, SphericalCamera>;

struct Camera {
    CameraKind kind;
    Mat4 to_world;
    std::optional<std::array<float, 4>> screen_window;  // x0 x1 y0 y1
    std::optional<float> frame_aspect_ratio;
    float exposure_time = 1;  // shutter close - shutter open, s
    SourceLocation where;
};

}  // namespace nephroid
