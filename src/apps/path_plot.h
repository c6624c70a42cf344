// A replayed path as a drawing: from the side and from above as SVG, and over a picture as its camera sees it.
#pragma once

#include "image/image.h"
#include "transport/replay.h"

#include <string>

namespace nephroid::cli {

/// Both views are along axes of the camera or, where those are near, of the world; to scale, without perspective. Outlines grey (of lamps
/// yellow); the path blue, with its vertices x1, x2, …, their geometric normals, and beta after each; sampled lights dashed, grey where
/// something was in the way. A camera that is far away is not in the drawing, only where its ray comes from.
std::string path_svg(RenderJob const& job, PathRecord const& record);

/// As draw_photons() draws: R G B A, the colours times A, for the job's crop window. Nothing hides the path.
Image draw_path(RenderJob const& job, PathRecord const& record);

}  // namespace nephroid::cli
