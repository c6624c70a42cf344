// Photons sorted by the cells of a grid: for one radius, known beforehand.
//
// Cells are as wide as the ball that is asked for, so that a question meets few of them. The table of cells is no larger than the
// number of photons, whatever the size of the scene: rows of cells along x are hashed to places in it (Teschner et al. 2003), the
// cells of a row follow each other, and so do their photons. Cells that share a place do no harm but time.
#pragma once

#include "transport/float8.h"

#include <algorithm>
#include <span>
#include <vector>

namespace nephroid {

struct PlacedPhoton;

class PhotonGrid {
  public:
    PhotonGrid() = default;
    /// Brings the photons into the order of the grid; the same on any number of threads. Larger radii than `radius` find what
    /// they should, slowly.
    PhotonGrid(std::vector<PlacedPhoton>& photons, float radius);
    /// Whether a grid can be made for it.
    static bool suits(float radius) { return radius > 1e-30f && radius < 1e30f; }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const {
        return (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(float) +
               begin_.capacity() * sizeof(std::uint32_t);
    }

    /// Calls f(places of eight photons, the first place, squared distances) for all that may have squared distance < radius^2,
    /// none twice; lanes that do not count are infinitely far.
    template <class F>
    void eights_within(Vec3 p, float radius, F&& f) const;

  private:
    using Cell = Vec3i;

    /// Monotonic in each coordinate.
    [[nodiscard]] Cell cell_of(Vec3 p) const {
        Vec3 const c = (p - lo_) * scale_;
        auto const to_int = [](float x) {
            return static_cast<int>(clamp(std::floor(x), -1.0f, kFarthestCell));
        };
        return {to_int(c.x), to_int(c.y), to_int(c.z)};
    }
    [[nodiscard]] std::uint32_t place_of(Cell c) const {
        std::uint32_t const row =
            static_cast<std::uint32_t>(c.y) * 0x9e3779b1u ^ static_cast<std::uint32_t>(c.z) * 0x85ebca77u;
        return (row + static_cast<std::uint32_t>(c.x)) & mask_;
    }
    template <class F>
    void eights_of(std::uint32_t begin, std::uint32_t end, Points8 const& at, F&& f) const;
    template <class F>
    void eights_of_row(Cell first, int last_x, Points8 const& at, bool alone, F&& f) const;
    [[nodiscard]] bool share_a_place(Cell lo, Cell hi) const;

    static constexpr float kFarthestCell = 1e9f;

    Vec3 lo_{0, 0, 0};
    float scale_ = 0;  // cells in a unit of length
    std::uint32_t mask_ = 0;
    std::size_t size_ = 0;
    std::vector<std::uint32_t> begin_;  // of the photons of each place, and their end
    std::vector<float> x_, y_, z_;      // and eight more
};

template <class F>
void PhotonGrid::eights_of(std::uint32_t begin, std::uint32_t end, Points8 const& at, F&& f) const {
    constexpr Float8 kLane{0, 1, 2, 3, 4, 5, 6, 7};
    for (std::uint32_t i = begin; i < end; i += 8) {
        Float8 const d2 = Points8{load8(&x_[i]), load8(&y_[i]), load8(&z_[i])}.distance2(at);
        std::uint32_t const left = end - i;
        f(i, left >= 8 ? d2 : (kLane < all8(static_cast<float>(left)) ? d2 : all8(kInfinity)));
    }
}

template <class F>
void PhotonGrid::eights_of_row(Cell first, int last_x, Points8 const& at, bool alone, F&& f) const {
    auto const mine = [&](std::uint32_t i, Float8 d2) {
        if (!alone)  // photons of other rows are found there
            for (std::uint32_t lane = 0; lane < 8 && i + lane < size_; ++lane) {
                Cell const c = cell_of({x_[i + lane], y_[i + lane], z_[i + lane]});
                if (c.y != first.y || c.z != first.z) d2[lane] = kInfinity;
            }
        f(i, d2);
    };
    std::uint32_t const begin = place_of(first),
                        end = begin + static_cast<std::uint32_t>(last_x - first.x) + 1;
    eights_of(begin_[begin], begin_[std::min(end, mask_ + 1)], at, mine);
    if (end > mask_ + 1) eights_of(0, begin_[end - mask_ - 1], at, mine);
}

template <class F>
void PhotonGrid::eights_within(Vec3 p, float radius, F&& f) const {
    if (size_ == 0) return;
    Points8 const at = all8(p);
    // Squared distances are rounded, and so may be that of a photon a little farther away.
    Vec3 const reach(radius * (1.0f + 0x1p-20f));
    Cell lo = cell_of(p - reach), hi = cell_of(p + reach);
    if (hi.x < 0 || hi.y < 0 || hi.z < 0) return;
    lo = {std::max(lo.x, 0), std::max(lo.y, 0), std::max(lo.z, 0)};
    Vec3 const sides = Vec3(hi - lo) + 1.0f;
    if (sides.x * sides.y * sides.z > static_cast<float>(mask_))
        return eights_of(0, static_cast<std::uint32_t>(size_), at, f);
    bool const alone = !share_a_place(lo, hi);
    for (int z = lo.z; z <= hi.z; ++z)
        for (int y = lo.y; y <= hi.y; ++y) eights_of_row({lo.x, y, z}, hi.x, at, alone, f);
}

}  // namespace nephroid
