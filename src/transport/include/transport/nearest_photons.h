// The answer of a search for the k nearest, and the room to find it in.
//
// What is found is written down as it comes. When the room is full, the farthest are forgotten: by a histogram of the upper bits
// of squared distances, in a time that grows with their number alone and without branches that depend on them. That leaves k and
// a few; which of those few are in is settled in the end (docs/decisions/0008-photon-map-structure.md).
#pragma once

#include "transport/float8.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid {

struct FoundPhoton {
    float distance2 = 0;
    std::uint32_t index = 0;  // into the map
};

/// Made once and used for many queries: room that was needed is kept.
class NearestPhotons {
  public:
    NearestPhotons() = default;
    NearestPhotons(NearestPhotons const&) = delete;
    NearestPhotons& operator=(NearestPhotons const&) = delete;

    std::span<FoundPhoton> found;  // in no order; until the next query

  private:
    friend class PhotonTree;
    friend class PhotonMap;

    /// Begins a search for k > 0 of photons with squared distance < distance2.
    void begin(std::size_t k, float distance2);
    /// Those nearer than that may still be among the k nearest.
    [[nodiscard]] float most() const { return most_; }
    [[nodiscard]] bool sated() const { return count_ >= k_; }
    /// Adds photons first ... first + 7 if they are near enough.
    void add(Float8 distance2, std::uint32_t first) {
        count_ +=
            pack8(less8(distance2, all8(most_)), distance2, first, &distance2_[count_], &index_[count_]);
        if (count_ > full_) forget();
    }
    void end();

    /// Forgets those that are not among the k nearest, or all but a few of them.
    void forget();
    void forget_exactly();
    void keep_up_to(std::uint32_t bits);

    std::vector<float> distance2_;
    std::vector<std::uint32_t> index_;
    std::vector<FoundPhoton> room_;
    std::size_t count_ = 0, k_ = 0, full_ = 0;
    float most_ = 0;
    std::uint32_t certain_ = 0;  // those with fewer bits are among the k nearest
};

}  // namespace nephroid
