#include "transport/photon_map.h"

#include <algorithm>

namespace nephroid {

PhotonMap::PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)) {}

void PhotonMap::nearest(Vec3 p, std::uint32_t k, float max_radius, NearestPhotons& out) const {
    out.found.clear();
    within(p, max_radius, [&](std::uint32_t i, float d2) { out.found.push_back({d2, i}); });
    if (out.found.size() <= k) return;
    std::nth_element(out.found.begin(), out.found.begin() + k, out.found.end(),
                     [](FoundPhoton a, FoundPhoton b) { return a.distance2 < b.distance2; });
    out.found.resize(k);
}

}  // namespace nephroid
