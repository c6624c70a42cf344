// What a picture and a film file have in common: R G B, windows, and whose passes they are.
#pragma once

#include "film/develop.h"

namespace nephroid {

ExrFile develop_beauty_exr(Film const& film, DevelopSettings const& settings);

}  // namespace nephroid
