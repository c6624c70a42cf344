// Photons, their paths, and the normals under them, drawn over a picture as the camera would see them (Jensen 1996 shows maps so).
#pragma once

#include "commands.h"
#include "image/image.h"
#include "photon_cloud.h"

namespace nephroid::cli {

/// Something is to be drawn.
bool draws(OverlayOptions const& o);

/// A picture of the job's crop window, R G B A, the colours times A: photons of `pass` as points in their colours, normals green, paths
/// white. What lies behind surfaces, glass included, is left out unless it was asked for. `photons` is a job of photon_settings()
/// in the same world; its camera is the one that looks.
Image draw_photons(RenderJob const& photons, std::uint64_t pass, OverlayOptions const& o);

}  // namespace nephroid::cli
