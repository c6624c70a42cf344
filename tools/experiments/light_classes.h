// The light of a picture by its ways (transport/light_class.h: direct, caustic, indirect, specular), and by which of them it is
// off a reference.
#pragma once

#include "measure.h"

#include <array>
#include <cstdint>
#include <string>

namespace nephroid::experiment {

struct ByClass {
    Picture whole;
    std::array<Picture, kLightClasses> of;  // together the whole
    double seconds = 0;
};
/// Passes [0, passes). Throws std::runtime_error when the parts are not the whole.
ByClass render_by_class(Setup const& setup, std::string const& directives, std::uint64_t passes,
                        std::uint64_t seed = 1);

struct ReferenceByClass {
    ByClass light;     // in the seconds of both
    double error = 0;  // as of Reference
};
/// reference_by_samples(), by ways.
ReferenceByClass reference_by_class(Setup const& setup, std::string const& directives, std::uint64_t passes);

/// The share of each way in the mean square error: with d the difference and d_w that of a way, <d_w d> / <d d>. They add up
/// to 1. A way whose errors make up for those of others counts negative.
std::array<double, kLightClasses> shares_of_error(ByClass const& p, ByClass const& reference);

}  // namespace nephroid::experiment
