#include "experiment.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <thread>

namespace nephroid::experiment {

namespace {

void write_page(Experiment const& experiment, std::filesystem::path const& folder, bool quick) {
    auto const start = std::chrono::steady_clock::now();
    auto const seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    Page page(folder, experiment.name, experiment.title);
    Lab lab{page, quick,
            std::filesystem::temp_directory_path() / ("nephroid-experiment-" + std::to_string(getpid()))};
    bool const gallery = experiment.gallery > 0;
    std::optional<NewFolder> full;
    if (gallery)
        full.emplace(folder / kFullFolder), lab.full = full->path(), lab.enlarge = experiment.gallery;
    std::filesystem::create_directories(lab.scratch);
    if (quick) page.text("**A quick run: the numbers show that the program works, and nothing else.**");
    experiment.introduction(page);
    for (Section const& s : experiment.sections) {
        double const begin = seconds();
        std::fprintf(stderr, "%5.1f s  %s\n", begin, s.title);
        page.section(s.title);
        s.run(lab);
        if (gallery && !quick) page.text("Made in " + number(seconds() - begin) + " s.");
    }
    if (full) full->keep();
    page.write(gallery);
    std::filesystem::remove_all(lab.scratch);
    std::fprintf(stderr, "%5.1f s  done: %s.md\n", seconds(), (folder / experiment.name).c_str());
}

}  // namespace

std::string processors() {
    unsigned const n = std::max(1u, std::thread::hardware_concurrency());
    return std::to_string(n) + (n == 1 ? " processor" : " processors");
}

int run_experiment(Experiment const& experiment, int argc, char** argv) {
    bool const quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    if (argc != (quick ? 3 : 2)) {
        std::fprintf(stderr, "%s [--quick] FOLDER\n", argv[0]);
        return 2;
    }
    try {
        write_page(experiment, argv[argc - 1], quick);
    } catch (std::exception const& e) {
        std::fprintf(stderr, "experiment: %s\n", e.what());
        return 1;
    }
    return 0;
}

}  // namespace nephroid::experiment
