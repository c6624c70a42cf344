// The answer of a search for the k nearest, and room to find it in.
#pragma once

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

    /// Begins a search for k of `all` photons: room for those found so far, of which the k nearest are wanted, and some more, so
    /// that they need not be sorted out at each.
    void begin(std::uint32_t k, std::size_t all);
    /// Room for eight more is made beforehand: true where sort_out() must come first.
    [[nodiscard]] bool full() const { return count_ + 8 > room_.size(); }
    void add(float distance2, std::uint32_t index) { room_[count_++] = {distance2, index}; }
    /// Leaves the k nearest of those found. Returns the squared distance of the farthest of them.
    float sort_out();
    [[nodiscard]] bool sated() const { return count_ >= k_; }
    void end();

  private:
    std::vector<FoundPhoton> room_;
    std::size_t count_ = 0, k_ = 0;
};

}  // namespace nephroid
