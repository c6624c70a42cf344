// What shapes are called in scene files and in what the program says.
#pragma once

#include "scene/shape.h"

namespace nephroid {

/// pbrt-v4's name, such as "trianglemesh"; "box" and "quad" are ours.
char const* name_of(Shape const& shape);

}  // namespace nephroid
