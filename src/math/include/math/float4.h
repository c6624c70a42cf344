// A Vec3 in one register of four lanes, for the few places where every path passes: hits and new rays. Each function makes the
// very bits of its namesake on Vec3 (the same operations in the same order), with about a third of the instructions; the
// fourth lane means nothing.
#pragma once

#include "math/vec.h"

#include <bit>
#include <cstdint>

namespace nephroid {

typedef float Float4 __attribute__((vector_size(16)));
typedef std::int32_t Int4 __attribute__((vector_size(16)));

inline Float4 to_lanes(Vec3 const& v) {
    // Said in this way it is two loads and nothing else.
    typedef float Float2 __attribute__((vector_size(8)));
    Float2 const xy{v.x, v.y};
    Float4 lanes = __builtin_shufflevector(xy, xy, 0, 1, -1, -1);
    lanes[2] = v.z;
    return lanes;
}
inline Vec3 to_vec3(Float4 v) { return {v[0], v[1], v[2]}; }

inline Float4 abs(Float4 v) { return std::bit_cast<Float4>(std::bit_cast<Int4>(v) & 0x7FFFFFFF); }
inline float dot(Float4 a, Float4 b) {
    Float4 const products = a * b;
    return products[0] + products[1] + products[2];
}
inline Float4 choose(bool first, Float4 a, Float4 b) { return first ? a : b; }
inline float length(Float4 v) { return std::sqrt(dot(v, v)); }

/// a*b - c*d without cancellation, lane by lane.
inline Float4 difference_of_products(Float4 a, Float4 b, Float4 c, Float4 d) {
    Float4 difference;
    for (int i = 0; i < 4; ++i) difference[i] = difference_of_products(a[i], b[i], c[i], d[i]);
    return difference;
}
inline Float4 cross_accurate(Float4 a, Float4 b) {
    // (y, z, x), so that the lanes of the difference are z, x and y of the product.
    auto const rotated = [](Float4 v) { return Float4{v[1], v[2], v[0], v[3]}; };
    return rotated(difference_of_products(a, rotated(b), rotated(a), b));
}

}  // namespace nephroid
