// `nephroid photons`: the photons of one pass, or their paths, as files to look at.
#include "asked_settings.h"
#include "commands.h"
#include "console.h"
#include "math/error.h"
#include "memory.h"
#include "names.h"
#include "photon_ply.h"
#include "read/read.h"
#include "scene/match.h"
#include "signals.h"
#include "targets.h"

#include <fmt/format.h>

namespace nephroid::cli {

namespace {

void check_files(PhotonsOptions const& o, Scene const& scene) {
    std::size_t const most = o.paths ? 2 : 1;
    if (o.outputs.size() > most)
        refuse_option(fmt::format("-o {}: there is one file to write{}; leave the others out",
                                  o.outputs[most], o.paths ? " for photons and one for paths" : ""));
    std::vector<NamedFile> files;
    for (std::string const& out : o.outputs) {
        if (extension_of(out) != ".ply")
            refuse_option(fmt::format("-o {}: photons are written as .ply files; choose such a name", out));
        check_target("-o", out);
        files.push_back({"-o", out, FileRole::Output});
    }
    files.push_back({"the scene", o.scene, FileRole::Input});
    for (std::string const& f : scene.files)
        if (f != o.scene) files.push_back({"the scene's", f, FileRole::Input});
    for (ImageFile const& image : scene.images) files.push_back({"the picture", image.path, FileRole::Input});
    check_conflicts(files);
}

Settings settings_of_photons(PhotonsOptions const& o, Scene const& scene) {
    Settings asked = scene.settings;
    // --set may speak of photons where the scene does not: its integrator comes first.
    SettingOptions options = o;
    bool const shoots = match(asked.integrator, [](auto const& i) {
        return requires { i.shooting; };
    });
    if (!shoots && options.integrator.empty()) options.integrator = "photonmap";
    if (!options.integrator.empty() && options.integrator != "photonmap" && options.integrator != "sppm")
        refuse_option(fmt::format("--integrator {}: shoots no photons into maps; choose photonmap or sppm",
                                  options.integrator));
    Settings s = photon_settings(settings_of(options, scene));
    if (o.count)
        match(s.integrator, [&](auto& i) {
            if constexpr (requires { i.shooting; })
                i.shooting.global_paths = i.shooting.caustic_paths = *o.count;
        });
    return s;
}

char const* map_name(ShotKind kind) { return kind == ShotKind::Caustic ? "caustic" : "global"; }

/// Every path of the pass is traced again, one by one: few files are worth more.
void write_photons(RenderJob const& job, PhotonsOptions const& o, std::string const& file) {
    PhotonCloud cloud;
    Wavelengths const lambda = job.pass_wavelengths(o.pass);
    for (ShotKind const kind : shots_of(shown_map(o.map))) {
        std::size_t const before = cloud.size();
        std::uint64_t const paths = paths_of_pass(job, kind);
        for (std::uint64_t i = 0; i < paths; ++i)
            for (PhotonRecord photon : trace_light_path(job, kind, o.pass, i, paths).photons) {
                photon.light = source_index(job.world(), photon.light);
                cloud.add(photon, lambda, kind);
            }
        if (!o.quiet) say("{} map: {} paths, {} photons\n", map_name(kind), paths, cloud.size() - before);
    }
    if (cloud.size() == 0)
        say("nephroid: warning: there are no photons: {}\n",
            job.world().counts().lights == 0 ? "the scene has no lights" : "nothing that takes them was met");
    cloud.write(file);
    print_written(file);
}

void write_paths(RenderJob const& job, PhotonsOptions const& o, std::string const& file) {
    PathLines lines;
    for (ShotKind const kind : shots_of(shown_map(o.map))) {
        std::uint64_t const paths = paths_of_pass(job, kind);
        std::uint64_t const shown = std::min(paths, static_cast<std::uint64_t>(*o.paths));
        for (std::uint64_t i = 0; i < shown; ++i) lines.add(trace_light_path(job, kind, o.pass, i, paths));
        if (!o.quiet) say("{} map: {} paths of {}\n", map_name(kind), shown, paths);
    }
    lines.write(file);
    print_written(file);
}

}  // namespace

int run(PhotonsOptions const& o) {
    catch_signals();
    std::optional<std::uint64_t> const memory_limit =
        o.memory_limit.empty() ? std::nullopt : std::optional(parse_bytes("--memory-limit", o.memory_limit));
    Scene scene = read_scene(o.scene);
    Settings const settings = settings_of_photons(o, scene);
    check_files(o, scene);
    MemoryNeed need = memory_need(scene, {0, 0, 0, 0}, false);
    if (!o.paths || o.outputs.size() > 1) need.photons = photon_need(settings);
    check_memory(need, memory_limit);
    scene.settings = settings;
    World const world = compile(std::move(scene));
    RenderJob const job(world, settings);
    if (need.photons > 0) check_memory(refined(need, job), memory_limit);
    if (!o.paths) {
        write_photons(job, o, o.outputs.front());
    } else {
        if (o.outputs.size() > 1) write_photons(job, o, o.outputs.front());
        write_paths(job, o, o.outputs.back());
    }
    return kGood;
}

}  // namespace nephroid::cli
