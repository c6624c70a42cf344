// From linear sRGB reflectances to smooth spectra (Jakob & Hanika 2019, "A Low-Dimensional Function Space for Efficient
// Spectral Upsampling"). The table of coefficients is computed during the build by tools/uplift_table.cpp.
#pragma once

#include "math/vec.h"
#include "spectrum/runtime.h"

namespace nephroid {

/// Components are clamped to [0, 1]. Grays are exact: a constant spectrum.
SigmoidPolynomial srgb_to_sigmoid(Vec3 rgb);

}  // namespace nephroid
