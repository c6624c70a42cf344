#include "photon_order.h"

#include <algorithm>
#include <array>
#include <bit>

#include <tbb/parallel_invoke.h>

namespace nephroid {

namespace {
constexpr std::size_t kAlone = 4096;  // fewer photons are not worth a task
constexpr std::size_t kSample = 512;  // so many tell how photons spread

/// The axes along which photons spread, the widest first, by variance: a few strays do not count as much as they would in a box.
std::array<int, 3> axes_of(std::span<PlacedPhoton const> photons) {
    std::size_t const stride = photons.size() / kSample + 1;
    Vec3 const origin = photons[0].p;
    Vec3 sum{0, 0, 0}, squares{0, 0, 0};
    float n = 0;
    for (std::size_t i = 0; i < photons.size(); i += stride, n += 1.0f) {
        Vec3 const d = photons[i].p - origin;
        sum += d, squares += d * d;
    }
    Vec3 const variance = squares - sum * sum / n;
    int const widest =
        variance.x >= variance.y ? (variance.x >= variance.z ? 0 : 2) : (variance.y >= variance.z ? 1 : 2);
    int const a = (widest + 1) % 3, b = (widest + 2) % 3;
    return variance[a] >= variance[b] ? std::array{widest, a, b} : std::array{widest, b, a};
}

/// Many photons lie in one plane: those that are level along the first axis are told apart by the others.
struct Before {
    std::array<int, 3> axes;
    bool operator()(PlacedPhoton const& a, PlacedPhoton const& b) const {
        float const x = a.p[axes[0]], y = b.p[axes[0]];
        if (x != y) return x < y;
        if (a.p[axes[1]] != b.p[axes[1]]) return a.p[axes[1]] < b.p[axes[1]];
        return a.p[axes[2]] < b.p[axes[2]];
    }
};
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
    std::nth_element(photons.begin(), photons.begin() + static_cast<std::ptrdiff_t>(left), photons.end(),
                     Before{axes_of(photons)});
    auto const low = photons.first(left), high = photons.subspan(left);
    if (photons.size() < kAlone) {
        order_photons(low, leaf);
        order_photons(high, leaf);
        return;
    }
    tbb::parallel_invoke([=] { order_photons(low, leaf); }, [=] { order_photons(high, leaf); });
}

}  // namespace nephroid
