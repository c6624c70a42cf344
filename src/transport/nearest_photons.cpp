#include "transport/nearest_photons.h"

#include <algorithm>

namespace nephroid {

void NearestPhotons::begin(std::uint32_t k, std::size_t all) {
    k_ = std::min<std::size_t>(k, all);
    count_ = 0;
    room_.resize(k_ + k_ / 2 + 32);
}

float NearestPhotons::sort_out() {
    auto const last = room_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
    std::nth_element(room_.begin(), last, room_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [](FoundPhoton a, FoundPhoton b) { return a.distance2 < b.distance2; });
    count_ = k_;
    return last->distance2;
}

void NearestPhotons::end() {
    if (count_ > k_) sort_out();
    found = {room_.data(), count_};
}

}  // namespace nephroid
