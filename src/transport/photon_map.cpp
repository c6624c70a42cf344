#include "transport/photon_map.h"

#include "photon_order.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace nephroid {

namespace {
bool is_somewhere(Photon const& photon) {
    Vec3 const p = photon.p();
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
}  // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons) {
    std::erase_if(photons, [](Photon const& photon) { return !is_somewhere(photon); });
    std::vector<PlacedPhoton> order(photons.size());
    tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
        order[i] = {photons[i].p(), static_cast<std::uint32_t>(i)};
    });
    order_photons(order, PhotonTree::kLeaf);
    tree_ = PhotonTree(order);
    photons_.resize(photons.size());
    tbb::parallel_for(std::size_t{0}, order.size(),
                      [&](std::size_t i) { photons_[i] = photons[order[i].index]; });
}

}  // namespace nephroid
