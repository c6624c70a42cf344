// nephroid: the command line.
#include "commands.h"
#include "console.h"
#include "math/error.h"
#include "overrides.h"
#include "words.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <new>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace nephroid::cli {
namespace {

constexpr std::uint64_t kLargestInt = std::numeric_limits<int>::max();

/// Whole numbers from `least` to `most`; what is wrong is said in words.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
    return {[least, most](std::string& text) {
                std::uint64_t v = 0;
                auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
                bool const good =
                    r.ec == std::errc{} && r.ptr == text.data() + text.size() && v >= least && v <= most;
                return good ? std::string()
                            : fmt::format("\"{}\" is not a whole number from {} to {}", text, least, most);
            },
            "", "WHOLE"};
}
CLI::Validator finite_number(bool positive) {
    return {[positive](std::string& text) {
                double v = 0;
                auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
                bool const good = r.ec == std::errc{} && r.ptr == text.data() + text.size() &&
                                  std::isfinite(v) && (!positive || v > 0);
                return good ? std::string()
                            : fmt::format("\"{}\" is not a number{}", text, positive ? " above 0" : "");
            },
            "", "NUMBER"};
}

void declare_settings(CLI::App& app, SettingOptions& o, char const* integrators) {
    app.add_option("--integrator", o.integrator, integrators);
    app.add_option("--set", o.sets, "key=value: any setting of the scene; see below")
        ->allow_extra_args(false);
    app.add_option("--size", o.size, "WxH, resolution in pixels");
    app.add_option("--color", o.color, "rgb or spectral")->check(CLI::IsMember({"rgb", "spectral"}));
    app.add_option("--seed", o.seed, "seed of all random numbers")
        ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
    app.footer("Settings for --set:\n" + override_help());
}

constexpr char const* kIntegrators =
    "path (the yardstick; caustics take long), photonmap (caustics and indirect light from photons: soon "
    "smooth, a "
    "little blurred), sppm (photons pass by pass, right in the end: caustics seen in mirrors and through "
    "glass), "
    "lightpath (from the lights to the camera: caustics on diffuse surfaces; sees nothing in mirrors or "
    "through glass), "
    "whitted, direct";

void declare_overlay(CLI::App& app, OverlayOptions& o) {
    app.add_flag(
           "--show-photons{10000}", o.photons,
           "draw photons over the pictures: --show-photons=N so many, with 20 paths and 200 normals unless "
           "they are counted")
        ->check(whole_number(0, kLargestInt));
    app.add_option("--show-paths", o.paths, "draw so many photon paths (white)")
        ->check(whole_number(0, kLargestInt));
    app.add_option("--show-normals", o.normals, "draw the surface's normals at so many photons (green)")
        ->check(whole_number(0, kLargestInt));
    app.add_option("--show-map", o.map, "whose photons and paths: global, caustic or both")
        ->check(CLI::IsMember({"global", "caustic", "both"}));
    app.add_flag("--show-hidden", o.hidden, "draw also what lies behind surfaces");
}

CLI::App const* declare(CLI::App& app, RenderOptions& o) {
    app.add_option("scene", o.scene, "scene file")->required();
    app.add_option("-o,--output", o.outputs,
                   "picture to write, once or more: .exr .png .jpg .pfm .hdr, or .film.exr for the film "
                   "itself (mergeable)")
        ->allow_extra_args(false);
    app.add_option("--spp", o.spp,
                   "samples per pixel, that is, passes; with photonmap they are shared out among its passes")
        ->check(whole_number(1, kLargestInt));
    app.add_option("--time", o.time, "stop after this long: 90s, 5m, 2h");
    declare_settings(app, o, kIntegrators);
    app.add_option("--crop", o.crop, "x0,y0,x1,y1: render only these pixels");
    app.add_option("--threads", o.threads, "worker threads; the picture does not depend on it")
        ->check(CLI::Range(1, 1024));
    app.add_option("--passes", o.passes, "A:B, render passes A to B-1 only");
    app.add_option("--checkpoint", o.checkpoint, "write the film here now and then, and at the end");
    app.add_option("--checkpoint-every", o.checkpoint_every, "seconds between checkpoints")
        ->check(finite_number(true));
    app.add_option("--resume", o.resume, "go on from this checkpoint (or film)");
    app.add_option("--exposure", o.exposure, "stops, for 8-bit pictures")->check(finite_number(false));
    app.add_flag("--aovs", o.aovs,
                 "layers in EXR files: albedo, normals, position, depth, material of the first hit; "
                 "direct, caustic, indirect and specular light; radius and number of photons");
    app.add_flag("--float", o.full_float, "EXR channels as 32-bit floats");
    app.add_flag("--quiet", o.quiet, "print errors and results only");
    app.add_option("--log", o.log, "json: progress and statistics as JSON lines on stderr")
        ->check(CLI::IsMember({"json", "text"}));
    app.add_option("--memory-limit", o.memory_limit,
                   "refuse to begin what needs more memory: 8G, 500M; default: what the machine has left");
    app.add_option("--stats", o.stats, "write statistics as JSON to this file");
    declare_overlay(app, o.overlay);
    app.add_option(
        "--replay", o.replay,
        "pass,x,y: print the path of that pixel's sample of that pass, vertex by vertex; with -o path.svg "
        "drawn from the side and from above, with -o path.json for programs, and over pictures, which are "
        "then rendered too");
    return &app;
}

CLI::App const* declare(CLI::App& app, InfoOptions& o) {
    app.add_option("scene", o.scene, "scene file")->required();
    app.add_flag("--json", o.json, "print JSON");
    return &app;
}

CLI::App const* declare(CLI::App& app, MergeOptions& o) {
    app.add_option("films", o.films, "films (.film.exr) of disjoint passes of the same render")->required();
    app.add_option("-o,--output", o.outputs, "picture or film to write, once or more")
        ->allow_extra_args(false)
        ->required();
    app.add_option("--exposure", o.exposure, "stops, for 8-bit pictures")->check(finite_number(false));
    app.add_flag("--float", o.full_float, "EXR channels as 32-bit floats");
    return &app;
}

CLI::App const* declare(CLI::App& app, PhotonsOptions& o) {
    app.add_option("scene", o.scene, "scene file")->required();
    app.add_option("-o,--output", o.outputs, ".ply file; a second one for --paths")
        ->allow_extra_args(false)
        ->required();
    app.add_option("--map", o.map, "whose photons: global, caustic or both")
        ->check(CLI::IsMember({"global", "caustic", "both"}));
    app.add_option(
           "--count", o.count,
           "photon paths to shoot into each map, instead of as many as a render would: what is emitted, "
           "of which some is stored, once or more")
        ->check(whole_number(0, kLargestInt));
    app.add_option("--paths", o.paths,
                   "write the first so many paths of each map, as edges (with one -o: instead)")
        ->check(whole_number(0, kLargestInt));
    app.add_option("--pass", o.pass, "whose photons: those of this pass, from 0 on")
        ->check(whole_number(0, std::uint64_t{1} << 62));
    declare_settings(app, o, "photonmap or sppm; a scene with another one is shot with photonmap's defaults");
    app.add_option("--memory-limit", o.memory_limit, "refuse to begin what needs more memory: 8G, 500M");
    app.add_flag("--quiet", o.quiet, "print errors and results only");
    return &app;
}

CLI::App const* declare(CLI::App& app, ConvertOptions& o) {
    app.add_option("scene", o.scene, "scene file")->required();
    app.add_option("output", o.output,
                   "the .pbrt file to write; large meshes and measured lamps go into a folder beside it, "
                   "pictures stay where they are")
        ->required();
    app.add_flag("--portable", o.portable,
                 "only what pbrt-v4 itself knows: what is nephroid's own is replaced by the nearest thing, "
                 "and each "
                 "replacement is said. Without it nothing is lost: the file renders to the same bits");
    declare_settings(app, o, kIntegrators);
    app.add_option("--spp", o.spp, "samples per pixel")->check(whole_number(1, kLargestInt));
    app.add_option("--crop", o.crop, "x0,y0,x1,y1: render only these pixels");
    app.add_flag("--aovs", o.aovs, "record layers (Film \"gbuffer\")");
    app.add_flag("--quiet", o.quiet, "print errors and replacements only");
    return &app;
}

CLI::App const* declare(CLI::App& app, CompareOptions& o) {
    app.add_option("a", o.a, "picture")->required();
    app.add_option("b", o.b, "picture to compare with: the reference")->required();
    app.add_option("--bins", o.bins, "side of the blocks for the binned error")
        ->check(whole_number(1, kLargestInt));
    app.add_flag("--json", o.json, "print JSON");
    return &app;
}

/// Runs f; what it throws is said, and becomes an exit code.
int guarded(std::function<int()> const& f) {
    try {
        return f();
    } catch (Error const& e) {
        say("nephroid: {}\n", e.what());
        switch (e.kind()) {
            case ErrorKind::Input:
                return kBadInput;
            case ErrorKind::Limit:
                return kLimit;
            case ErrorKind::Io:
                return kIo;
        }
    } catch (std::bad_alloc const&) {
        say("nephroid: out of memory\n");
        return kLimit;
    } catch (std::exception const& e) {
        say("nephroid: internal error: {}\n", e.what());
    }
    return kInternal;
}

}  // namespace
}  // namespace nephroid::cli

int main(int argc, char** argv) {
    using namespace nephroid;
    using namespace nephroid::cli;
    prepare_streams();
    CLI::App app{
        "nephroid: a physically based renderer whose passes are reproducible to the bit.\n"
        "A render is a sum of independent passes; films of different passes merge into one."};
    app.set_version_flag("--version", "nephroid 0.1.0");
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  nephroid render scene.pbrt -o picture.exr -o picture.png --spp 256\n"
        "  nephroid render scene.pbrt --passes 0:64 -o a.film.exr    # one machine …\n"
        "  nephroid render scene.pbrt --passes 64:128 -o b.film.exr  # … and another\n"
        "  nephroid merge a.film.exr b.film.exr -o picture.exr\n"
        "  nephroid info scene.pbrt\n"
        "  nephroid compare a.exr b.exr\n"
        "  nephroid render scene.pbrt --integrator sppm --spp 64     # caustics by photons\n"
        "  nephroid photons scene.pbrt -o photons.ply                # to look at\n"
        "  nephroid convert scene.pbrt other.pbrt --portable         # to ask another renderer\n"
        "  nephroid render scene.pbrt --replay 7,120,80 -o path.svg  # what pass 7 did in pixel 120,80\n"
        "Exit codes: 0 good, 1 internal error, 2 bad input or usage, 3 a limit was hit, 4 I/O, 5 interrupted "
        "but resumable,\n"
        "6 finished but samples that were not finite had to be dropped.");

    std::vector<std::pair<CLI::App const*, std::function<int()>>> commands;
    RenderOptions render;
    InfoOptions info;
    MergeOptions merge;
    CompareOptions compare;
    PhotonsOptions photons;
    ConvertOptions convert;
    commands.emplace_back(
        declare(*app.add_subcommand("render", "render a scene (.pbrt, .ray, .ply, .obj; also .gz)"), render),
        [&] { return run(render); });
    commands.emplace_back(
        declare(
            *app.add_subcommand(
                "info",
                "say what is in a scene, and everything that was approximated or ignored, with file:line"),
            info),
        [&] { return run(info); });
    commands.emplace_back(
        declare(*app.add_subcommand("merge", "add up films of disjoint passes of the same render"), merge),
        [&] { return run(merge); });
    commands.emplace_back(
        declare(*app.add_subcommand("compare", "say how far apart two pictures are"), compare),
        [&] { return run(compare); });
    commands.emplace_back(
        declare(*app.add_subcommand("photons", "write the photons of a pass, or their paths, as PLY files"),
                photons),
        [&] { return run(photons); });

    commands.emplace_back(
        declare(*app.add_subcommand("convert", "write a scene, of any kind that is read, as a pbrt-v4 file"),
                convert),
        [&] { return run(convert); });

    std::vector<std::string> const names{"render", "info", "merge", "compare", "photons", "convert"};
    if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end()) {
        say("nephroid: \"{}\" is no command; did you mean \"{}\"? (nephroid --help lists them)\n", argv[1],
            nearest(argv[1], names));
        return kBadInput;
    }
    int code = kGood;
    try {
        app.parse(argc, argv);
        for (auto const& [sub, command] : commands)
            if (sub->parsed()) code = guarded(command);
    } catch (CLI::ParseError const& e) {
        std::ostringstream out, err;
        code = app.exit(e, out, err) == 0 ? kGood : kBadInput;
        print_text(out.str());
        say_text(err.str());
    }
    // Lost results are an error even where everything else went well.
    int const flushed = guarded([] { return flush_results(), int{kGood}; });
    return flushed == kGood ? code : flushed;
}
