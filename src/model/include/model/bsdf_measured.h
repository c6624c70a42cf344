// Measured reflection (Dupuy & Jakob 2018, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering").
#pragma once

#include "model/bsdf_sample.h"
#include "spectrum/wavelengths.h"

namespace nephroid {

class MeasuredTables;

struct MeasuredBsdf {
    MeasuredTables const* tables = nullptr;
    Wavelengths lambda;
};
inline BsdfTraits traits(MeasuredBsdf const&) { return {}; }
NEPHROID_BSDF(MeasuredBsdf);
static_assert(ScatteringModel<MeasuredBsdf>);

}  // namespace nephroid
