// A scene around a bare mesh file, to look at it.
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace nephroid {

Scene mesh_scene(std::filesystem::path const& path);

}  // namespace nephroid
