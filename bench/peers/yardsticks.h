// What renderers that are not installed here took elsewhere, on one machine: the bridge to them is Cycles, which was measured there and
// is measured here. A ratio that is bridged is (theirs / Cycles' there) x (Cycles' here / ours here): good for 10% and more, where
// processors favour nobody.
#pragma once

#include "math/vec.h"

#include <array>

namespace nephroid::peers {

/// Seconds of one picture, whole processes but for Cycles; 400 x 400 pixels, 64 samples of a pixel, 8 bounces, box filter, 2 threads of
/// an AMD EPYC (Zen 4) under Debian 12, single runs.
struct Yardstick {
    char const* scene;
    char const* renderer;
    double seconds;
    double least;  // that theirs / ours has to be
    bool sppm;     // against our sppm with the same passes, photons and radius; else against our path tracer
};
/// Mitsuba is 3.8, `llvm_ad_rgb`. Of photons, all emit 64 x 160,000 with a first radius of 0.03; Tungsten gathers the 20 nearest at most.
inline constexpr std::array kYardsticks{
    Yardstick{"cornell", "Mitsuba 3 llvm path", 3.6, 1, false},
    Yardstick{"cornell", "Tungsten path", 12.2, 1, false},
    Yardstick{"cornell", "pbrt-v4 path", 26.8, 1, false},
    Yardstick{"cornell_glass", "Mitsuba 3 llvm path", 4.0, 1, false},
    Yardstick{"cornell_glass", "Tungsten path", 9.8, 1, false},
    Yardstick{"cornell_glass", "pbrt-v4 path", 29.5, 1, false},
    Yardstick{"cornell_glass", "Tungsten progressive photon map", 13.9, 2.5, true},
    Yardstick{"cornell_glass", "pbrt-v4 sppm", 55.6, 10, true},
};
inline constexpr Vec2i kYardstickSize{400, 400};
/// Of Cycles there (Blender 3.4.1), of its render alone.
struct Bridge {
    char const* scene;
    double seconds;
};
inline constexpr std::array kBridges{Bridge{"cornell", 8.3}, Bridge{"cornell_glass", 10.1}};
/// What our sppm may take there, seconds.
inline constexpr double kSppmMost = 5.5;
/// Our sppm as theirs: all that is emitted in a pass are 160,000 photons, caustics among them.
inline constexpr char const* kSppmYardstick =
    "--set photonsperiteration=160000 --set causticphotons=0 --set radius=0.03";

}  // namespace nephroid::peers
