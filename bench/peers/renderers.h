// Renderers as programs: each is started for one picture, and says what it took.
#pragma once

#include "peer_scene.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::peers {

struct Rendered {
    Image image;
    double seconds =
        0;  // of the render with its trees, as the program says; of the process where it does not
    double process_seconds = 0;  // from start to exit
};
struct RenderJob {
    int samples = 16;  // a pixel
    std::uint64_t seed = 1;
    bool yardstick = false;  // with the settings of the yardsticks (yardsticks.h), where a renderer has any
};
/// A scene made ready for one renderer; renders it, in a folder that holds everything.
using RenderFunction = std::function<Rendered(RenderJob const&)>;

struct Renderer {
    std::string key;   // as --renderers has it
    std::string name;  // as the page has it
    std::string version;
    bool path_tracer =
        true;  // unbiased and with independent samples: its error is corrected for its reference's own
    std::function<RenderFunction(PeerScene const&, std::filesystem::path const& folder)> prepare;
};

struct Programs {
    std::string nephroid, blender = "blender", povray = "povray", pbrt, mitsuba, tungsten;
    std::filesystem::path cycles_script;
    int threads = 1;
};
/// What renderers are called on the page.
inline constexpr char const* kPath = "nephroid path, rgb";
inline constexpr char const* kSpectral = "nephroid path, spectral";
inline constexpr char const* kSppm = "nephroid sppm, rgb";
inline constexpr char const* kCycles = "Cycles";
inline constexpr char const* kPovray = "POV-Ray";

/// All that are installed; what is missing says so on stderr. "nephroid", "nephroid-spectral", "nephroid-sppm" are ours.
std::vector<Renderer> find_renderers(Programs const& programs);

}  // namespace nephroid::peers
