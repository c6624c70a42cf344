// An axis-aligned box; empty until something is added.
#pragma once

#include "math/vec.h"

namespace nephroid {

struct Bounds3 {
    Vec3 lo{kInfinity, kInfinity, kInfinity};
    Vec3 hi{-kInfinity, -kInfinity, -kInfinity};

    void add(Vec3 p) { lo = min(lo, p), hi = max(hi, p); }
    void add(Bounds3 const& b) { lo = min(lo, b.lo), hi = max(hi, b.hi); }
    [[nodiscard]] bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    [[nodiscard]] Vec3 centre() const { return lo * 0.5f + hi * 0.5f; }
    [[nodiscard]] Vec3 diagonal() const { return hi - lo; }
    [[nodiscard]] Vec3 corner(int i) const {
        return {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
    }
};

struct BoundingSphere {
    Vec3 centre{0, 0, 0};
    float radius = 0;
};
inline BoundingSphere bounding_sphere(Bounds3 const& b) {
    if (b.empty()) return {};
    return {b.centre(), 0.5f * length(b.diagonal())};
}

}  // namespace nephroid
