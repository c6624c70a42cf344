// Descriptions of spectral distributions: plain structs, as a scene names them. Wavelengths are nm.
// What they are worth at run time is compiled by spectrum/runtime.h.
#pragma once

#include "math/vec.h"
#include "spectrum/wavelengths.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace nephroid {

struct ConstantSpd {
    float value = 0;
};
/// Piecewise linear between strictly increasing wavelengths, 0 outside them (pbrt-v4).
struct TabulatedSpd {
    std::vector<float> lambda, value;
};
/// Planck's law, scaled so that its maximum is 1 (pbrt-v4).
struct BlackbodySpd {
    float kelvin = 6500;
};
/// One of named_spectrum_names(), e.g. "metal-Ag-eta", "glass-BK7", "stdillum-D65".
struct NamedSpd {
    std::string name;
};
/// The light that an emission given as rgb is a share of: that of the colour space in which it was given.
enum class RgbWhite : std::uint8_t { D65, AcesD60 };
/// Linear sRGB triple, read by its role: a reflectance in [0,1] (Jakob & Hanika 2019 sigmoid), an unbounded quantity
/// (scaled sigmoid), or an emission (scaled sigmoid times its white). PBRT 4th ed., 4.6.6.
struct RgbAlbedoSpd {
    Vec3 rgb{0, 0, 0};
};
struct RgbUnboundedSpd {
    Vec3 rgb{0, 0, 0};
};
struct RgbIlluminantSpd {
    Vec3 rgb{0, 0, 0};
    RgbWhite white = RgbWhite::D65;
};

using Spd = std::variant<ConstantSpd, TabulatedSpd, BlackbodySpd, NamedSpd, RgbAlbedoSpd, RgbUnboundedSpd,
                         RgbIlluminantSpd>;

/// How a distribution that is not an rgb triple turns into three numbers in rgb mode.
enum class SpectrumRole : std::uint8_t {
    Albedo,     // colour under D65, clamped to [0,1]
    Unbounded,  // the same, not clamped (eta, k, absorption)
    Illuminant  // CIE XYZ of the emission itself, as linear sRGB (see docs/conventions.md)
};

}  // namespace nephroid
