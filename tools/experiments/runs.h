// Renders with what they took and what they shot, and how many paths to emit so that a number of photons is stored.
#pragma once

#include "lab.h"
#include "scene_files.h"

#include "render/render.h"
#include "transport/shooting.h"

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::experiment {

struct Run {
    Picture picture;
    double seconds = 0;
    std::uint64_t passes = 0;
    PhotonReport photons;
};
/// Passes [0, passes).
Run run(Setup const& setup, std::string const& directives, std::uint64_t passes, std::uint64_t seed = 1);
/// As many passes as begin within so many seconds.
Run run_for(Setup const& setup, std::string const& directives, double seconds, std::uint64_t seed = 1);
/// "1.23 s", or "not taken" in a quick run, which has to be the same twice.
std::string time_taken(Lab const& lab, double seconds);

/// Over all lights.
PhotonCounts total(std::vector<PhotonCounts> const& by_light);

/// Paths to emit so that about `photons` are stored: by a shot of a pass that no render shoots.
std::uint64_t paths_that_store(Setup const& setup, std::string const& directives, ShotKind kind,
                               std::uint64_t photons);

/// A scene of scenes/ in rgb mode, at this size: what is compared here is how light is found, not how colours are.
Setup sized_file(std::string const& name, int width, int height);
Setup sized(Setup setup, int width, int height);
/// A pixel is its centre: all that varies is the light.
Setup at_centres(Setup setup);
/// The Cornell box with what follows in it, in rgb mode.
Setup box_with(std::string const& contents, int pixels);
/// Only the pixels [x0, x1) x [y0, y1), in shares of the picture.
Setup cropped(Setup setup, double x0, double x1, double y0, double y1);

/// Times exposure_for(p, share): for sheets of pictures that are not compared in brightness.
Picture exposed(Picture p, double share);
/// image/compare.h's rel_mse.
double relative_mse(Picture const& p, Picture const& reference);
/// In thousands, from there on: "44.1k".
std::string thousands(std::uint64_t n);

}  // namespace nephroid::experiment
