// Arithmetic on rays in double, as analytic intersection wants it (model/shape.h). Without branches, so that lanes may use it.
#pragma once

#include "model/shape.h"

namespace nephroid::detail {

inline double dot3(std::array<double, 3> const& a, std::array<double, 3> const& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline std::array<double, 3> cross3(std::array<double, 3> const& a, std::array<double, 3> const& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline std::array<double, 3> at(Ray3d const& r, double t) {
    return {r.o[0] + t * r.d[0], r.o[1] + t * r.d[1], r.o[2] + t * r.d[2]};
}

}  // namespace nephroid::detail
