// Eight vertices at once: light sampling and scattering where each path has met a diffuse material of one colour, which is most of what
// paths meet. What is done is what walk.cpp does to one path, to the same bits: loops over lanes call the functions that one path uses.
#pragma once

#include "math/lanes.h"
#include "model/triangle_lanes.h"
#include "path_in_flight.h"
#include "world/light_lanes.h"

#include <span>

namespace nephroid {

class DiffuseLanes {
  public:
    /// Of up to kLanes paths, whose vertices are `in_lanes`, in a world that encloses nothing.
    explicit DiffuseLanes(std::span<PathInFlight* const> paths);

    /// Fills what was left out of the vertices' hits.
    void complete_hits() const;
    /// What the one light of the world sends, which is flat (World::has_lone_flat_light), by the numbers `u`. Some may have to wait for others
    /// before they know.
    void sample_light(Vec2 const* u, WaitingReceivers& waiting);
    /// add_direct() of each by that.
    void add_direct(bool mis) const;
    /// scatter() of each by the numbers `u`; the lanes of those that go on.
    [[nodiscard]] LaneMask scatter(Vec2 const* u) const;

  private:
    /// The shading normal on the side of the eye.
    [[nodiscard]] Vec3 facing(std::size_t i) const { return s_.ns[i] * (cos_wo_[i] < 0.0f ? -1.0f : 1.0f); }

    [[nodiscard]] LaneMask used() const { return (1u << paths_.size()) - 1u; }

    std::span<PathInFlight* const> paths_;
    SurfaceLanes s_;
    Vec3Lanes d_;  // of the rays that came
    FloatLanes cos_wo_{};
    LightSampleLanes light_;
};

}  // namespace nephroid
