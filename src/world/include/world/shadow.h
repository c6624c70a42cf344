// From a surface point to a light: where the ray begins and ends.
#pragma once

#include "model/light.h"
#include "world/hit.h"
#include "world/ray_packet.h"

namespace nephroid {

/// What is in its way up to t_max keeps the light off.
struct ShadowRay {
    Ray ray;
    float t_max = kInfinity;  // in lengths of the direction
    bool lit = true;          // false where nothing but rounding would let light through
};

/// Between two points, each moved off its surface towards the other: the far one also by the rounding of the direction, which grows with
/// the distance and would else reach below a surface seen at grazing. The last 2^-20 of the way is left out: where the far end is a
/// corner, other surfaces begin there. n = 0: a point without a surface.
inline ShadowRay shadow_ray(Vec3 p, Vec3 p_error, Vec3 n, Vec3 to, Vec3 to_error, Vec3 to_n) {
    ShadowRay shadow;
    Ray& ray = shadow.ray;
    ray.o = offset_of_lane(p, p_error, n, to - p);
    // What rounding alone lifted out of a lamp's plane sees nothing of the lamp, not even where it is the lamp's own back.
    shadow.lit = !(dot(to_n, p - to) * dot(to_n, ray.o - to) < 0.0f);
    Vec3 const rounding = gamma_bound(3) * abs(to - ray.o);
    ray.d = offset_of_lane(to, to_error + rounding, to_n, ray.o - to) - ray.o;
    shadow.t_max = 1.0f - 0x1p-20f;
    return shadow;
}
/// … or to a light at infinity.
inline ShadowRay shadow_ray(SurfaceHit const& from, LightSample const& to) {
    if (to.at_infinity) return {from.spawn(to.wi), kInfinity, true};
    return shadow_ray(from.s.p, from.s.p_error, from.s.ng, to.p, to.p_error, to.n);
}

/// Ends of up to eight shadow rays.
class ShadowPacket {
  public:
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool full() const { return size_ == kLanes; }
    void clear() { size_ = 0, at_infinity_ = 0; }
    void add(SurfaceHit const& from, LightSample const& to) {
        p_.set(size_, from.s.p);
        p_error_.set(size_, from.s.p_error);
        n_.set(size_, from.s.ng);
        to_.set(size_, to.at_infinity ? to.wi : to.p);
        to_error_.set(size_, to.p_error);
        to_n_.set(size_, to.n);
        at_infinity_ |= static_cast<LaneMask>(to.at_infinity) << size_;
        ++size_;
    }
    /// Their rays: as shadow_ray() makes them, one by one. Those that cannot be lit are not used.
    [[nodiscard]] RayPacket rays() const;

  private:
    Vec3Lanes p_, p_error_, n_;
    Vec3Lanes to_, to_error_, to_n_;  // to_: of a light at infinity, the direction
    LaneMask at_infinity_ = 0;
    std::size_t size_ = 0;
};

inline RayPacket ShadowPacket::rays() const {
    RayPacket rays;
    std::array<std::uint32_t, kLanes> lit;
    for (std::size_t i = 0; i < kLanes; ++i) {
        ShadowRay const s = shadow_ray(p_[i], p_error_[i], n_[i], to_[i], to_error_[i], to_n_[i]);
        rays.o.set(i, s.ray.o);
        rays.d.set(i, s.ray.d);
        rays.t_max[i] = s.t_max;
        lit[i] = static_cast<std::uint32_t>(s.lit) << i;
    }
    for (std::size_t i = 0; i < size_; ++i) rays.used |= lit[i];
    for (std::size_t i = 0; i < size_ && at_infinity_ != 0; ++i)
        if ((at_infinity_ >> i & 1u) != 0)
            rays.set(i, {offset_ray_origin(p_[i], p_error_[i], n_[i], to_[i]), to_[i]}, kInfinity);
    return rays;
}

}  // namespace nephroid
