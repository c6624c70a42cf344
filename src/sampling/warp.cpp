#include "sampling/warp.h"

namespace nephroid {

Vec3 equal_area_square_to_sphere(Vec2 p) {
    // To [-1,1]^2, and to the first quadrant; the signs come back at the end.
    float const u = 2.0f * p.x - 1.0f;
    float const v = 2.0f * p.y - 1.0f;
    float const up = std::abs(u);
    float const vp = std::abs(v);
    // r: distance from the z axis's fold, negative in the lower hemisphere's corner.
    float const signed_distance = 1.0f - (up + vp);
    float const d = std::abs(signed_distance);
    float const r = 1.0f - d;
    float const phi = (r == 0.0f ? 1.0f : (vp - up) / r + 1.0f) * kPiOver4;
    float const z = std::copysign(1.0f - r * r, signed_distance);
    float const s = r * safe_sqrt(2.0f - r * r);
    return {std::copysign(std::cos(phi), u) * s, std::copysign(std::sin(phi), v) * s, z};
}

Vec2 equal_area_sphere_to_square(Vec3 d) {
    float const x = std::abs(d.x);
    float const y = std::abs(d.y);
    float const z = std::abs(d.z);
    float const r = safe_sqrt(1.0f - z);
    float const phi = (x == 0.0f && y == 0.0f) ? 0.0f : std::atan2(y, x) * 2.0f / kPi;  // in units of pi/2
    float v = phi * r;
    float u = r - v;
    if (d.z < 0.0f) {  // the lower hemisphere folds outwards
        float const t = u;
        u = 1.0f - v;
        v = 1.0f - t;
    }
    u = std::copysign(u, d.x);
    v = std::copysign(v, d.y);
    return {(u + 1.0f) * 0.5f, (v + 1.0f) * 0.5f};
}

Vec2 wrap_equal_area_square(Vec2 uv) {
    if (uv.x < 0.0f) {
        uv = {-uv.x, 1.0f - uv.y};
    } else if (uv.x > 1.0f) {
        uv = {2.0f - uv.x, 1.0f - uv.y};
    }
    if (uv.y < 0.0f) {
        uv = {1.0f - uv.x, -uv.y};
    } else if (uv.y > 1.0f) {
        uv = {1.0f - uv.x, 2.0f - uv.y};
    }
    return uv;
}

Vec2 invert_bilinear(Vec2 p, float const w[4]) {
    return {invert_linear(p.x, lerp(p.y, w[0], w[2]), lerp(p.y, w[1], w[3])),
            invert_linear(p.y, w[0] + w[1], w[2] + w[3])};
}

}  // namespace nephroid
