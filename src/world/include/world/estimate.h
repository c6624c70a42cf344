// What a scene is going to cost in memory, from its description alone: a scene that does not fit is refused, and not
// found out about by the machine. Counts are in 64 bits, nothing is expanded, and the scene need not be valid.
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace nephroid {

/// Memory of the compiled world at its peak, while it is built, and of the scene in it: right to a third or so, and rather
/// too high.
std::uint64_t estimated_bytes(Scene const& scene);
/// The part of it that the scene's own arrays hold already.
std::uint64_t held_bytes(Scene const& scene);

}  // namespace nephroid
