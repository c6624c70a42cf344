// Photon mapping (Jensen 1996; 2001, chapter 9).
#include "photon_maps.h"
#include "walk.h"

namespace nephroid {

SeenLight radiance(PhotonMapIntegrator const&, PathContext&, Ray const&, AovSample*) { return {}; }

}  // namespace nephroid
