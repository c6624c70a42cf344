// A scene of what pbrt-v4 itself knows.
#pragma once

#include "scene/scene.h"

namespace nephroid {

/// `scene`, which validate() has passed, with the nearest thing of pbrt-v4's in place of what is ours
/// alone; its notes say what was replaced or left out. Groups that pbrt could not instance (of instances,
/// or that emit) are taken apart.
Scene portable_scene(Scene scene);

// Its parts.
void make_portable(Settings& settings, Scene& scene);
void make_materials_portable(Scene& scene);
void make_textures_portable(Scene& scene);
void make_lights_portable(Scene& scene);
/// Objects of every group: shapes, and their lights.
void make_objects_portable(Scene& scene);
void take_groups_apart(Scene& scene);

}  // namespace nephroid
