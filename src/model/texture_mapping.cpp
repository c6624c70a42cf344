#include "model/texture_mapping.h"

#include "scene/match.h"

#include <cmath>

namespace nephroid {

namespace {

/// The gradients of s and t in texture space turn the footprint there into one in (s, t).
MappedPoint with_footprint(Vec2 st, Vec3 ds_dp, Vec3 dt_dp, Transform const& to_texture,
                           TexturePoint const& at) {
    Vec3 const dx = to_texture.vector(at.dpdx), dy = to_texture.vector(at.dpdy);
    return {st, {dot(ds_dp, dx), dot(dt_dp, dx)}, {dot(ds_dp, dy), dot(dt_dp, dy)}};
}

/// The gradient of the azimuth over 2 pi. It knows no seam: where the azimuth jumps from 2 pi to 0, its gradient does not.
Vec3 turn_gradient(Vec3 v) {
    float const r2 = v.x * v.x + v.y * v.y;
    return r2 > 0.0f ? Vec3{-v.y, v.x, 0.0f} * (kInvTwoPi / r2) : Vec3{0.0f};
}

MappedPoint spherical(Transform const& to_texture, TexturePoint const& at) {
    Vec3 const v = to_texture.point(at.p);
    float const from_axis = std::sqrt(v.x * v.x + v.y * v.y);
    // By both legs of the triangle: acos(z / |v|) loses half its digits at the poles.
    float const theta = std::atan2(from_axis, v.z);
    float phi = std::atan2(v.y, v.x);
    if (phi < 0.0f) phi += kTwoPi;
    float const r2 = length_squared(v);
    Vec3 const ds_dp = from_axis > 0.0f
                           ? Vec3{v.x * v.z / from_axis, v.y * v.z / from_axis, -from_axis} * (kInvPi / r2)
                           : Vec3{0.0f};
    return with_footprint({theta * kInvPi, phi * kInvTwoPi}, ds_dp, turn_gradient(v), to_texture, at);
}

}  // namespace

MappedPoint map_point_in_space(TextureMapping const& mapping, Transform const& to_texture,
                               TexturePoint const& at) {
    return match(
        mapping, [](UvMapping const&) { return MappedPoint{}; },
        [&](SphericalMapping const&) { return spherical(to_texture, at); },
        [&](CylindricalMapping const&) {
            Vec3 const v = to_texture.point(at.p);
            return with_footprint({(kPi + std::atan2(v.y, v.x)) * kInvTwoPi, v.z}, turn_gradient(v),
                                  {0, 0, 1}, to_texture, at);
        },
        [&](PlanarMapping const& m) {
            Vec3 const v = to_texture.point(at.p);
            return with_footprint({m.du + dot(v, m.v1), m.dv + dot(v, m.v2)}, m.v1, m.v2, to_texture, at);
        });
}

}  // namespace nephroid
