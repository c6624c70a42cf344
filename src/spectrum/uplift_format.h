// How the table of coefficients is laid out; shared by the tool that computes it and by who reads it.
#pragma once

#include <cmath>

namespace nephroid {

inline constexpr int kUpliftSize = 64;

/// Node i of the axis of the largest component: smoothstep twice, so that nodes gather at the dark and the bright end, where
/// the coefficients vary most (Jakob & Hanika 2019, section 4).
inline double uplift_node(int i) {
    auto const smooth = [](double x) { return x * x * (3 - 2 * x); };
    return smooth(smooth(static_cast<double>(i) / (kUpliftSize - 1)));
}

/// Coefficients are stored for a wavelength scaled to [0, 1] over [360, 830] nm; floats, three an entry:
/// [largest component][its node][second ratio][first ratio].
inline constexpr int kUpliftEntries = 3 * kUpliftSize * kUpliftSize * kUpliftSize;

}  // namespace nephroid
