// Measures nephroid beside other renderers, and writes the page that says so: ./dev peers.
#include "measure_peers.h"
#include "peers_page.h"
#include "scenes.h"

#include "image/write.h"
#include "math/error.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <thread>

namespace nephroid::peers {

namespace {

struct BenchScene {
    char const* name;
    char const* file;  // below the repository; nothing: made here
    Vec2i size;        // 0: as the file says
    bool sppm;
    bool equal_samples;
    bool povray = true;
};
BenchScene const kScenes[] = {
    {"cornell", "bench/peers/scenes/cornell.pbrt", {0, 0}, false, true},
    {"cornell_glass", "bench/peers/scenes/cornell_glass.pbrt", {0, 0}, true, true},
    // POV-Ray finds no sun in a picture of a sky but by chance, and asks each of 320 lamps everywhere: it is no peer there.
    {"ball", nullptr, {0, 0}, false, false, false},
    {"many_lights", "bench/peers/scenes/many_lights.pbrt", {0, 0}, false, false, false},
    {"pool", "scenes/pool.pbrt", {320, 240}, true, false},
    {"cup", "scenes/cup.pbrt", {320, 240}, true, false},
    {"interior", "bench/peers/scenes/interior.pbrt", {0, 0}, false, false},
};

PeerScene read_bench_scene(BenchScene const& s, Vec2i size) {
    Scene scene = s.file ? read_scene(std::filesystem::path(NEPHROID_SOURCE_DIR) / s.file)
                         : bench::bumpy_ball_under_sky(512);
    if (!s.file) scene.lights.front().to_world = {};  // that sky lies on its side; here it is above
    // What was ignored in a scene of ours would be missing in everybody's.
    if (!scene.notes.empty()) throw Error(ErrorKind::Input, scene.notes.front().text);
    if (size == Vec2i{0}) size = s.size;
    if (size.x > 0) scene.settings.film.resolution = size;
    return make_peer_scene(std::move(scene));
}

bool chosen(std::vector<std::string> const& list, std::string const& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}
void check_names(char const* option, std::vector<std::string> const& asked,
                 std::vector<std::string> const& known) {
    for (std::string const& a : asked)
        if (std::find(known.begin(), known.end(), a) == known.end()) {
            std::string all;
            for (std::string const& k : known) all += (all.empty() ? "" : ", ") + k;
            throw Error(ErrorKind::Input,
                        std::string(option) + " " + a + ": there is none of that name; there are " + all);
        }
}

int run(int argc, char** argv) {
    CLI::App app{
        "Renders the same scenes with nephroid and with the renderers that are installed, and writes a page "
        "with times, errors\n"
        "against each renderer's own reference, efficiencies, targets, pictures side by side, and plots. All "
        "scenes take about\n"
        "half an hour on two cores; nothing else should run then, or the times mean nothing (the page tells "
        "the load)."};
    app.footer(
        "Scenes: cornell, cornell_glass (the yardsticks: 64 samples of a pixel are timed too), ball (2 M "
        "triangles under a\n"
        "picture of a sky), many_lights (320), pool and cup (caustics), interior (textures).\n"
        "Renderers: nephroid (path, rgb), nephroid-spectral, nephroid-sppm, cycles, povray, pbrt, mitsuba, "
        "tungsten.\n"
        "Examples:\n"
        "  peers --quick /tmp/page                                  # does it work here?\n"
        "  peers --scenes cornell --renderers nephroid,cycles /tmp/page\n"
        "  peers --pbrt ~/pbrt-v4/build/pbrt --threads 8            # one more, which is not packaged\n"
        "  peers --scenes cup --keep /tmp/cup /tmp/page             # what each renderer was given, and "
        "said\n"
        "The exit code is 0 when everything was rendered; 1 when a renderer failed, or when a path tracer's "
        "mean is more than 5%\n"
        "from ours, which is another picture. A target that is not met is no error: the page says so.");
    Programs programs;
    programs.nephroid = NEPHROID_PROGRAM;
    programs.cycles_script = std::filesystem::path(NEPHROID_SOURCE_DIR) / "bench/peers/cycles.py";
    programs.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    Plan plan;
    std::vector<std::string> scenes, only;
    bool quick = false;
    Vec2i size{0};
    std::string size_text;
    std::string folder = std::string(NEPHROID_SOURCE_DIR) + "/docs/performance", keep;
    app.add_option("--blender", programs.blender, "Blender, for Cycles (default: blender)");
    app.add_option("--povray", programs.povray, "POV-Ray (default: povray)");
    app.add_option("--pbrt", programs.pbrt, "a pbrt-v4 binary; its scenes are tested, its runs are not");
    app.add_option("--mitsuba", programs.mitsuba,
                   "a Mitsuba 3 binary; its scenes are tested, its runs are not");
    app.add_option("--tungsten", programs.tungsten,
                   "a Tungsten binary; its scenes are tested, its runs are not");
    app.add_option("--threads", programs.threads, "threads of each (default: all)")
        ->check(CLI::Range(1, 1024));
    auto* seconds = app.add_option("--seconds", plan.seconds, "that a measured render takes (default 4)")
                        ->check(CLI::PositiveNumber);
    auto* repetitions =
        app.add_option("--repetitions", plan.repetitions, "rounds (default 5)")->check(CLI::Range(1, 1000));
    app.add_option("--scenes", scenes, "only these, by commas")->delimiter(',')->allow_extra_args(false);
    app.add_option("--renderers", only, "only these, by commas")->delimiter(',')->allow_extra_args(false);
    app.add_option("--size", size_text, "WxH of every picture, for a try; nothing is bridged then");
    app.add_flag("--quick", quick, "1 second, 3 rounds, small references: some minutes");
    app.add_option("--keep", keep, "work in this folder, and leave scenes, pictures and logs there");
    app.add_option("folder", folder, "where peers.md goes (default: docs/performance)");
    CLI11_PARSE(app, argc, argv);
    if (quick) {
        if (seconds->empty()) plan.seconds = 1;
        if (repetitions->empty()) plan.repetitions = 3;
        plan.reference = 6;
    }
    if (!size_text.empty()) {
        char end = 0;
        if (std::sscanf(size_text.c_str(), "%dx%d%c", &size.x, &size.y, &end) != 2 || size.x < 2 ||
            size.y < 2 || size.x > 10000 || size.y > 10000)
            throw Error(ErrorKind::Input,
                        "--size " + size_text + ": give it as 160x120, from 2 to 10000 each");
    }
    std::vector<std::string> known;
    for (BenchScene const& s : kScenes) known.emplace_back(s.name);
    check_names("--scenes", scenes, known);
    check_names("--renderers", only,
                {"nephroid", "nephroid-spectral", "nephroid-sppm", "cycles", "povray", "pbrt", "mitsuba",
                 "tungsten"});

    std::vector<Renderer> renderers = find_renderers(programs);
    std::erase_if(renderers, [&](Renderer const& r) { return !chosen(only, r.key); });
    std::filesystem::path const scratch =
        keep.empty() ? std::filesystem::temp_directory_path() / ("nephroid-peers-" + std::to_string(getpid()))
                     : std::filesystem::absolute(keep);
    std::vector<SceneResult> results;
    for (BenchScene const& s : kScenes) {
        if (!chosen(scenes, s.name)) continue;
        std::vector<Renderer const*> fit;
        for (Renderer const& r : renderers) {
            if (r.key == "nephroid-sppm" && !s.sppm) continue;
            if (r.key == "povray" && !s.povray) continue;
            if (r.key == "nephroid-spectral" && !s.equal_samples) continue;
            fit.push_back(&r);
        }
        results.push_back(
            measure_scene(s.name, read_bench_scene(s, size), fit, plan, s.equal_samples, scratch));
        write_peers_page(folder, results, renderers, plan, programs.threads, quick);  // what is done is done
    }
    if (keep.empty()) std::filesystem::remove_all(scratch);
    std::fprintf(stderr, "peers: the page is %s/peers.md\n", folder.c_str());
    auto const wrong = complaints(results);
    for (std::string const& c : wrong) std::fprintf(stderr, "peers: %s\n", c.c_str());
    return wrong.empty() ? 0 : 1;
}

}  // namespace

}  // namespace nephroid::peers

int main(int argc, char** argv) {
    try {
        return nephroid::peers::run(argc, argv);
    } catch (std::exception const& e) {
        std::fprintf(stderr, "peers: %s\n", e.what());
        return 1;
    }
}
