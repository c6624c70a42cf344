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

PhotonMap::PhotonMap(std::vector<Photon> photons, float for_radius) {
    if (!std::all_of(photons.begin(), photons.end(), is_somewhere))
        std::erase_if(photons, [](Photon const& photon) { return !is_somewhere(photon); });
    std::vector<PlacedPhoton> order(photons.size());
    tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
        order[i] = {photons[i].p(), static_cast<std::uint32_t>(i)};
    });
    if (PhotonGrid::suits(for_radius)) {
        grid_ = PhotonGrid(order, for_radius);
    } else {
        order_photons(order, PhotonTree::kLeaf);
        tree_ = PhotonTree(order);
    }
    photons_.resize(photons.size());
    tbb::parallel_for(std::size_t{0}, order.size(),
                      [&](std::size_t i) { photons_[i] = photons[order[i].index]; });
}

void PhotonMap::nearest(Vec3 p, std::uint32_t k, float max_radius, NearestPhotons& out) const {
    out.found = {};
    if (k == 0 || empty() || !asks(p, max_radius)) return;
    out.begin(std::min<std::size_t>(k, size()), max_radius * max_radius);
    if (grid_.size() > 0)
        grid_.eights_within(p, max_radius, [&](std::uint32_t first, Float8 d2) { out.add(d2, first); });
    else
        tree_.nearest(p, out);
    out.end();
}

}  // namespace nephroid
