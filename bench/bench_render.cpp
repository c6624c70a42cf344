// Whole renders on one thread, beside the time that Embree alone needs for the very rays they traced: the floor.
//
// The rays of some passes are recorded once. Then, in turn, the passes are rendered and the recorded rays are traced with
// single-ray calls and nothing else; the share floor / render is the part of the time that no better code around Embree can
// save. Runs alternate, so that both see the same machine; medians are reported. docs/performance.md says how to read it.
#include "film/film.h"
#include "read/read.h"
#include "scenes.h"
#include "timing.h"
#include "transport/render_pass.h"
#include "world/floor.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace nephroid {

using bench::median;
using bench::seconds_of;

namespace {

struct Options {
    int repetitions = 7;
    int passes = 4;
    int pixels = 40000;  // about; the pictures keep their aspect
    std::string only;
    std::string color;
    bool floor = true;
    bool json = false;
};

struct Figures {
    std::string name;
    ColorMode color = ColorMode::Rgb;
    std::uint64_t triangles = 0, paths = 0;
    RayStats rays;
    double render = 0, floor = 0, share = 0;  // medians: seconds, seconds, ratio of one repetition's two
    double share_low = 0, share_high = 0;     // least and greatest of the repetitions
};

// ---- measuring ------------------------------------------------------------------------------------------------------------

/// The passes, tile by tile as the pass loop goes, on this thread.
void sweep(RenderJob const& job, int passes, Film& film, RayStats& stats) {
    constexpr int kTile = 16;
    auto const [x0, x1, y0, y1] = job.crop();
    PassWork const none;
    TileRenderer renderer(job, none, film, stats);
    for (int y = y0; y < y1; y += kTile)
        for (int x = x0; x < x1; x += kTile)
            for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(passes); ++i)
                renderer.add({x, std::min(x + kTile, x1), y, std::min(y + kTile, y1)}, {i, i + 1});
}

Figures measure(std::string const& name, World const& world, ColorMode color, Options const& o) {
    Settings settings = world.scene().settings;
    settings.color = color;
    settings.film.aovs = false;
    Vec2i const full = settings.film.resolution;
    double const shrink = std::sqrt(static_cast<double>(o.pixels) / (static_cast<double>(full.x) * full.y));
    settings.film.resolution = {std::max(1, static_cast<int>(full.x * shrink)),
                                std::max(1, static_cast<int>(full.y * shrink))};
    settings.film.crop.reset();
    RenderJob const job(world, settings);

    Figures f{.name = name, .color = color, .triangles = world.counts().triangles};
    Film film = job.make_film();
    std::vector<RecordedRay> rays;
    if (o.floor) f.rays.recorder = &rays;
    sweep(job, o.passes, film, f.rays);
    f.rays.recorder = nullptr;
    f.paths = static_cast<std::uint64_t>(film.width()) * static_cast<std::uint64_t>(film.height()) *
              static_cast<std::uint64_t>(o.passes);

    std::vector<double> render;
    std::vector<double> floor;
    std::vector<double> share;
    TraceSums sums = trace_only(world, rays);
    for (int i = 0; i < o.repetitions; ++i) {
        film = job.make_film();
        RayStats stats;
        render.push_back(seconds_of([&] { sweep(job, o.passes, film, stats); }));
        floor.push_back(seconds_of([&] { sums = trace_only(world, rays); }));
        share.push_back(floor.back() / render.back());
        if (o.floor && sums.nearest_hits != stats.hits)
            std::cerr << name << ": the recorded rays are not those of the render\n";
    }
    f.render = median(render);
    f.floor = median(floor);
    f.share = median(share);
    f.share_low = *std::min_element(share.begin(), share.end());
    f.share_high = *std::max_element(share.begin(), share.end());
    return f;
}

// ---- telling --------------------------------------------------------------------------------------------------------------

char const* word(ColorMode c) { return c == ColorMode::Rgb ? "rgb" : "spectral"; }

void head() {
    std::printf("%-16s %-8s %10s %8s %8s %23s %8s %8s %9s %9s %7s  %s\n", "scene", "color", "triangles",
                "paths", "rays", "camera+bounce+shadow", "ns/path", "floor", "ns/ray", "floor", "share",
                "range");
}
void print(Figures const& f) {
    auto const paths = static_cast<double>(f.paths);
    double rays = 0;
    for (auto n : f.rays.rays) rays += static_cast<double>(n);
    std::printf(
        "%-16s %-8s %10llu %8llu %8.2f %9.2f + %4.2f + %4.2f %8.0f %8.0f %9.1f %9.1f %6.1f%%  %.1f to "
        "%.1f%%\n",
        f.name.c_str(), word(f.color), static_cast<unsigned long long>(f.triangles),
        static_cast<unsigned long long>(f.paths), rays / paths, static_cast<double>(f.rays.rays[0]) / paths,
        static_cast<double>(f.rays.rays[1]) / paths, static_cast<double>(f.rays.rays[2]) / paths,
        1e9 * f.render / paths, 1e9 * f.floor / paths, 1e9 * f.render / rays, 1e9 * f.floor / rays,
        100 * f.share, 100 * f.share_low, 100 * f.share_high);
    std::fflush(stdout);
}
nlohmann::json to_json(Figures const& f) {
    auto const paths = static_cast<double>(f.paths);
    return {{"scene", f.name},
            {"color", word(f.color)},
            {"triangles", f.triangles},
            {"paths", f.paths},
            {"rays", {{"camera", f.rays.rays[0]}, {"bounce", f.rays.rays[1]}, {"shadow", f.rays.rays[2]}}},
            {"render_seconds", f.render},
            {"floor_seconds", f.floor},
            {"ns_per_path", 1e9 * f.render / paths},
            {"floor_ns_per_path", 1e9 * f.floor / paths},
            {"floor_share", f.share},
            {"floor_share_range", {f.share_low, f.share_high}}};
}

struct Case {
    std::string name;
    std::function<Scene()> scene;
    std::vector<ColorMode> colors;
};

int run(Options const& o) {
    auto const file = [&](char const* name) {
        return [name] { return read_scene(bench::scene_file(name)); };
    };
    std::vector<Case> const cases = {
        {"cornell-box", file("cornell-box.pbrt"), {ColorMode::Rgb, ColorMode::Spectral}},
        {"cornell-spheres", file("cornell-spheres.pbrt"), {ColorMode::Rgb, ColorMode::Spectral}},
        {"shapes", file("shapes.pbrt"), {ColorMode::Spectral}},
        {"million", [] { return bench::bumpy_ball_under_sky(512); }, {ColorMode::Rgb, ColorMode::Spectral}},
    };
    nlohmann::json all = nlohmann::json::array();
    if (!o.json) head();
    for (Case const& c : cases) {
        if (c.name.find(o.only) == std::string::npos) continue;
        World const world = compile(c.scene());
        for (ColorMode const color : c.colors) {
            if (!o.color.empty() && o.color != word(color)) continue;
            Figures const f = measure(c.name, world, color, o);
            if (o.json)
                all.push_back(to_json(f));
            else
                print(f);
        }
    }
    if (o.json) std::cout << all.dump(2) << '\n';
    return 0;
}

}  // namespace

}  // namespace nephroid

int main(int argc, char** argv) {
    nephroid::Options o;
    CLI::App app{"Renders on one thread, beside the time Embree alone needs for the same rays"};
    app.add_option("--repetitions", o.repetitions, "renders and floors, in turn; medians are shown")
        ->check(CLI::Range(1, 1000));
    app.add_option("--passes", o.passes, "samples a pixel")->check(CLI::Range(1, 4096));
    app.add_option("--pixels", o.pixels, "pixels of a picture, about")->check(CLI::Range(1, 1 << 22));
    app.add_option("--scene", o.only, "only scenes whose name holds this");
    app.add_option("--color", o.color, "only this mode")->check(CLI::IsMember({"rgb", "spectral"}));
    app.add_flag("!--no-floor", o.floor, "render only: for a profiler");
    app.add_flag("--json", o.json, "figures as JSON");
    CLI11_PARSE(app, argc, argv);
    try {
        return nephroid::run(o);
    } catch (std::exception const& e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
}
