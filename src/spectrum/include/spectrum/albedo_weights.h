// What each node of a reflectance that is tabulated over wavelengths adds to its colour: for tables of many reflectances over the
// same wavelengths, each of which is then a short sum.
#pragma once

#include "math/vec.h"

#include <span>
#include <vector>

namespace nephroid {

/// Colour under D65, as linear sRGB, of a reflectance that is linear between wavelengths (nm, strictly ascending) and constant
/// beyond them: the sum over its nodes of value * weight. Not clamped: colours beyond sRGB have negative components.
std::vector<Vec3> albedo_to_srgb_weights(std::span<float const> wavelengths);

}  // namespace nephroid
