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
    /// `light` arrives at a path, below kMostInStep, unless something solid is in the way of the ray from its vertex of that number.
    void wait(std::uint32_t path, LightClass as, Spectrum light, ShadowRay const& shadow,
              std::uint32_t vertex) {
        if (!shadow.lit) {
            ++stats_.rays[static_cast<std::size_t>(RayKind::Shadow)];
            return;
        }
        std::size_t const i = add(path, as, light, false);
        Open& open = open_[vertex < kDepths ? vertex : kDepths - 1];
        open.entry[open.size] = static_cast<std::uint16_t>(i);
        open.rays.set(open.size, shadow.ray, shadow.t_max);
        if (++open.size == kLanes) trace(open);
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
            if (open.size > 0) trace(open);
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
        RayPacket rays;
        std::size_t size = 0;
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
        LaneMask const free = world_.unoccluded(open.rays, stats_);
        for (std::size_t i = 0; i < open.size; ++i) arrives_[open.entry[i]] = (free >> i & 1u) != 0;
        open.rays.used = 0;
        open.size = 0;
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
