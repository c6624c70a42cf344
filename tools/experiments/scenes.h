// The scenes of the experiments, as pbrt text. z is up; everything is grey, in rgb mode, so that only light makes noise.
#pragma once

#include "math/vec.h"

#include <string>

namespace nephroid::experiment::scenes {

enum class Pixels {
    Whole,  // a pixel is a square, and its samples see its edges
    Points  // a pixel is its centre: all that varies is the light
};

/// Everything up to WorldBegin, with a perspective camera (fov of the shorter side, degrees).
std::string view(int width, int height, Pixels pixels, Vec3 eye, Vec3 target, float fov);
/// The same for the floor seen straight from above, from a height of 0.4, below whatever lights it: the rectangle
/// [x0, x1] x [y0, y1].
std::string floor_view(int width, int height, Pixels pixels, float x0, float x1, float y0, float y1);

/// Diffuse, of this reflectance, for the shapes that follow.
std::string matte(float reflectance);
/// The plane z = 0 as a large square.
std::string floor();
/// A shape (one or more directives) that emits, black otherwise.
std::string light(float radiance, std::string const& shape);
/// A horizontal square that looks down, of this side, centred over (0, 0).
std::string square_light(float radiance, float side, float height);

/// A sphere of 320 triangles, radius 0.5, around the origin.
std::string icosphere();
/// Two thousand small triangles that emit, scattered in a room of 10 x 8 x 4, of many sizes and strengths.
std::string scattered_lights(int count);
/// The walls of that room; or of any other.
std::string room(Vec3 lo, Vec3 hi);

}  // namespace nephroid::experiment::scenes
