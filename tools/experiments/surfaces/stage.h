// Where materials are shown: a studio with a checkered floor, a lamp, a strip of light and a dim sky; a white sky.
// All as pbrt text; z is up.
#pragma once

#include "scene_files.h"

#include <string>

namespace nephroid::experiment::stage {

/// The studio up to its lights and floor; what is shown stands on z = 0 around the origin, 2.4 high and wide.
std::string studio(int width, int height);
/// A ball of radius 1 over a plinth, both of the material that was set last.
std::string ball_and_plinth(std::string const& shape_parameters = "");
/// A ball of radius 1.15 that stands on the floor.
std::string ball();

/// A sphere of radius 1 that fills the picture, under a white sky, in rgb mode: of what is seen of it, a pixel is what comes
/// back to it of light of radiance 1. The material follows, then `unit_sphere`.
std::string white_sky(int pixels);
std::string unit_sphere();
/// The mean over the sphere's disk in such a picture: its albedo for light from everywhere.
double over_disk(Picture const& p);

}  // namespace nephroid::experiment::stage
