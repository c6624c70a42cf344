// A program that writes one page: PROGRAM [--quick] FOLDER writes FOLDER/name.md and FOLDER/name/*.
#pragma once

#include "lab.h"

#include <span>

namespace nephroid::experiment {

struct Section {
    char const* title;
    void (*run)(Lab const&);
};

struct Experiment {
    char const* name;
    char const* title;
    void (*introduction)(Page&);
    std::span<Section const> sections;
    /// A gallery: an HTML page too, each section with its time, pictures so many times as large as they are shown, kept in full
    /// size in FOLDER/full.
    int gallery = 0;
};

/// "2 processors": what the times on a page were taken with, since a render takes all that there are.
std::string processors();

/// Exit code: 2 for wrong arguments, 1 for what failed, which stderr then says, as it says what is being done. A run with
/// --quick says on the page that it was one.
int run_experiment(Experiment const& experiment, int argc, char** argv);

}  // namespace nephroid::experiment
