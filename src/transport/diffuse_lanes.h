// Eight vertices at once: light sampling and scattering where each path has met a diffuse material of one colour, which is most of what
// paths meet. What is done is what walk.cpp does to one path, to the same bits: loops over lanes call the functions that one path uses.
#pragma once

#include "path_in_flight.h"
#include "world/ray_packet.h"

#include <span>

namespace nephroid {

class DiffuseLanes {
  public:
    /// Of up to kLanes paths, whose vertices are `in_lanes`, in a world that encloses nothing.
    explicit DiffuseLanes(std::span<PathInFlight* const> paths);

    /// add_direct() of each, by the one light of the world, which is flat (World::has_lone_flat_light). Its numbers have been drawn.
    void add_direct(bool mis);
    /// scatter() of each; the lanes of those that go on.
    LaneMask scatter();

  private:
    /// The shading normal on the side of the eye.
    [[nodiscard]] Vec3 facing(std::size_t i) const { return ns_[i] * (cos_wo_[i] < 0.0f ? -1.0f : 1.0f); }
    [[nodiscard]] LaneMask used() const { return (1u << paths_.size()) - 1u; }

    std::span<PathInFlight* const> paths_;
    Vec3Lanes p_, p_error_, ng_, ns_;
    FloatLanes cos_wo_{};
};

}  // namespace nephroid
