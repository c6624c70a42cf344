// Perlin's improved noise (K. Perlin, "Improving Noise", SIGGRAPH 2002) and sums of it over octaves, as pbrt-v4 takes them
// (PBRT 3rd ed., 10.6). Everywhere finite: coordinates that are not read 0.
#pragma once

#include "math/vec.h"

namespace nephroid {

/// A smooth function of space without direction or place, within [-1, 1], 0 at whole numbers and with mean 0. It has no
/// detail finer than about 1 and repeats after 256 units.
float perlin_noise(Vec3 p);

/// What a sum of octaves is asked for: where, with which footprint, how many octaves at most, and by how much each is
/// weaker than the one before.
struct Octaves {
    Vec3 p{0};
    Vec3 dpdx{0}, dpdy{0};
    float roughness = 0.5f;
    int count = 8;

    /// The same seen at `s` times the scale.
    [[nodiscard]] Octaves scaled(float s) const { return {s * p, s * dpdx, s * dpdy, roughness, count}; }
};

/// Fractional Brownian motion. Octaves finer than half the footprint are left out: their mean is 0.
float fbm(Octaves const& o);
/// The same of the noise's absolute value, whose mean of 0.2 stands in for octaves that are left out. As in pbrt-v4 the first
/// of these counts twice, so that one mean of the last octave remains without any footprint.
float turbulence(Octaves const& o);

}  // namespace nephroid
