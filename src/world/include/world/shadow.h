// From a surface point to a light: where the ray begins and ends.
#pragma once

#include "model/light.h"
#include "world/hit.h"

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

}  // namespace nephroid
