#include "photon_order.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_invoke.h>

namespace nephroid {

namespace {
constexpr std::size_t kAlone = 4096;  // fewer photons are not worth a task

int longest_side(Bounds3 const& b) {
    Vec3 const d = b.diagonal();
    if (d.x >= d.y && d.x >= d.z) return 0;
    return d.y >= d.z ? 1 : 2;
}
}  // namespace

Bounds3 bounds_of(std::span<PlacedPhoton const> photons) {
    Bounds3 b;
    for (PlacedPhoton const& photon : photons) b.add(photon.p);
    return b;
}

void order_photons(std::span<PlacedPhoton> photons, std::size_t leaf) {
    std::size_t const leaves = (photons.size() + leaf - 1) / leaf;
    if (leaves <= 1) return;
    std::size_t const left = std::bit_floor(leaves - 1) * leaf;
    int const axis = longest_side(bounds_of(photons));
    std::nth_element(photons.begin(), photons.begin() + static_cast<std::ptrdiff_t>(left), photons.end(),
                     [axis](PlacedPhoton const& a, PlacedPhoton const& b) { return a.p[axis] < b.p[axis]; });
    auto const low = photons.first(left), high = photons.subspan(left);
    if (photons.size() < kAlone) {
        order_photons(low, leaf);
        order_photons(high, leaf);
        return;
    }
    tbb::parallel_invoke([=] { order_photons(low, leaf); }, [=] { order_photons(high, leaf); });
}

}  // namespace nephroid
