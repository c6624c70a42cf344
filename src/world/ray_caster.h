// The one place that calls Embree (3.13 or 4): builds its scenes and asks it about rays. Every ray is checked here, since
// Debian's build aborts on NaN and infinite ones.
#pragma once

#include "math/bounds.h"
#include "model/assets.h"
#include "records.h"
#include "world/ray_packet.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid {

class RayCaster {
  public:
    /// Which surfaces a ray sees, as a set of bits by Passage.
    static constexpr std::uint32_t seen(Passage p) { return 1u << static_cast<unsigned>(p); }
    static constexpr std::uint32_t kAll = 7;

    /// `assets`, for surfaces that alpha textures cut, must stay where they are.
    explicit RayCaster(Assets const& assets);
    ~RayCaster();
    RayCaster(RayCaster const&) = delete;
    RayCaster& operator=(RayCaster const&) = delete;

    /// A group's own objects; returns its number. Geometry ids are the objects' positions in `records`. The records and
    /// their objects must stay where they are.
    std::uint32_t add_group(std::vector<ObjectRecord> const& records, std::size_t first, std::size_t count);
    /// Puts group 0's objects and the given appearances of other groups into the scene that is traced. The instances must stay
    /// where they are.
    void finish(std::vector<InstanceRecord> const& instances,
                std::vector<std::uint32_t> const& group_of_instance);

    bool nearest(Ray const& ray, float t_max, RawHit& hit, std::uint32_t sees = kAll) const;
    /// Is anything solid in the way?
    bool any(Ray const& ray, float t_max) const;

    /// Of rays side by side that go much the same way: what each meets first. Of several surfaces at one distance it is the one of the
    /// least (instance, geometry, primitive), so that a ray meets the same whatever is beside it.
    void nearest(RayPacket const& rays, LaneMask lanes, std::array<RawHit, kLanes>& hits) const;
    /// The lanes in whose way is anything solid. (One by one where there are instances: eight rays that go apart meet more of them than
    /// each, and all are transformed for every one: 30% more instructions, 3 to 6% more time in scenes/instances.pbrt.)
    [[nodiscard]] LaneMask any(RayPacket const& rays, LaneMask lanes) const;
    /// False for rays that must not reach Embree.
    static bool acceptable(Ray const& ray, float t_max);

    [[nodiscard]] Bounds3 bounds() const;
    [[nodiscard]] std::size_t bytes() const;

    /// The lanes that may.
    static LaneMask acceptable(RayPacket const& rays);

  private:
    struct Impl;
    [[nodiscard]] std::uint32_t instance_of(std::uint32_t id) const {
        return id == kNoInstance ? kNoInstance : id - first_instance_;
    }

    std::unique_ptr<Impl> impl_;
    std::uint32_t first_instance_ = 0;  // geometry id of instance 0
    bool instanced_ = false;            // there are appearances of groups
};

inline bool RayCaster::acceptable(Ray const& ray, float t_max) {
    // Embree 3.13 of Debian asserts |origin| < 1.844e18 and finite directions; a zero direction goes nowhere.
    // Comparisons with NaN are false, so that one product of bounds does for all.
    auto const tame = [](float x) { return std::abs(x) < 1e18f; };
    float const length2 = ray.d.x * ray.d.x + ray.d.y * ray.d.y + ray.d.z * ray.d.z;
    return bool(tame(ray.o.x) & tame(ray.o.y) & tame(ray.o.z) & (length2 > 0.0f) & (length2 < 1e36f) &
                (t_max >= 0.0f));
}
inline LaneMask RayCaster::acceptable(RayPacket const& rays) {
    std::array<LaneMask, kLanes> bit;
    for (std::size_t i = 0; i < kLanes; ++i)
        bit[i] = static_cast<LaneMask>(acceptable(rays.ray(i), rays.t_max[i])) << i;
    LaneMask lanes = 0;
    for (LaneMask const b : bit) lanes |= b;
    return lanes & rays.used;
}

}  // namespace nephroid
