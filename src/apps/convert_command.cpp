// `nephroid convert`: any scene that is read, as a pbrt-v4 file.
#include "asked_settings.h"
#include "commands.h"
#include "console.h"
#include "math/error.h"
#include "read/read.h"
#include "scene/match.h"
#include "targets.h"
#include "write/write.h"

#include <fmt/format.h>

#include <filesystem>

namespace nephroid::cli {

namespace {

/// Nothing that the scene is made of may be written over; what is written is known only once the text is made.
void check_files(ConvertOptions const& o, Scene const& scene, SceneText const& text) {
    std::vector<NamedFile> files{{"the output", o.output, FileRole::Output}};
    for (SceneText::File const& part : text.parts)
        files.push_back({"the output's", part.path.string(), FileRole::Output});
    std::size_t const written = files.size();
    files.push_back({"the scene", o.scene, FileRole::Input});
    for (std::string const& f : scene.files)
        if (f != o.scene) files.push_back({"the scene's", f, FileRole::Input});
    for (ImageFile const& image : scene.images) files.push_back({"the picture", image.path, FileRole::Input});
    for (Material const& m : scene.materials)
        if (auto const* k = std::get_if<MeasuredMaterial>(&m.kind))
            files.push_back({"the measured file", k->file.path, FileRole::Input});
    // Each output against the inputs: many parts make many pairs, and no two of them have one name.
    for (std::size_t i = 0; i < written; ++i) {
        std::vector<NamedFile> one(files.begin() + static_cast<std::ptrdiff_t>(written), files.end());
        one.push_back(files[i]);
        check_conflicts(one);
    }
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
    write_files(text);
    for (Note const& n : text.notes) say("{}: {}\n", scene.locate(n.where), n.text);
    print("{}\n", std::filesystem::absolute(o.output).lexically_normal().string());
    if (!o.quiet && !scene.notes.empty())
        say("{} of the scene's parts were approximated when it was read: nephroid info {}\n",
            scene.notes.size(), o.scene);
    return kGood;
}

}  // namespace nephroid::cli
