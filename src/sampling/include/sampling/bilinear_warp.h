// Densities over the unit square that are bilinear between the nodes of a grid, one for each pair of two parameters' nodes and
// linear between those too: the warp of Dupuy & Jakob 2018, "An Adaptive Parameterization for Efficient Material Acquisition and
// Rendering". The square's y is drawn by the marginal density, then x by the conditional one at that y. Both are
// mixtures of the slices' own, so every number that is looked up is a weighted sum of at most four.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid {

/// Which slices belong to a pair of parameters, and by which weights; these sum to 1.
struct SliceMix {
    std::array<std::uint32_t, 4> slice{};
    std::array<float, 4> weight{};
    int count = 0;
};

/// The nodes of two parameters a and b. Slice number: (index of a) * (nodes of b) + (index of b).
class ParameterGrid {
  public:
    ParameterGrid() = default;
    /// Each ascends strictly and has at least one node.
    ParameterGrid(std::vector<float> a, std::vector<float> b) : a_(std::move(a)), b_(std::move(b)) {}

    [[nodiscard]] std::size_t slices() const { return a_.size() * b_.size(); }
    [[nodiscard]] std::vector<float> const& a() const { return a_; }
    [[nodiscard]] std::vector<float> const& b() const { return b_; }
    /// Parameters beyond the nodes are brought back to the nearest.
    [[nodiscard]] SliceMix mix(float a, float b) const;
    /// One slice alone.
    [[nodiscard]] static SliceMix only(std::size_t slice) {
        return {{static_cast<std::uint32_t>(slice)}, {1.0f}, 1};
    }

  private:
    std::vector<float> a_, b_;
};

class BilinearWarp {
  public:
    BilinearWarp() = default;
    /// Nodes slice by slice, in each row by row (y), up to a factor a slice; width and height at least 2. What is below 0 counts as
    /// 0, and a slice without anything above as uniform.
    BilinearWarp(std::span<float const> nodes, std::size_t width, std::size_t height);

    struct Point {
        Vec2 p;  // in [0, 1]^2
        float pdf = 0;
    };
    [[nodiscard]] Point sample(SliceMix const& mix, Vec2 u) const;
    [[nodiscard]] float pdf(SliceMix const& mix, Vec2 p) const;
    /// The u of which sample() makes p, and the density at p (not at u).
    [[nodiscard]] Point invert(SliceMix const& mix, Vec2 p) const;
    [[nodiscard]] std::size_t bytes() const {
        return (density_.size() + along_x_.size() + along_y_.size()) * sizeof(float);
    }

  private:
    /// A table's number at `i` of each slice, mixed.
    static float mixed(std::vector<float> const& table, std::size_t stride, SliceMix const& mix,
                       std::size_t i) {
        float sum = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(mix.count); ++k)
            sum += mix.weight[k] * table[mix.slice[k] * stride + i];
        return sum;
    }
    /// The part of a row's density up to node `x`, at height `t` between rows y and y + 1.
    [[nodiscard]] float part_of_row(SliceMix const& mix, std::size_t x, std::size_t y, float t) const {
        return lerp(t, mixed(along_x_, width_ * height_, mix, y * width_ + x),
                    mixed(along_x_, width_ * height_, mix, (y + 1) * width_ + x));
    }
    [[nodiscard]] float density_at(SliceMix const& mix, std::size_t x, std::size_t y, float t) const {
        return lerp(t, mixed(density_, width_ * height_, mix, y * width_ + x),
                    mixed(density_, width_ * height_, mix, (y + 1) * width_ + x));
    }
    /// The integral over x of row y.
    [[nodiscard]] float row(SliceMix const& mix, std::size_t y) const {
        return mixed(along_x_, width_ * height_, mix, (y + 1) * width_ - 1);
    }
    /// The integral up to row y.
    [[nodiscard]] float rows_below(SliceMix const& mix, std::size_t y) const {
        return mixed(along_y_, height_, mix, y);
    }

    std::size_t width_ = 0, height_ = 0;
    std::vector<float> density_;  // the nodes, each slice's integral made 1
    std::vector<float> along_x_;  // integral over x from 0 to each node
    std::vector<float> along_y_;  // integral over all x and y from 0 to each row
};

}  // namespace nephroid
