// The subcommands of `nephroid`: what each is asked for, and what it does. Only main.cpp knows how options are spelled, and
// only this room prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::cli {

/// docs/conventions.md, "Exit codes".
enum ExitCode : int {
    kGood = 0,
    kInternal = 1,
    kBadInput = 2,
    kLimit = 3,
    kIo = 4,
    kInterrupted = 5,
    kTainted = 6
};

/// What overrides the scene's settings.
struct SettingOptions {
    std::string integrator, size, crop, color;
    std::vector<std::string> sets;
    std::optional<int> spp;
    std::optional<std::uint64_t> seed;
    bool aovs = false, full_float = false;
};
/// What is drawn over pictures. -1: not asked for.
struct OverlayOptions {
    int photons = -1, paths = -1, normals = -1;
    bool hidden = false;
    std::string map = "both";
};
struct RenderOptions : SettingOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::string time, passes, checkpoint, resume, log, stats, memory_limit;
    std::string replay;  // pass,x,y
    OverlayOptions overlay;
    int threads = 0;
    float exposure = 0;
    double checkpoint_every = 60;
    bool quiet = false;
};
struct PhotonsOptions : SettingOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::string map = "both", memory_limit;
    std::optional<int> count, paths;
    std::uint64_t pass = 0;
    bool quiet = false;
};
struct ConvertOptions : SettingOptions {
    std::string scene, output;
    bool portable = false, quiet = false;
};
struct InfoOptions {
    std::string scene;
    bool json = false;
};
struct MergeOptions {
    std::vector<std::string> films, outputs;
    float exposure = 0;
    bool full_float = false;
};
struct CompareOptions {
    std::string a, b;
    int bins = 16;
    bool json = false;
};

// Each returns an exit code; they throw Error.
int run(RenderOptions const& o);
int run(ConvertOptions const& o);
int run(InfoOptions const& o);
int run(MergeOptions const& o);
int run(CompareOptions const& o);
int run(PhotonsOptions const& o);

}  // namespace nephroid::cli
