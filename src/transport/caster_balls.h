// Casters of caustics, gathered into a few balls.
#pragma once

#include "world/world.h"

#include <span>
#include <vector>

namespace nephroid {

/// At most `most` balls that hold all pieces between them; fewer where more would not be tighter. They may overlap.
std::vector<BoundingSphere> caster_balls(std::vector<CasterPiece> pieces, std::size_t most);

}  // namespace nephroid
