// How photons are weighed by their distance. Each integrates to 1 over the unit disk; x2 is the squared distance over the squared
// radius, below 1.
#pragma once

#include "math/vec.h"
#include "scene/settings.h"

#include <cmath>

namespace nephroid {

struct BoxKernel {
    float operator()(float) const { return kInvPi; }
};
/// Jensen's (2001, eq. 7.17): falls by a straight line that would reach 0 at kappa.
struct ConeKernel {
    static constexpr float kKappa = 1.1f;
    float operator()(float x2) const {
        constexpr float kUnit = kInvPi / (1.0f - 2.0f / (3.0f * kKappa));
        return kUnit * (1.0f - std::sqrt(x2) / kKappa);
    }
};
/// Of all kernels the one with the least mean squared error (Silverman 1986, 4.2).
struct EpanechnikovKernel {
    float operator()(float x2) const { return 2.0f * kInvPi * (1.0f - x2); }
};
/// Of standard deviation half a radius, cut at the radius: the integral there is pi / 2 (1 - exp(-2)).
struct GaussianKernel {
    float operator()(float x2) const {
        constexpr float kUnit = 2.0f * kInvPi / 0.86466472f;
        return kUnit * std::exp(-2.0f * x2);
    }
};

/// Calls f with the kernel: the choice is made outside of loops over photons.
template <class F>
decltype(auto) with_kernel(Kernel kernel, F&& f) {
    switch (kernel) {
        case Kernel::Box:
            return f(BoxKernel{});
        case Kernel::Cone:
            return f(ConeKernel{});
        case Kernel::Gaussian:
            return f(GaussianKernel{});
        case Kernel::Epanechnikov:
            break;
    }
    return f(EpanechnikovKernel{});
}

}  // namespace nephroid
