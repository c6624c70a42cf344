// A description as numbers each nm. compile() and the integrals share it, so that a light divided by its photometric() is
// just what the runtime samples.
#pragma once

#include "cie.h"
#include "spectrum/spd.h"

#include <string>

namespace nephroid {

/// Any description but an rgb triple. Throws Error(Input); see SpectrumStore::compile.
Dense dense_values(Spd const& spd);

[[noreturn]] void refuse_spectrum(std::string const& message);

}  // namespace nephroid
