// The CIE 1931 observer and D65 at each nm.
#pragma once

#include "spectrum/runtime.h"

#include <array>

namespace nephroid {

using Dense = std::array<double, kDenseCount>;
struct Observer {
    Dense x, y, z;
};
extern Observer const kCie1931;
inline Observer const& cie_1931() { return kCie1931; }
Dense const& illuminant_d65();
/// The light of a colour space's white.
Dense const& illuminant(RgbWhite white);

}  // namespace nephroid
