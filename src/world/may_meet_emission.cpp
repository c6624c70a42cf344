// Which rays can meet emission at all: those through the box around whatever emits.
#include "world/world.h"

namespace nephroid {

bool World::may_meet_emission(Ray const& ray) const {
    if (emitting_.empty()) return false;
    // What is no number is for those to refuse who trace rays.
    if (!is_finite(ray.o) || !is_finite(ray.d)) return true;
    // Between the planes of a box along each axis (Kay & Kajiya 1986). A ray within one of the planes
    // is outside: the box is wider than what emits. A surface is met from afar as if it were a few roundings of the distance away.
    constexpr float kSlack = 1e-5f;
    float near = 0, far = kInfinity;
    for (int i = 0; i < 3; ++i) {
        float const inverse = 1.0f / ray.d[i];
        float const a = (emitting_.lo[i] - ray.o[i]) * inverse, b = (emitting_.hi[i] - ray.o[i]) * inverse;
        float const first = a < b ? a : b, last = a < b ? b : a;
        near = first > near ? first : near;
        far = last < far ? last : far;
    }
    return near * (1.0f - kSlack) <= far * (1.0f + kSlack);
}

}  // namespace nephroid
