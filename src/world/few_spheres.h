// Whole spheres of the world's own, where there are but a few and no other analytic shapes: they are asked here whether a ray meets them,
// eight rays at once or one. Embree would keep a tree of its own for them, and call back for every ray (docs/decisions/0012).
#pragma once

#include "math/bounds.h"
#include "records.h"
#include "world/ray_packet.h"

#include <cstdint>
#include <span>
#include <vector>

namespace nephroid {

/// The sphere that a ray meets first; t infinite: none.
struct SphereMet {
    double t = kInfinity;  // in (t_min, t_max)
    std::size_t sphere = 0;

    [[nodiscard]] bool found() const { return t < static_cast<double>(kInfinity); }
};
/// … of eight rays.
struct SphereMetLanes {
    alignas(32) std::array<double, kLanes> t;
    alignas(32) std::array<std::uint64_t, kLanes> sphere;

    [[nodiscard]] SphereMet operator[](std::size_t lane) const { return {t[lane], sphere[lane]}; }
};

/// Encloses a sphere, in the world; most rays miss it, and that is told sooner than in double.
struct EnclosingBall {
    Vec3 centre{0, 0, 0};
    float radius2 = kInfinity;  // infinite: nothing misses it

    EnclosingBall(ObjectRecord const& record, float radius);
    /// Surely missed. No branch, so that lanes may use it.
    [[nodiscard]] bool misses(Vec3 o, Vec3 d) const;
};

class FewSpheres {
  public:
    /// Takes the analytic shapes of a group if it can take all of them. The records must stay where they are.
    void take(std::span<ObjectRecord const> group);
    [[nodiscard]] bool empty() const { return spheres_.empty(); }

    // Hits have the bits of intersect(Sphere, …). `sees`: passages, as a set of bits. Of several spheres at one distance, as a float, the
    // first of the group is met.
    [[nodiscard]] SphereMet nearest(Ray const& ray, double t_min, double t_max, std::uint32_t sees) const;
    void nearest(RayPacket const& rays, LaneMask lanes, double t_min, std::uint32_t sees,
                 SphereMetLanes& met) const;

    /// What Embree would say of it.
    void complete(Ray const& ray, SphereMet const& met, RawHit& hit) const;
    [[nodiscard]] std::uint32_t geometry(SphereMet const& met) const { return spheres_[met.sphere].geometry; }

    [[nodiscard]] bool has(std::uint32_t geometry) const;
    [[nodiscard]] std::size_t bytes() const { return spheres_.capacity() * sizeof(Place); }

  private:
    struct Place {
        EnclosingBall ball;
        std::array<std::array<double, 4>, 3> to_shape;
        double radius;
        std::uint32_t seen_by, geometry;
        ObjectRecord const* record;
    };
    std::vector<Place> spheres_;
};

}  // namespace nephroid
