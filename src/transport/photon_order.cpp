#include "photon_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include <tbb/parallel_invoke.h>

namespace nephroid {

namespace {
constexpr std::size_t kAlone = 4096;  // fewer photons are not worth a task
constexpr std::size_t kFew = 32;      // fewer photons are split by std::nth_element
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

using Photons = std::span<PlacedPhoton>;
using Axes = std::array<int, 3>;

/// Many photons lie in one plane: those that are level along the first axis are told apart by the others.
struct Before {
    Axes axes;
    bool operator()(PlacedPhoton const& a, PlacedPhoton const& b) const {
        for (int const axis : axes)
            if (a.p[axis] != b.p[axis]) return a.p[axis] < b.p[axis];
        return false;
    }
};

/// Brings those for which is(coordinate) to the front, and says how many they are. No branch depends on a photon: it would be
/// guessed wrong half the time.
template <class Is>
std::size_t to_front(Photons photons, int axis, Is is) {
    std::size_t front = 0;
    for (PlacedPhoton& photon : photons) {
        PlacedPhoton const moved = photon;
        photon = photons[front];
        photons[front] = moved;
        front += is(moved.p[axis]);
    }
    return front;
}

/// Two coordinates that very likely have the one of that rank between them, and not many more (Floyd & Rivest 1975).
std::pair<float, float> around_rank(Photons photons, std::size_t rank, int axis) {
    std::array<float, 512> sample;
    std::size_t const n = std::clamp<std::size_t>(photons.size() / 32, 16, sample.size());
    std::size_t const stride = photons.size() / n;
    for (std::size_t i = 0; i < n; ++i) sample[i] = photons[i * stride].p[axis];
    std::sort(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(n));
    float const size = static_cast<float>(n);
    float const middle = static_cast<float>(rank) / static_cast<float>(photons.size()) * size;
    float const about = std::sqrt(size);  // twice the standard deviation of the sample's median
    auto const at = [&](float x) { return sample[static_cast<std::size_t>(clamp(x, 0.0f, size - 1.0f))]; };
    return {at(middle - about), at(middle + about)};
}

/// What std::nth_element does with Before, in a third of the time: `rank` photons that come before the others are brought to the
/// front.
void split(Photons photons, std::size_t rank, Axes const& axes) {
    std::size_t which = 0;
    while (photons.size() > kFew && which < 3) {
        int const axis = axes[which];
        auto const [lo, hi] = around_rank(photons, rank, axis);
        std::size_t const all = photons.size();
        auto const choose = [&](std::size_t front) {
            bool const in_front = rank < front;
            photons = in_front ? photons.first(front) : photons.subspan(front);
            rank -= in_front ? 0 : front;
            return in_front;
        };
        if (!choose(to_front(photons, axis, [hi = hi](float x) { return x <= hi; }))) continue;
        if (choose(to_front(photons, axis, [lo = lo](float x) { return x < lo; }))) continue;
        if (lo == hi)
            ++which;
        else if (photons.size() == all &&
                 choose(to_front(photons, axis, [lo = lo](float x) { return x <= lo; })))
            ++which;
    }
    if (which < 3)
        std::nth_element(photons.begin(), photons.begin() + static_cast<std::ptrdiff_t>(rank), photons.end(),
                         Before{axes});
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
    split(photons, left, axes_of(photons));
    auto const low = photons.first(left), high = photons.subspan(left);
    if (photons.size() < kAlone) {
        order_photons(low, leaf);
        order_photons(high, leaf);
        return;
    }
    tbb::parallel_invoke([=] { order_photons(low, leaf); }, [=] { order_photons(high, leaf); });
}

}  // namespace nephroid
