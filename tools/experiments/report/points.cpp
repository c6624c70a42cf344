// Unstratified and stratified points (Figure 11 of the report): as a plot, and what they are worth.
#include "sections.h"

#include "points_shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace nephroid::experiment {

namespace {

constexpr int kPoints = 64, kCells = 8;

/// The largest difference, over all rectangles from the origin, between their area and their share of the points: found at
/// rectangles through points' coordinates, which end just before or just behind them.
double star_discrepancy(std::vector<Vec2> const& points) {
    std::vector<double> xs{1}, ys{1};
    for (Vec2 const p : points) xs.push_back(p.x), ys.push_back(p.y);
    double worst = 0;
    for (double const x : xs)
        for (double const y : ys) {
            int open = 0, closed = 0;
            for (Vec2 const p : points) {
                open += p.x < x && p.y < y ? 1 : 0;
                closed += p.x <= x && p.y <= y ? 1 : 0;
            }
            auto const n = static_cast<double>(points.size());
            worst = std::max({worst, x * y - open / n, closed / n - x * y});
        }
    return worst;
}

int empty_cells(std::vector<Vec2> const& points) {
    std::vector<bool> hit(static_cast<std::size_t>(kCells) * kCells);
    for (Vec2 const p : points)
        hit[static_cast<std::size_t>(p.y * kCells) * kCells + static_cast<std::size_t>(p.x * kCells)] = true;
    return static_cast<int>(std::count(hit.begin(), hit.end(), false));
}

double average(std::vector<Vec2> const& points, std::function<double(Vec2)> const& f) {
    double sum = 0;
    for (Vec2 const p : points) sum += f(p);
    return sum / static_cast<double>(points.size());
}

}  // namespace

void stratified_points(Lab const& lab) {
    Page& page = lab.page;
    points_shown(page);
    int const draws = lab.quick ? 8 : 256;
    // Integrals over the square: one that is smooth, one that has an edge.
    auto const smooth = [](Vec2 p) { return std::exp(static_cast<double>(p.x) * static_cast<double>(p.y)); };
    auto const edge = [](Vec2 p) { return p.x * p.x + p.y * p.y < 1 ? 1.0 : 0.0; };
    double smooth_truth = 0;  // sum over k of 1 / (k! (k+1)^2)
    double factorial = 1;
    for (int k = 0; k < 20; ++k) smooth_truth += 1 / (factorial * (k + 1) * (k + 1)), factorial *= k + 1;
    double const edge_truth = std::numbers::pi / 4;
    std::vector<std::vector<std::string>> rows;
    for (NamedSequence const& s : shown_sequences()) {
        double discrepancy = 0, empty = 0, of_smooth = 0, of_edge = 0;
        for (int i = 0; i < draws; ++i) {
            auto const points = first_points(s.sequence, static_cast<std::uint64_t>(i), kPoints);
            discrepancy += star_discrepancy(points) / draws;
            empty += static_cast<double>(empty_cells(points)) / draws;
            of_smooth += std::pow(average(points, smooth) / smooth_truth - 1, 2) / draws;
            of_edge += std::pow(average(points, edge) / edge_truth - 1, 2) / draws;
        }
        rows.push_back({s.name, number(discrepancy), number(empty), percent(std::sqrt(of_smooth)),
                        percent(std::sqrt(of_edge))});
    }
    page.table({fmt::format("{} points, {} draws", kPoints, draws), "star discrepancy, mean",
                fmt::format("empty cells of {0} × {0}, mean", kCells), "error of ∫∫ exp(xy)",
                "error of a quarter disk's area"},
               rows);
    double const expected = kCells * kCells * std::pow(1 - 1.0 / (kCells * kCells), kPoints);
    page.text(fmt::format(
        "Independent points leave {} of the {} cells empty on average (64 · (63/64)^64), points with a cell "
        "for each none. Errors are root mean squares, relative. In pictures: "
        "[samplers](../experiments/direct-lighting.md#samplers).",
        number(expected), kCells * kCells));
}

}  // namespace nephroid::experiment
