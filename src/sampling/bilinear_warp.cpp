#include "sampling/bilinear_warp.h"

#include "sampling/warp.h"

#include <algorithm>

namespace nephroid {

namespace {

/// A place on an axis of n nodes.
struct Place {
    std::size_t cell;
    float t;
};
Place place(float x, std::size_t n) {
    float const at = min(max(x, 0.0f), 1.0f) * static_cast<float>(n - 1);  // 0 where x is no number
    std::size_t const cell = std::min(static_cast<std::size_t>(at), n - 2);
    return {cell, min(at - static_cast<float>(cell), 1.0f)};
}

/// The last cell of n - 1 at whose start the rising `cumulative` is not yet above `target`.
template <class F>
std::size_t cell_of(std::size_t n, float target, F const& cumulative) {
    std::size_t below = 0;
    std::size_t above = n - 1;
    while (above - below > 1) {
        std::size_t const middle = (below + above) / 2;
        (cumulative(middle) <= target ? below : above) = middle;
    }
    return below;
}

/// Within a cell from density a to b: sample_linear squares its numbers, and shares of their sum cannot underflow.
float sample_cell(float target, float from, float a, float b, float width) {
    float const sum = a + b;
    if (!(sum > 0.0f)) return 0.5f;
    float const u = clamp((target - from) / (0.5f * sum * width), 0.0f, kOneMinusEpsilon);
    return clamp(sample_linear(u, a / sum, b / sum), 0.0f, 1.0f);
}

}  // namespace

SliceMix ParameterGrid::mix(float a, float b) const {
    struct Neighbours {
        std::size_t first;
        float t;  // weight of the next
    };
    auto const find = [](std::vector<float> const& nodes, float x) -> Neighbours {
        if (nodes.size() == 1 || !(x > nodes.front())) return {0, 0.0f};
        auto const above = std::upper_bound(nodes.begin(), nodes.end(), x);
        if (above == nodes.end()) return {nodes.size() - 1, 0.0f};
        auto const i = static_cast<std::size_t>(above - nodes.begin()) - 1;
        return {i, clamp((x - nodes[i]) / (nodes[i + 1] - nodes[i]), 0.0f, 1.0f)};
    };
    Neighbours const na = find(a_, a);
    Neighbours const nb = find(b_, b);
    SliceMix m;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            float const w = (i == 0 ? 1.0f - na.t : na.t) * (j == 0 ? 1.0f - nb.t : nb.t);
            if (!(w > 0.0f)) continue;
            auto const k = static_cast<std::size_t>(m.count++);
            m.slice[k] = static_cast<std::uint32_t>((na.first + i) * b_.size() + nb.first + j);
            m.weight[k] = w;
        }
    return m;
}

BilinearWarp::BilinearWarp(std::span<float const> nodes, std::size_t width, std::size_t height)
    : width_(width), height_(height) {
    std::size_t const size = width * height;
    std::size_t const slices = nodes.size() / size;
    density_.resize(slices * size);
    along_x_.resize(slices * size);
    along_y_.resize(slices * height);
    double const dx = 1.0 / static_cast<double>(width - 1);
    double const dy = 1.0 / static_cast<double>(height - 1);
    std::vector<double> value(size);
    std::vector<double> row(size);
    std::vector<double> column(height);
    for (std::size_t s = 0; s < slices; ++s) {
        auto const integrate = [&] {
            for (std::size_t y = 0; y < height; ++y) {
                row[y * width] = 0;
                for (std::size_t x = 1; x < width; ++x)
                    row[y * width + x] =
                        row[y * width + x - 1] + 0.5 * dx * (value[y * width + x - 1] + value[y * width + x]);
            }
            column[0] = 0;
            for (std::size_t y = 1; y < height; ++y)
                column[y] = column[y - 1] + 0.5 * dy * (row[y * width - 1] + row[(y + 1) * width - 1]);
            return column[height - 1];
        };
        for (std::size_t i = 0; i < size; ++i) value[i] = static_cast<double>(max(nodes[s * size + i], 0.0f));
        double sum = integrate();
        if (!(sum > 0)) {
            std::fill(value.begin(), value.end(), 1.0);
            sum = integrate();
        }
        for (std::size_t i = 0; i < size; ++i) {
            density_[s * size + i] = static_cast<float>(value[i] / sum);
            along_x_[s * size + i] = static_cast<float>(row[i] / sum);
        }
        for (std::size_t y = 0; y < height; ++y)
            along_y_[s * height + y] = static_cast<float>(column[y] / sum);
    }
}

BilinearWarp::Point BilinearWarp::sample(SliceMix const& mix, Vec2 u) const {
    float const dx = 1.0f / static_cast<float>(width_ - 1);
    float const dy = 1.0f / static_cast<float>(height_ - 1);
    float const target_y = u.y * rows_below(mix, height_ - 1);
    std::size_t y = cell_of(height_, target_y, [&](std::size_t i) { return rows_below(mix, i); });
    while (y > 0 && !(row(mix, y) + row(mix, y + 1) > 0.0f)) --y;  // the last rows may be empty
    float const ty = sample_cell(target_y, rows_below(mix, y), row(mix, y), row(mix, y + 1), dy);

    float const target_x = u.x * part_of_row(mix, width_ - 1, y, ty);
    std::size_t x = cell_of(width_, target_x, [&](std::size_t i) { return part_of_row(mix, i, y, ty); });
    while (x > 0 && !(density_at(mix, x, y, ty) + density_at(mix, x + 1, y, ty) > 0.0f)) --x;
    float const a = density_at(mix, x, y, ty);
    float const b = density_at(mix, x + 1, y, ty);
    float const tx = sample_cell(target_x, part_of_row(mix, x, y, ty), a, b, dx);
    return {{min((static_cast<float>(x) + tx) * dx, 1.0f), min((static_cast<float>(y) + ty) * dy, 1.0f)},
            lerp(tx, a, b)};
}

float BilinearWarp::pdf(SliceMix const& mix, Vec2 p) const {
    Place const x = place(p.x, width_);
    Place const y = place(p.y, height_);
    return lerp(x.t, density_at(mix, x.cell, y.cell, y.t), density_at(mix, x.cell + 1, y.cell, y.t));
}

BilinearWarp::Point BilinearWarp::invert(SliceMix const& mix, Vec2 p) const {
    float const dx = 1.0f / static_cast<float>(width_ - 1);
    float const dy = 1.0f / static_cast<float>(height_ - 1);
    Place const x = place(p.x, width_);
    Place const y = place(p.y, height_);
    // The integral of a line from a at 0 to b at 1, up to t.
    auto const part = [](float t, float a, float b) { return t * (a + 0.5f * t * (b - a)); };
    float const below = rows_below(mix, y.cell) + dy * part(y.t, row(mix, y.cell), row(mix, y.cell + 1));
    float const a = density_at(mix, x.cell, y.cell, y.t);
    float const b = density_at(mix, x.cell + 1, y.cell, y.t);
    float const left = part_of_row(mix, x.cell, y.cell, y.t) + dx * part(x.t, a, b);
    float const whole_row = part_of_row(mix, width_ - 1, y.cell, y.t);
    Point r;
    r.p.x = whole_row > 0.0f ? clamp(left / whole_row, 0.0f, 1.0f) : clamp(p.x, 0.0f, 1.0f);
    r.p.y = clamp(below / rows_below(mix, height_ - 1), 0.0f, 1.0f);
    r.pdf = lerp(x.t, a, b);
    return r;
}

}  // namespace nephroid
