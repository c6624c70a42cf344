// Where a line meets a sphere about the origin: for a ray by itself (sphere.cpp) and for eight at once (world/few_spheres.cpp), which
// is why nothing here branches.
#pragma once

#include "model/ray3d.h"

#include <cmath>

namespace nephroid {

/// |o + t d|^2 = r^2, that is a t^2 + 2 h t + c = 0. The discriminant by the distance of the line from the centre, |o x d| / |d|, which does
/// not cancel for far spheres (as PBRT 4th ed., 6.8.3); the sign of c tells on which side of the sphere the origin is.
struct SphereEquation {
    double a, h, c, discriminant;

    SphereEquation(double a_, double h_, double c_, double discriminant_)
        : a(a_), h(h_), c(c_), discriminant(discriminant_) {}
    SphereEquation(Ray3d const& ray, double r)
        : a(detail::dot3(ray.d, ray.d)),
          h(detail::dot3(ray.d, ray.o)),
          c(detail::dot3(ray.o, ray.o) - r * r) {
        auto const moment = detail::cross3(ray.o, ray.d);
        discriminant = a * r * r - detail::dot3(moment, moment);
    }
    [[nodiscard]] bool from_inside() const { return c < 0; }
    /// False where the line misses, or all of the sphere is behind the origin.
    [[nodiscard]] bool solvable() const {
        bool const behind = (c > 0) & (h > 0);
        return !behind & (discriminant >= 0) & (a != 0);
    }
};

/// Both solutions, in order. From inside the near one is behind, and means nothing.
struct SphereRoots {
    double near, far;

    explicit SphereRoots(SphereEquation const& e) {
        double const root = std::sqrt(e.discriminant);
        double const q = e.h < 0 ? -e.h + root : -e.h - root;
        // Without cancellation.
        double const by_a = q / e.a;
        double const by_c = e.c / q;
        near = e.h < 0 ? by_c : by_a;
        far = e.h < 0 ? by_a : by_c;
    }
};

/// Not cut, in z or in phi.
bool is_whole(Sphere const& s);

}  // namespace nephroid
