// Discrete and piecewise-constant distributions.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace nephroid {

/// Walker's alias table (built by Vose 1991): one index in constant time. Takes a double: one number chooses a cell and then
/// tosses its coin, and of a float's 24 bits a table of a million cells would leave four for the coin.
class AliasTable {
  public:
    struct Sample {
        std::uint32_t index = 0;
        float pmf = 0;
        float u = 0;  // a fresh uniform number left over from the one put in
    };

    AliasTable() = default;
    /// Weights >= 0; all zero makes an empty table.
    explicit AliasTable(std::span<float const> weights);

    [[nodiscard]] bool empty() const { return bins_.empty(); }
    [[nodiscard]] std::size_t size() const { return bins_.size(); }
    [[nodiscard]] float pmf(std::uint32_t i) const { return bins_[i].p; }
    [[nodiscard]] Sample sample(double u) const;
    [[nodiscard]] std::size_t bytes() const { return bins_.size() * sizeof(Bin); }

  private:
    struct Bin {
        float q = 0;  // keep this index with probability q, else take alias
        float p = 0;
        std::uint32_t alias = 0;
    };
    std::vector<Bin> bins_;
};

inline AliasTable::Sample AliasTable::sample(double u) const {
    double const scaled = u * static_cast<double>(bins_.size());
    auto const i = std::min(static_cast<std::uint32_t>(scaled), static_cast<std::uint32_t>(bins_.size() - 1));
    double const up = scaled - static_cast<double>(i);
    Bin const& b = bins_[i];
    auto const q = static_cast<double>(b.q);
    if (up < q) return {i, b.p, std::min(static_cast<float>(up / q), kOneMinusEpsilon)};
    return {b.alias, bins_[b.alias].p, std::min(static_cast<float>((up - q) / (1.0 - q)), kOneMinusEpsilon)};
}

/// Piecewise-constant density over [0,1], sampled by inversion (keeps stratification).
///
/// A float in [0,1) tells 2^24 places apart, so a cell of less probability than that would never be drawn, and one of little
/// more too often or too seldom. Therefore every cell where f > 0 gets at least 2^-8 of an equal share, and cell edges in the
/// cumulative distribution are multiples of 2^-24: a cell is drawn by a whole number of the 2^24 floats, and its density is
/// that number. The density is exactly that of the samples, not of f, from which it differs by 2^-24 / (probability of the cell).
class Distribution1D {
  public:
    Distribution1D() = default;
    /// Values >= 0 (signs are ignored); all zero makes a uniform density.
    explicit Distribution1D(std::span<float const> f);

    /// Of f, not of the density (which has 1).
    [[nodiscard]] float integral() const { return integral_; }
    [[nodiscard]] std::size_t size() const { return guide_.size(); }
    /// x in [0,1); `pdf` its density, `cell` where it fell.
    float sample(float u, float* pdf = nullptr, std::size_t* cell = nullptr) const;
    [[nodiscard]] float pdf(float x) const;
    [[nodiscard]] std::optional<float> invert(float x) const;
    [[nodiscard]] std::size_t bytes() const {
        return cdf_.size() * sizeof(float) + guide_.size() * sizeof(std::uint32_t);
    }

  private:
    /// Density in a cell: its 2^-24ths, exact, times the number of cells.
    [[nodiscard]] float density(std::size_t cell) const {
        return integral_ > 0 ? (cdf_[cell + 1] - cdf_[cell]) * static_cast<float>(guide_.size()) : 1.0f;
    }

    std::vector<float> cdf_;
    std::vector<std::uint32_t>
        guide_;  // guide_[k]: the cell of u = k / n, where the search for u >= k / n starts
    float integral_ = 0;
};

/// Piecewise-constant density over the unit square, row by row.
class Distribution2D {
  public:
    Distribution2D() = default;
    Distribution2D(std::span<float const> f, int width, int height);

    [[nodiscard]] bool empty() const { return rows_.empty(); }
    [[nodiscard]] float integral() const { return marginal_.integral(); }
    Vec2 sample(Vec2 u, float* pdf = nullptr) const;
    [[nodiscard]] float pdf(Vec2 p) const;
    [[nodiscard]] std::optional<Vec2> invert(Vec2 p) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::vector<Distribution1D> rows_;
    Distribution1D marginal_;
};

/// Means over width x height cells of the unit square of value(Vec2), for a table of where it is large: by weights 1 2 1 over each
/// cell and its edges, so that no cell in which it is above 0 on the grid, edges included, has none.
template <class F>
std::vector<float> cell_means(int width, int height, F const& value) {
    auto const nx = static_cast<std::size_t>(width);
    auto const ny = static_cast<std::size_t>(height);
    // Three rows of the grid at a time: pictures are large.
    std::array<std::vector<float>, 3> rows;
    auto const fill = [&](std::vector<float>& row, std::size_t y) {
        row.resize(2 * nx + 1);
        for (std::size_t x = 0; x < row.size(); ++x)
            row[x] = value(Vec2{static_cast<float>(x) / static_cast<float>(2 * nx),
                                static_cast<float>(y) / static_cast<float>(2 * ny)});
    };
    std::vector<float> means(nx * ny);
    fill(rows[2], 0);
    for (std::size_t y = 0; y < ny; ++y) {
        std::swap(rows[0], rows[2]);
        fill(rows[1], 2 * y + 1);
        fill(rows[2], 2 * y + 2);
        for (std::size_t x = 0; x < nx; ++x)
            for (std::size_t j = 0; j <= 2; ++j)
                for (std::size_t i = 0; i <= 2; ++i)
                    means[y * nx + x] +=
                        (i == 1 ? 2.0f : 1.0f) * (j == 1 ? 2.0f : 1.0f) / 16.0f * rows[j][2 * x + i];
    }
    return means;
}

}  // namespace nephroid
