// `nephroid convert`: any scene that is read, as a pbrt-v4 file.
#include "asked_settings.h"
#include "commands.h"
#include "console.h"
#include "math/error.h"
#include "memory.h"
#include "read/read.h"
#include "scene/match.h"
#include "targets.h"
#include "world/world.h"
#include "write/write.h"

#include <fmt/format.h>

namespace nephroid::cli {

namespace {

/// Nothing that the scene is made of may be written over; what is written is known only once the text is made.
void check_files(ConvertOptions const& o, Scene const& scene, SceneText const& text) {
    std::vector<NamedFile> files{{"the output", o.output, FileRole::Output}};
    for (SceneText::File const& part : text.parts)
        files.push_back({"the output's", part.path.string(), FileRole::Output});
    files.push_back({"the scene", o.scene, FileRole::Input});
    for (std::string const& f : scene.files)
        if (f != o.scene) files.push_back({"the scene's", f, FileRole::Input});
    for (ImageFile const& image : scene.images) files.push_back({"the picture", image.path, FileRole::Input});
    for (Material const& m : scene.materials)
        if (auto const* k = std::get_if<MeasuredMaterial>(&m.kind))
            files.push_back({"the measured file", k->file.path, FileRole::Input});
    check_conflicts(files);
}

}  // namespace

int run(ConvertOptions const& o) {
    if (extension_of(o.output) != ".pbrt")
        refuse_option(fmt::format("{}: scenes are written as .pbrt files; choose such a name", o.output));
    check_target("the output", o.output);
    Scene scene = read_scene(o.scene);
    scene.settings = settings_of(o, scene);
    SceneText const text = pbrt_text(scene, o.output, {.portable = o.portable});
    check_files(o, scene, text);
    std::size_t const approximated = scene.notes.size();
    // What cannot be rendered is not handed on, and only the compiler opens the pictures.
    MemoryNeed const need = memory_need(scene, {}, false);
    check_memory({need.program, need.world, 0, 0}, std::nullopt);
    World const world = compile(std::move(scene));
    write_files(text);
    for (Note const& n : text.notes) say("{}: {}\n", world.scene().locate(n.where), n.text);
    print_written(o.output);
    if (!o.quiet && approximated > 0)
        say("{} of the scene's parts were approximated when it was read: nephroid info {}\n", approximated,
            o.scene);
    return kGood;
}

}  // namespace nephroid::cli
