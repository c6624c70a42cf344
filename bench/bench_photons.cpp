// Photons on one thread: how many paths are traced and photons stored in a second, what share of that Embree alone takes for the very
// rays of those paths, how long the map takes to build, and how many estimates a second it answers where the camera looks.
//
// Runs of tracing and of Embree alone alternate; medians are reported. docs/performance.md says how to read it.
#include "density.h"
#include "photon_maps.h"
#include "photon_plan.h"
#include "scenes.h"
#include "timing.h"
#include "transport/shooting.h"
#include "world/floor.h"

#include <tbb/task_arena.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace nephroid {

using bench::median;

namespace {

/// In an arena of this thread alone, so that its processor time is all there is.
double seconds_alone(std::function<void()> const& f) {
    tbb::task_arena alone(1);
    double seconds = 0;
    alone.execute([&] { seconds = bench::seconds_of(f); });
    return seconds;
}

struct Options {
    int repetitions = 5;
    int paths = 100000;
    std::string only;
};

/// The rays of a shot: every path once more, vertex by vertex.
std::vector<RecordedRay> rays_of(RenderJob const& job, ShotKind kind, std::uint64_t paths) {
    std::vector<RecordedRay> rays;
    for (std::uint64_t i = 0; i < paths; ++i) {
        TracedPath const path = trace_light_path(job, kind, 0, i, paths);
        for (std::size_t k = 1; k < path.vertices.size(); ++k) {
            Vec3 const d = path.vertices[k] - path.vertices[k - 1];
            if (length(d) > 0.0f)
                rays.push_back({{path.vertices[k - 1], normalize(d)}, kInfinity, RayKind::Bounce});
        }
    }
    return rays;
}

void print_shot(std::string const& scene, char const* map, RenderJob const& job, ShotKind kind, float radius,
                Options const& o) {
    auto const paths = static_cast<std::uint64_t>(o.paths);
    std::vector<RecordedRay> const rays = rays_of(job, kind, paths);
    std::vector<double> shooting, floor, building, asking;
    std::uint64_t stored = 0, found = 0, asked = 0;
    for (int i = 0; i < o.repetitions; ++i) {
        std::optional<Shot> shot;
        shooting.push_back(seconds_alone([&] { shot = shoot(job, kind, 0, paths, {}); }));
        floor.push_back(seconds_alone([&] { trace_only(job.world(), rays); }));
        stored = shot->photons.size() + shot->further.size();
        PhotonMap photons;
        building.push_back(seconds_alone([&] { photons = PhotonMap(std::move(shot->photons), radius); }));
        // Asked at photons, as many as there are, in the order of the map, which is about that of tiles.
        found = asked = 0;
        asking.push_back(seconds_alone([&] {
            for (std::size_t k = 0; k < photons.size(); k += 1 + photons.size() / 100000, ++asked)
                photons.within(photons[k].p(), radius, [&](std::uint32_t, float) { ++found; });
        }));
    }
    double const t = median(shooting), q = median(asking);
    auto const per = [](double n, double seconds) { return seconds > 0 ? n / seconds / 1e6 : 0; };
    std::printf("%-22s %-8s %8.3f %8.3f %7.2f %6.0f%% %9.1f %9.2f %9.1f\n", scene.c_str(), map,
                per(static_cast<double>(paths), t), per(static_cast<double>(stored), t),
                static_cast<double>(rays.size()) / static_cast<double>(paths), 100 * median(floor) / t,
                1e9 * median(building) / static_cast<double>(std::max<std::uint64_t>(1, stored)),
                per(static_cast<double>(asked), q),
                static_cast<double>(found) / static_cast<double>(std::max<std::uint64_t>(1, asked)));
}

int run(Options const& o) {
    std::printf("%-22s %-8s %8s %8s %7s %7s %9s %9s %9s\n", "scene (one thread)", "map", "Mpaths/s",
                "Mstored/s", "rays", "Embree", "build ns", "Mquery/s", "hits");
    for (char const* name :
         {"cornell-box", "cornell-spheres", "cornell-mirror-boxes", "cup", "ring", "goblet", "pool"}) {
        if (std::string(name).find(o.only) == std::string::npos) continue;
        World const world = compile(read_scene(bench::scene_file((std::string(name) + ".pbrt").c_str())));
        Settings s = world.scene().settings;
        SppmIntegrator sppm;
        sppm.max_depth = sppm.shooting.max_depth = 16;
        sppm.shooting.global_paths = o.paths;
        s.integrator = sppm;
        s.color = ColorMode::Rgb;
        RenderJob const job(world, s);
        PhotonPlan const& plan = *job.photon_plan();
        print_shot(name, "global", job, ShotKind::Indirect, plan.global_radius, o);
        if (plan.caustic_paths > 0)
            print_shot(name, "caustic", job, ShotKind::Caustic, plan.caustic_radius, o);
    }
    return 0;
}

}  // namespace

}  // namespace nephroid

int main(int argc, char** argv) {
    nephroid::Options o;
    CLI::App app{"Photons on one thread: shot, put in order, asked"};
    app.add_option("--repetitions", o.repetitions, "of everything, in turn; medians are shown")
        ->check(CLI::Range(1, 1000));
    app.add_option("--paths", o.paths, "emitted into each map")->check(CLI::Range(1, 100000000));
    app.add_option("--scene", o.only, "only scenes whose name holds this");
    CLI11_PARSE(app, argc, argv);
    try {
        return nephroid::run(o);
    } catch (std::exception const& e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
}
