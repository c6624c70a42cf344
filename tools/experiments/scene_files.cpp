#include "scene_files.h"

#include "math/error.h"
#include "read/read.h"
#include "scene/scene.h"

#include <fmt/format.h>

namespace nephroid::experiment {

namespace {

Setup compiled(Scene scene) {
    if (!scene.notes.empty()) throw Error(ErrorKind::Input, scene.notes.front().text);
    Settings const settings = scene.settings;
    return {compile(std::move(scene)), settings};
}

}  // namespace

std::filesystem::path scenes_folder() { return NEPHROID_SCENES; }

Setup faithful(std::string const& pbrt, std::filesystem::path const& folder) {
    return compiled(read_pbrt_string(pbrt, "experiment", folder));
}

Setup prepare_file(std::string const& name) { return compiled(read_scene(scenes_folder() / name)); }

Setup prepare_noted(std::string const& name, std::string const& note) {
    Scene scene = read_scene(scenes_folder() / name);
    if (scene.notes.empty()) throw Error(ErrorKind::Input, name + ": no note says: " + note);
    std::erase_if(scene.notes, [&](auto const& n) { return n.text.find(note) != std::string::npos; });
    return compiled(std::move(scene));
}

std::string cornell(int pixels) {
    return fmt::format(
        "Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" {0}\n"
        "Include \"include/cornell-view.pbrt\"\nWorldBegin\nInclude \"include/cornell-room.pbrt\"\n",
        pixels);
}

}  // namespace nephroid::experiment
