// Pictures whose header names other primaries than Rec. 709's.
#pragma once

#include "image/image.h"

namespace nephroid {

/// Converts the R, G, B of an image that carries chromaticities to linear Rec. 709 and drops them; colours outside its
/// gamut become negative numbers. CIE XYZ is kept as it is, without chromatic adaptation, as pbrt-v4 and OpenEXR's own
/// viewer do it. Returns whether pixels changed: not without chromaticities or RGB, nor if they are Rec. 709's already.
/// Primaries that span no colours are ignored.
bool convert_to_rec709(Image& image);

}  // namespace nephroid
