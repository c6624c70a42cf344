// Spectral distributions out of parameters and .spd files.
#pragma once

#include "params.h"
#include "spectrum/spd.h"

namespace nephroid {

/// From an rgb, spectrum or blackbody parameter, or a float (the same at all wavelengths), with exactly one value. An rgb triple is brought to linear sRGB and into
/// the range of its role, with a note where that changes it.
Spd spd_of(Context& context, Param const& param, SpectrumRole role);
/// The emission in parameter `name`; pbrt's default, the colour space's white, where it is not there.
Spd emission(Params& params, std::string_view name);
/// Lines of `wavelength value`, wavelengths in nm and increasing, # comments.
TabulatedSpd parse_spd(std::string_view text, std::string const& name);

}  // namespace nephroid
