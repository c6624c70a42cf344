#include "renderers.h"
#include "yardsticks.h"

#include "image/read.h"
#include "math/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace nephroid::peers {

namespace {

namespace fs = std::filesystem;

std::string quoted(std::string const& s) {
    std::string t = "'";
    for (char const c : s) t += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return t + "'";
}
std::string contents(fs::path const& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}
struct Finished {
    double seconds = 0;
    std::string said;
};
/// In `folder`; what it says goes to a file there. Throws Error(Io) with its last words when it fails.
Finished start(std::string const& command, fs::path const& folder) {
    fs::path const log = folder / "said.txt";
    // An earlier picture must not be taken for the one of a program that writes none.
    fs::remove(folder / "out.exr");
    auto const begin = std::chrono::steady_clock::now();
    int const code = std::system(
        fmt::format("cd {} && {} >{} 2>&1 </dev/null", quoted(folder.string()), command, quoted(log.string()))
            .c_str());
    Finished f{std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
               contents(log)};
    if (code != 0) {
        std::string const end = f.said.size() > 600 ? f.said.substr(f.said.size() - 600) : f.said;
        throw Error(ErrorKind::Io, fmt::format("failed: {}\n{}", command, end));
    }
    return f;
}
/// What a command says at once, or nothing where it cannot be run. Its words count, not its exit code.
std::string answer(std::string const& command) {
    std::string text;
    if (FILE* pipe = popen((command + " 2>&1 </dev/null").c_str(), "r")) {
        char buffer[256];
        while (std::fgets(buffer, sizeof buffer, pipe)) text += buffer;
        pclose(pipe);
    }
    return text;
}
std::string first_line(std::string const& text) { return text.substr(0, text.find('\n')); }
/// The rest of the line after `mark`, where that is said last.
std::string after(std::string const& text, std::string const& mark) {
    auto const at = text.rfind(mark);
    if (at == std::string::npos) return "";
    auto const from = at + mark.size();
    return text.substr(from, text.find('\n', from) - from);
}
double number_after(std::string const& text, std::string const& mark, double otherwise) {
    std::string const rest = after(text, mark);
    return rest.empty() ? otherwise : std::strtod(rest.c_str(), nullptr);
}
bool runs(std::string const& program) {
    return !program.empty() &&
           std::system(("command -v " + quoted(program) + " >/dev/null 2>&1").c_str()) == 0;
}

Renderer ours(Programs const& p, std::string key, std::string name, std::string options, bool path_tracer,
              std::string yardstick = "") {
    auto prepare = [p, options, yardstick](PeerScene const& peer, fs::path const& folder) -> RenderFunction {
        fs::path const scene = write_pbrt_scene(peer, {folder, 16, 1});
        return [=](RenderJob const& job) {
            auto const f = start(fmt::format("{} render {} --quiet --float --stats stats.json -o out.exr "
                                             "--spp {} --seed {} --threads {} {} {}",
                                             quoted(p.nephroid), quoted(scene.string()), job.samples,
                                             job.seed, p.threads, options, job.yardstick ? yardstick : ""),
                                 folder);
            auto const seconds = nlohmann::json::parse(contents(folder / "stats.json"))["seconds"];
            // With its trees, as those of Cycles are in what that says.
            return Rendered{read_image(folder / "out.exr"),
                            seconds["compile"].get<double>() + seconds["render"].get<double>(), f.seconds};
        };
    };
    return {std::move(key), std::move(name), first_line(answer(quoted(p.nephroid) + " --version")),
            path_tracer, prepare};
}

Renderer cycles(Programs const& p) {
    auto prepare = [p](PeerScene const& peer, fs::path const& folder) -> RenderFunction {
        fs::path const scene = write_cycles(peer, folder);
        return [=](RenderJob const& job) {
            fs::path const out = folder / "out.exr";
            auto const f =
                start(fmt::format("{} -b -noaudio --debug-cycles --verbose 1 -P {} -- {} {} {} {} {}",
                                  quoted(p.blender), quoted(p.cycles_script.string()), quoted(scene.string()),
                                  job.samples, job.seed, p.threads, quoted(out.string())),
                      folder);
            double const call = number_after(f.said, "RENDER_SECONDS ", 0);
            if (!(call > 0))
                throw Error(ErrorKind::Io, "Blender did not render: " + folder.string() + "/said.txt");
            return Rendered{read_image(out), call, f.seconds};
        };
    };
    return {"cycles", kCycles, first_line(answer(quoted(p.blender) + " --version")), true, prepare};
}

/// Samples of a pixel are what its quality is multiplied by here.
Renderer povray(Programs const& p) {
    auto prepare = [p](PeerScene const& peer, fs::path const& folder) -> RenderFunction {
        return [=](RenderJob const& job) {
            fs::path const scene = write_povray(peer, folder, job.samples);
            auto const f = start(
                fmt::format(
                    "{} +I{} +Oout.exr +FE +W{} +H{} -D +WT{} +A0.1 +AM1 +R2 Display=off File_Gamma=1.0",
                    quoted(p.povray), quoted(scene.filename().string()), peer.resolution.x, peer.resolution.y,
                    p.threads),
                folder);
            return Rendered{read_image(folder / "out.exr"), f.seconds, f.seconds};
        };
    };
    // Without a file of settings it says that first.
    std::string const said = answer(quoted(p.povray) + " --version");
    auto const at = said.find("POV-Ray ");
    std::string const version = at == std::string::npos ? "" : first_line(said.substr(at));
    return {"povray", kPovray, version, false, prepare};
}

/// A path tracer whose program the user names: `write` makes its scene for a render, `options` are what its program is called
/// with before that, and `picture` is what it leaves. None says what the render alone took.
Renderer given(char const* key, char const* name, std::string const& program,
               fs::path (*write)(PeerScene const&, WriteJob const&),
               std::function<std::string(RenderJob const&)> const& options, char const* picture) {
    auto prepare = [=](PeerScene const& peer, fs::path const& folder) -> RenderFunction {
        return [=](RenderJob const& job) {
            fs::path const scene = write(peer, {folder, job.samples, job.seed});
            auto const f =
                start(fmt::format("{} {} {}", quoted(program), options(job), quoted(scene.string())), folder);
            return Rendered{read_image(folder / picture), f.seconds, f.seconds};
        };
    };
    return {key, name, fmt::format("as given by --{}", key), true, prepare};
}
Renderer pbrt(Programs const& p) {
    return given(
        "pbrt", "pbrt-v4", p.pbrt, write_pbrt_scene,
        [n = p.threads](RenderJob const& job) {
            return fmt::format("--nthreads {} --seed {} --outfile out.exr", n, job.seed);
        },
        "out.exr");
}
Renderer mitsuba(Programs const& p) {
    return given(
        "mitsuba", "Mitsuba 3 llvm", p.mitsuba, write_mitsuba,
        [n = p.threads](RenderJob const&) { return fmt::format("-m llvm_ad_rgb -t {} -o out.exr", n); },
        "out.exr");
}
Renderer tungsten(Programs const& p) {
    return given(
        "tungsten", "Tungsten", p.tungsten, write_tungsten,
        [n = p.threads](RenderJob const& job) { return fmt::format("-t {} -s {}", n, job.seed); }, "out.pfm");
}

}  // namespace

std::vector<Renderer> find_renderers(Programs const& p) {
    std::vector<Renderer> found{
        ours(p, "nephroid", kPath, "--integrator path --color rgb", true),
        ours(p, "nephroid-spectral", kSpectral, "--integrator path --color spectral", true),
        ours(p, "nephroid-sppm", kSppm, "--integrator sppm --color rgb", false, kSppmYardstick)};
    auto const add = [&](char const* name, std::string const& program, Renderer (*make)(Programs const&),
                         bool asked) {
        if (runs(program))
            found.push_back(make(p));
        else if (asked)
            std::fprintf(stderr, "peers: %s is left out: there is no program \"%s\"\n", name,
                         program.c_str());
        else
            std::fprintf(stderr, "peers: %s is left out: say where it is with --%s PATH\n", name, name);
    };
    add("blender", p.blender, cycles, true);
    add("povray", p.povray, povray, true);
    add("pbrt", p.pbrt, pbrt, !p.pbrt.empty());
    add("mitsuba", p.mitsuba, mitsuba, !p.mitsuba.empty());
    add("tungsten", p.tungsten, tungsten, !p.tungsten.empty());
    return found;
}

}  // namespace nephroid::peers
