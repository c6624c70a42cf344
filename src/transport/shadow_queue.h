// Light that waits for its shadow ray. Where a path goes on does not depend on whether the lights sampled along it were seen, so that
// the rays to them are traced later, together with those of other paths: eight at a time, by how far along their paths they begin.
#pragma once

#include "transport/light_class.h"
#include "walk.h"
#include "world/world.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

class ShadowQueue {
  public:
    ShadowQueue(World const& world, RayStats& stats) : world_(world), stats_(stats) {}

    /// Nothing has arrived at any path.
    void begin() { arrived_ = {}; }
    /// `light` arrives at a path, below kMostInStep, unless something solid is between its vertex of that number, `from`, and the light,
    /// `to`.
    void wait(std::uint32_t path, LightClass as, Spectrum light, SurfaceHit const& from,
              LightSample const& to, std::uint32_t vertex) {
        std::size_t const i = add(path, as, light, false);
        Open& open = open_[vertex < kDepths ? vertex : kDepths - 1];
        open.entry[open.ends.size()] = static_cast<std::uint16_t>(i);
        open.ends.add(from, to);
        if (open.ends.full()) trace(open);
        if (size_ == kMost) settle();
    }
    /// `light` is known to arrive.
    void arrive(std::uint32_t path, LightClass as, Spectrum light) {
        add(path, as, light, true);
        if (size_ == kMost) settle();
    }
    /// Traces what is left. Sums are by path and in the order in which it was put here, whatever else is in the queue.
    void settle() {
        for (Open& open : open_)
            if (open.ends.size() > 0) trace(open);
        for (std::size_t i = 0; i < size_; ++i) {
            Entry const& e = entries_[i];
            if (arrives_[i]) arrived_[e.path][e.as] += e.light;
        }
        size_ = 0;
    }
    /// Sampled light that has reached a path, once all is settled.
    [[nodiscard]] SeenLight const& arrived(std::size_t path) const { return arrived_[path]; }

  private:
    struct Entry {
        Spectrum light;
        std::uint32_t path = 0;
        LightClass as = LightClass::Direct;
    };
    /// Rays that wait for others to go with.
    struct Open {
        ShadowPacket ends;
        std::array<std::uint16_t, kLanes> entry;
    };
    // From a path's first vertex rays go much the same way; from the others it is as well to keep those of one number together.
    static constexpr std::size_t kDepths = 3;
    static constexpr std::size_t kMost = 4 * kMostInStep;

    std::size_t add(std::uint32_t path, LightClass as, Spectrum light, bool arrives) {
        entries_[size_] = {light, path, as};
        arrives_[size_] = arrives;
        return size_++;
    }
    void trace(Open& open) {
        LaneMask const free = world_.unoccluded(open.ends, stats_);
        for (std::size_t i = 0; i < open.ends.size(); ++i) arrives_[open.entry[i]] = (free >> i & 1u) != 0;
        open.ends.clear();
    }

    World const& world_;
    RayStats& stats_;
    std::size_t size_ = 0;
    std::array<Entry, kMost> entries_;
    std::array<bool, kMost> arrives_;
    std::array<Open, kDepths> open_;
    std::array<SeenLight, kMostInStep> arrived_;
};

}  // namespace nephroid
