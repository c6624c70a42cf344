// Where materials are shown: a studio with a checkered floor, a lamp, a strip of light and a dim sky; a white sky; and the
// Cornell box. All as pbrt text; z is up, but in the box, which has its published coordinates.
#pragma once

#include "measure.h"

#include <filesystem>
#include <string>

namespace nephroid::experiment::stage {

/// The repository's scenes, for meshes and includes.
std::filesystem::path scenes();

/// prepare(), for scenes that mean what they say: throws Error(Input) with the first note that the reader had.
Setup faithful(std::string const& pbrt, std::filesystem::path const& folder);

/// The same for one of scenes().
Setup prepare_file(std::string const& name);

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

/// The empty Cornell box with its camera (folder: scenes()), in what was measured: mm.
std::string cornell(int pixels);

}  // namespace nephroid::experiment::stage
