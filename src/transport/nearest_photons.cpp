#include "transport/nearest_photons.h"

#include <algorithm>
#include <array>
#include <bit>

namespace nephroid {

namespace {

// Bits of floats that are not negative grow with them. So many classes for each factor of two, and so many in all.
constexpr std::uint32_t kShift = 18;  // 32 for each factor of two
constexpr std::uint32_t kClasses = 256;

std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

bool nearer(FoundPhoton a, FoundPhoton b) { return a.distance2 < b.distance2; }

}  // namespace

void NearestPhotons::begin(std::size_t k, float distance2) {
    k_ = k;
    count_ = 0;
    most_ = distance2;
    certain_ = 0;
    full_ = k + k / 4 + 32;
    if (distance2_.size() < full_ + 16) {
        distance2_.resize(full_ + 16);
        index_.resize(full_ + 16);
        room_.resize(full_ + 16);
    }
}

void NearestPhotons::forget() {
    while (true) {
        // Classes by how much nearer they are than the farthest: class 0 is as far, the last takes all that are much nearer.
        float farthest = 0;
        for (std::size_t i = 0; i < count_; ++i)
            farthest = distance2_[i] > farthest ? distance2_[i] : farthest;
        std::uint32_t const top = bits_of(farthest) >> kShift;
        auto const class_of = [top](float d2) {
            return std::min(top - (bits_of(d2) >> kShift), kClasses - 1);
        };
        std::array<std::uint32_t, kClasses> histogram{};
        for (std::size_t i = 0; i < count_; ++i) ++histogram[class_of(distance2_[i])];
        // The class of the k-th; what is farther goes.
        std::size_t left = count_;
        std::uint32_t last = 0;
        while (left - histogram[last] >= k_) left -= histogram[last++];
        bool const vague = last == kClasses - 1, stuck = left == count_;
        if (stuck && (vague || left > full_ - 8)) return forget_exactly();
        std::uint32_t const nearest = (top - last) << kShift;
        certain_ = vague ? 0 : nearest;
        keep_up_to(nearest | ((1u << kShift) - 1));
        if (!vague && count_ <= full_ - 8) return;
    }
}

void NearestPhotons::keep_up_to(std::uint32_t bits) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        float const d2 = distance2_[i];
        distance2_[kept] = d2;
        index_[kept] = index_[i];
        kept += bits_of(d2) <= bits;
    }
    count_ = kept;
    // Photons that are exactly as far as the bits say could be among the k nearest only in place of others as far.
    most_ = std::bit_cast<float>(bits);
}

/// For photons that are all alike far, or many of which are all but at the place that is asked for.
void NearestPhotons::forget_exactly() {
    for (std::size_t i = 0; i < count_; ++i) room_[i] = {distance2_[i], index_[i]};
    auto const begin = room_.begin(), last = begin + static_cast<std::ptrdiff_t>(k_ - 1);
    std::nth_element(begin, last, begin + static_cast<std::ptrdiff_t>(count_), nearer);
    count_ = k_;
    most_ = last->distance2;
    certain_ = bits_of(most_);
    for (std::size_t i = 0; i < count_; ++i) distance2_[i] = room_[i].distance2, index_[i] = room_[i].index;
}

void NearestPhotons::end() {
    if (count_ > k_) forget();
    // The certain from the front, the others from the back; of those the nearest.
    std::size_t front = 0, back = count_;
    bool const all = count_ <= k_;
    for (std::size_t i = 0; i < count_; ++i) {
        FoundPhoton const f{distance2_[i], index_[i]};
        bool const sure = all || bits_of(f.distance2) < certain_;
        room_[sure ? front++ : --back] = f;
    }
    if (!all) {
        auto const begin = room_.begin();
        std::nth_element(begin + static_cast<std::ptrdiff_t>(front),
                         begin + static_cast<std::ptrdiff_t>(k_ - 1),
                         begin + static_cast<std::ptrdiff_t>(count_), nearer);
        count_ = k_;
    }
    found = {room_.data(), count_};
}

}  // namespace nephroid
