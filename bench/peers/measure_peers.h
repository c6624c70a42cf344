// What is measured of each renderer in each scene.
#pragma once

#include "renderers.h"

#include <map>
#include <string>
#include <vector>

namespace nephroid::peers {

struct Plan {
    double seconds = 4;     // of a render that is measured
    int repetitions = 5;    // interleaved: each renderer once, then each again
    double reference = 10;  // of a reference, in samples of such a render
};
struct TimedError {
    double seconds = 0, error = 0;
};
struct Result {
    std::string renderer;
    bool path_tracer = true;
    std::string reference;  // whose picture errors are against: "own" or "path"
    double mean = 0;        // of the reference, over the channels
    int samples = 0;
    std::vector<double> seconds, process_seconds, errors;  // a repetition each; relMSE
    std::vector<TimedError> curve;                         // at 1/16, 1/4, 1 and 4 times the samples
    std::vector<double> seconds64, process_seconds64;      // of the yardsticks' 64 samples, where asked for
    std::string failure;                                   // why there is nothing else
    Image picture;                                         // of the first repetition
};
struct SceneResult {
    std::string scene, about;
    Vec2i resolution{0};
    std::size_t triangles = 0, balls = 0;
    std::vector<Result> results;
};

/// Pictures whose means differ by more are not of the same thing.
inline constexpr double kSameMean = 0.05;
/// That renderer's, if it did not fail.
Result const* find(SceneResult const& scene, std::string const& renderer);
/// What a run cannot be trusted for: renderers that failed, and path tracers whose means are not ours.
std::vector<std::string> complaints(std::vector<SceneResult> const& scenes);

double median(std::vector<double> v);
/// 1 / (relMSE x seconds) of every round; empty where an error is 0.
std::vector<double> efficiencies(Result const& r);

/// `equal_samples`: the yardsticks' 64 samples of a pixel are timed too.
SceneResult measure_scene(std::string const& name, PeerScene const& peer,
                          std::vector<Renderer const*> const& renderers, Plan const& plan, bool equal_samples,
                          std::filesystem::path const& scratch);

}  // namespace nephroid::peers
