// Photon maps as they are: what the estimates say at the first surface that is not specular, and nothing else.
#pragma once

#include "photon_maps.h"
#include "walk.h"

namespace nephroid {

/// What `view` shows along a camera ray (not PhotonView::None). `max_depth`: of specular bounces.
SeenLight show_photons(PhotonView view, int max_depth, PathContext& c, Ray const& ray, AovSample* aov);

}  // namespace nephroid
