#include "sampling/windowed_distribution.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

std::size_t cell_of(double x, std::size_t cells) {
    return std::min(static_cast<std::size_t>(x * static_cast<double>(cells)), cells - 1);
}

/// Where `target` falls among the cells of a range. before(k): the mass of the range's cells below cell k, not decreasing.
/// Returns the cell, and leaves in `target` the place within the cell's part of the range, in [0,1).
template <class Before>
std::size_t find(std::size_t first, std::size_t last, double& target, Before const& before) {
    std::size_t lo = first;
    std::size_t hi = last + 1;  // before(lo) <= target < before(hi)
    double at_lo = 0;
    double at_hi = before(hi);
    while (hi - lo > 1) {
        std::size_t const mid = lo + (hi - lo) / 2;
        double const at_mid = before(mid);
        if (at_mid <= target)
            lo = mid, at_lo = at_mid;
        else
            hi = mid, at_hi = at_mid;
    }
    target = std::clamp((target - at_lo) / (at_hi - at_lo), 0.0, 1.0 - 0x1p-53);
    return lo;
}

/// The place t of the way through the part of a cell that [a, b] leaves, inside the cell to the last bit.
double place(std::size_t cell, std::size_t cells, double t, double a, double b) {
    auto const n = static_cast<double>(cells);
    double const lo = std::max(a, static_cast<double>(cell) / n);
    double const hi = std::min(b, static_cast<double>(cell + 1) / n);
    double x = std::clamp(lo + t * (hi - lo), a, b);
    while (cell_of(x, cells) > cell) x = std::nextafter(x, 0.0);
    while (cell_of(x, cells) < cell) x = std::nextafter(x, 1.0);
    return x;
}

bool has_area(SquareWindow const& w) { return w.x0 < w.x1 && w.y0 < w.y1; }

}  // namespace

WindowedDistribution::WindowedDistribution(std::span<float const> f, int width, int height)
    : width_(static_cast<std::size_t>(width)), height_(static_cast<std::size_t>(height)) {
    double sum = 0;
    for (float const v : f) sum += static_cast<double>(v);
    unit_ = sum > 0 ? sum * 0x1p-61 : 1;
    sums_.assign((width_ + 1) * (height_ + 1), 0);
    for (std::size_t y = 0; y < height_; ++y) {
        std::uint64_t row = 0;
        for (std::size_t x = 0; x < width_; ++x) {
            double const v = static_cast<double>(f[y * width_ + x]);
            if (v > 0) row += static_cast<std::uint64_t>(std::max(1.0, std::round(v / unit_)));
            sums_[(y + 1) * (width_ + 1) + x + 1] = sums_[y * (width_ + 1) + x + 1] + row;
        }
    }
}

WindowedDistribution::Range WindowedDistribution::range(double a, double b, std::size_t cells) {
    auto const n = static_cast<double>(cells);
    Range r;
    r.first = cell_of(a, cells), r.last = cell_of(b, cells);
    if (r.first == r.last) {
        r.first_share = (b - a) * n;
    } else {
        r.first_share = static_cast<double>(r.first + 1) - a * n;
        r.last_share = b * n - static_cast<double>(r.last);
    }
    return r;
}

double WindowedDistribution::columns(std::size_t x0, std::size_t x1, Range const& y) const {
    double sum = y.first_share * static_cast<double>(block(x0, y.first, x1, y.first + 1));
    if (y.last > y.first)
        sum += static_cast<double>(block(x0, y.first + 1, x1, y.last)) +
               y.last_share * static_cast<double>(block(x0, y.last, x1, y.last + 1));
    return sum;
}

double WindowedDistribution::mass(Range const& x, Range const& y) const {
    double sum = x.first_share * columns(x.first, x.first + 1, y);
    if (x.last > x.first)
        sum += columns(x.first + 1, x.last, y) + x.last_share * columns(x.last, x.last + 1, y);
    return sum;
}

std::optional<WindowedDistribution::Sample> WindowedDistribution::sample(double ux, double uy,
                                                                         SquareWindow const& w) const {
    std::optional<Sample> result;
    if (empty() || !has_area(w)) return result;
    Range const x = range(w.x0, w.x1, width_);
    Range const y = range(w.y0, w.y1, height_);
    double const first_column = x.first_share * columns(x.first, x.first + 1, y);
    auto const before_column = [&](std::size_t k) {
        if (k == x.first) return 0.0;
        double m = first_column + (k > x.first + 1 ? columns(x.first + 1, std::min(k, x.last), y) : 0.0);
        if (k > x.last && x.last > x.first) m += x.last_share * columns(x.last, x.last + 1, y);
        return m;
    };
    double const total = before_column(x.last + 1);
    if (!(total > 0)) return result;
    double tx = ux * total;
    std::size_t const i = find(x.first, x.last, tx, before_column);

    double const first_cell = y.first_share * static_cast<double>(block(i, y.first, i + 1, y.first + 1));
    auto const before_cell = [&](std::size_t k) {
        if (k == y.first) return 0.0;
        double m =
            first_cell +
            (k > y.first + 1 ? static_cast<double>(block(i, y.first + 1, i + 1, std::min(k, y.last))) : 0.0);
        if (k > y.last && y.last > y.first)
            m += y.last_share * static_cast<double>(block(i, y.last, i + 1, y.last + 1));
        return m;
    };
    double ty = uy * before_cell(y.last + 1);
    std::size_t const j = find(y.first, y.last, ty, before_cell);

    Sample& s = result.emplace();
    s.x = place(i, width_, tx, w.x0, w.x1);
    s.y = place(j, height_, ty, w.y0, w.y1);
    s.pdf = static_cast<double>(block(i, j, i + 1, j + 1)) / total * static_cast<double>(width_ * height_);
    return result;
}

double WindowedDistribution::pdf(double x, double y, SquareWindow const& w) const {
    if (empty() || !has_area(w) || x < w.x0 || x > w.x1 || y < w.y0 || y > w.y1) return 0;
    std::size_t const i = cell_of(x, width_);
    std::size_t const j = cell_of(y, height_);
    auto const cell = static_cast<double>(block(i, j, i + 1, j + 1));
    double const total = mass(range(w.x0, w.x1, width_), range(w.y0, w.y1, height_));
    return cell > 0 && total > 0 ? cell / total * static_cast<double>(width_ * height_) : 0;
}

double WindowedDistribution::integral(SquareWindow const& w) const {
    if (empty() || !has_area(w)) return 0;
    return mass(range(w.x0, w.x1, width_), range(w.y0, w.y1, height_)) * unit_ /
           static_cast<double>(width_ * height_);
}

}  // namespace nephroid
