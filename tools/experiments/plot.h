// Plots as SVG text: lines over linear or logarithmic axes, and panels of points in the unit square.
#pragma once

#include "math/vec.h"

#include <string>
#include <vector>

namespace nephroid::experiment {

struct Axis {
    std::string label;
    bool logarithmic = true;
    std::vector<double> ticks = {};  // where to label; empty: powers of ten, or round numbers
};

struct Line {
    std::string name;  // in the legend
    std::vector<double> x, y;
    std::string note = {};  // behind the name, as a fitted slope
};

/// A dotted vertical with a word at its top.
struct Guide {
    double x = 0;
    std::string label;
};

/// Colours that are told apart without colour vision (Okabe & Ito 2008), and a marker for each line. On a logarithmic axis
/// numbers that are not above 0 are left out.
std::string line_plot(std::string const& title, Axis const& x, Axis const& y, std::vector<Line> const& lines,
                      std::vector<Guide> const& guides = {}, bool markers = true);

/// A unit square of points, with the grid lines of n x n cells (1: none).
struct PointPanel {
    std::string title;
    std::vector<Vec2> points;
    int cells = 1;
};
std::string point_plot(std::vector<PointPanel> const& panels);

}  // namespace nephroid::experiment
