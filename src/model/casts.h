// Which materials throw caustics. Internal to model.
#pragma once

#include "model/assets.h"

namespace nephroid {

/// May a surface of this kind scatter specularly, as BsdfTraits::near_specular or a sample's `delta` have it? What varies over the
/// surface counts as if it took every value. Not of mixes.
bool may_be_specular(Assets const& assets, MaterialKind const& kind);

}  // namespace nephroid
