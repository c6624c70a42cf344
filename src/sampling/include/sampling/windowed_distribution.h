// A piecewise-constant density over the unit square, restricted to a rectangle that is known only when it is sampled
// (Bitterli, Novak, Jarosz 2015, "Portal-Masked Environment Map Sampling"; PBRT 4th ed., A.5.6).
//
// Sums over rectangles come from a summed-area table in whole numbers: differences are exact, so that nothing is lost in a
// small dark window of a bright picture, and what is 0 is 0. Cells that a window cuts count by their share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nephroid {

/// 0 <= x0 <= x1 <= 1, likewise y. In double: the portal of a far receiver is a small window.
struct SquareWindow {
    double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
};

class WindowedDistribution {
  public:
    struct Sample {
        double x = 0, y = 0;  // within the window
        double pdf = 0;       // over the square; integrates to 1 over the window
    };

    WindowedDistribution() = default;
    /// Finite values >= 0 by rows. Each is rounded to 2^-61 of their sum, but what is above 0 stays so.
    WindowedDistribution(std::span<float const> f, int width, int height);

    [[nodiscard]] bool empty() const { return sums_.empty(); }
    /// Nothing where the window has no area or f is 0 all over it. u in [0,1)^2.
    [[nodiscard]] std::optional<Sample> sample(double ux, double uy, SquareWindow const& window) const;
    /// 0 outside the window.
    [[nodiscard]] double pdf(double x, double y, SquareWindow const& window) const;
    /// Of f over the window.
    [[nodiscard]] double integral(SquareWindow const& window) const;
    [[nodiscard]] std::size_t bytes() const { return sums_.size() * sizeof(std::uint64_t); }

  private:
    /// The cells that [a, b] touches along one axis: first and last, and which share of each is inside.
    struct Range {
        std::size_t first = 0, last = 0;
        double first_share = 0, last_share = 0;  // last_share is 0 where first = last
    };
    static Range range(double a, double b, std::size_t cells);
    /// Sum over whole cells [x0, x1) x [y0, y1).
    [[nodiscard]] std::uint64_t block(std::size_t x0, std::size_t y0, std::size_t x1, std::size_t y1) const {
        std::size_t const w = width_ + 1;
        return sums_[y1 * w + x1] - sums_[y1 * w + x0] - (sums_[y0 * w + x1] - sums_[y0 * w + x0]);
    }
    /// Sum over whole columns [x0, x1) of the range's share of each.
    [[nodiscard]] double columns(std::size_t x0, std::size_t x1, Range const& y) const;
    [[nodiscard]] double mass(Range const& x, Range const& y) const;

    std::vector<std::uint64_t> sums_;  // (width + 1) x (height + 1): sum over all cells before
    std::size_t width_ = 0, height_ = 0;
    double unit_ = 0;  // f per whole number
};

}  // namespace nephroid
