// What a run of the peers is judged by: ratios that have to be at least, or at most, so much.
#pragma once

#include "measure_peers.h"

#include <string>
#include <vector>

namespace nephroid::peers {

struct Target {
    std::string what;
    double bound = 0;
    bool least = true;               // the ratio has to be at least that; else at most
    bool bridged = false;            // by yardsticks.h: the other one was not measured in this run
    std::vector<double> rounds;      // the ratio in each round; empty where it could not be measured
    [[nodiscard]] bool met() const;  // by the median
};

/// Of the scenes and renderers that this run had.
std::vector<Target> targets(std::vector<SceneResult> const& scenes);

}  // namespace nephroid::peers
