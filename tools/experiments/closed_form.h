// What formulas say: irradiance of a horizontal receiver (normal +z) under lights of radiance 1, without occlusion, and Fresnel's
// reflectance. Double precision, and nothing of the renderer's own.
#pragma once

#include "math/vec.h"

#include <array>
#include <complex>
#include <vector>

namespace nephroid::experiment {

using Point = std::array<double, 3>;

/// A planar convex polygon that is seen from its front (corners counter-clockwise as seen from there); 0 from behind. What
/// is below the horizon is cut off. Lambert 1760, theorem by edges: E = 1/2 sum gamma_i (n . Gamma_i).
double polygon_irradiance(Vec3 receiver, std::vector<Point> const& corners);
/// origin, edges u and v; the front is the side of u x v, as for the shape "quad".
double parallelogram_irradiance(Vec3 receiver, Point origin, Point u, Point v);
/// The faces of an axis-aligned box that shines outwards.
double box_irradiance(Vec3 receiver, Point lo, Point hi);

/// Reflectance of a smooth surface of refractive index `index` (eta + ik; a dielectric has k = 0), seen from outside, to unpolarised
/// light: the mean of |r|^2 of Fresnel's two amplitudes (Born & Wolf, Principles of Optics, 1.5.2 and 14.2).
double fresnel_reflectance(double cosine, std::complex<double> index);

}  // namespace nephroid::experiment
