// Trials of soft shadows: one light at 1, 4, 16 and 64 samples, as pictures and as errors.
#pragma once

#include "lab.h"
#include "measure.h"

#include <string>
#include <vector>

namespace nephroid::experiment {

/// A scene at any size.
struct Trial {
    std::string label;  // on the sheet
    std::string name;   // in the table
    std::string scene;  // pbrt text, in scenes/
    std::string shapes = "solidangle";

    [[nodiscard]] Setup at(int width, int height) const;
};
/// The ball of scenes/include/ball-under-light.pbrt, and this.
std::string ball_under(std::string const& light);
/// Light samples alone.
std::string light_samples(std::string const& shapes, std::string const& sampler);

/// A row for each trial: 1 to 64 samples and many.
void trial_sheet(Lab const& lab, std::string const& file, std::string const& alt,
                 std::vector<Trial> const& trials);
/// Errors of the same views at a smaller size. Trials that differ by their sampling alone share a reference.
void trial_table(Lab const& lab, std::vector<Trial> const& trials);

/// One ball under squares of three sizes (Figure 6).
void square_lights(Lab const& lab);

}  // namespace nephroid::experiment
