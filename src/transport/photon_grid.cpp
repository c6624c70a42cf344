#include "transport/photon_grid.h"

#include "photon_order.h"

#include <array>
#include <bit>

#include <tbb/parallel_for.h>

namespace nephroid {

namespace {

// Photons are sorted in two steps: into so many ranges of places, by so many workers each with its own part of the photons; then
// each range by itself. Both are the same on any number of threads.
constexpr std::size_t kRanges = 256;
constexpr std::size_t kParts = 64;

struct Sorted {
    std::uint32_t place;
    PlacedPhoton photon;
};

}  // namespace

PhotonGrid::PhotonGrid(std::vector<PlacedPhoton>& photons, float radius) : size_(photons.size()) {
    if (photons.empty()) return;
    lo_ = bounds_of(photons).lo;
    scale_ = 0.5f / radius;
    mask_ = static_cast<std::uint32_t>(std::bit_floor(size_)) - 1;
    auto const places = static_cast<std::size_t>(mask_) + 1;
    std::size_t const places_of_range = (places + kRanges - 1) / kRanges;

    std::vector<std::uint32_t> place(size_);
    std::vector<std::array<std::uint32_t, kRanges>> next(kParts);  // of each part, in each range
    std::size_t const part_size = (size_ + kParts - 1) / kParts;
    auto const of_part = [&](std::size_t part, auto&& f) {
        for (std::size_t i = part * part_size; i < std::min(size_, (part + 1) * part_size); ++i) f(i);
    };
    tbb::parallel_for(std::size_t{0}, kParts, [&](std::size_t part) {
        next[part] = {};
        of_part(part, [&](std::size_t i) {
            place[i] = place_of(cell_of(photons[i].p));
            ++next[part][place[i] / places_of_range];
        });
    });
    std::array<std::uint32_t, kRanges + 1> range{};
    std::uint32_t all = 0;
    for (std::size_t r = 0; r < kRanges; ++r) {
        range[r] = all;
        for (auto& part : next) all += std::exchange(part[r], all);
    }
    range[kRanges] = all;
    std::vector<Sorted> by_range(size_);
    tbb::parallel_for(std::size_t{0}, kParts, [&](std::size_t part) {
        of_part(part, [&](std::size_t i) {
            by_range[next[part][place[i] / places_of_range]++] = {place[i], photons[i]};
        });
    });

    begin_.assign(places + 1, 0);
    begin_[places] = all;
    for (auto* v : {&x_, &y_, &z_}) v->resize(size_ + 8, kInfinity);
    tbb::parallel_for(std::size_t{0}, kRanges, [&](std::size_t r) {
        std::size_t const first = std::min(places, r * places_of_range),
                          last = std::min(places, first + places_of_range);
        std::span<Sorted const> const mine(by_range.data() + range[r], range[r + 1] - range[r]);
        std::vector<std::uint32_t> at(last - first + 1, 0);
        for (Sorted const& s : mine) ++at[s.place - first + 1];
        at[0] = range[r];
        for (std::size_t i = 1; i < at.size(); ++i) at[i] += at[i - 1];
        std::copy(at.begin(), at.end() - 1, begin_.begin() + static_cast<std::ptrdiff_t>(first));
        for (Sorted const& s : mine) {
            std::uint32_t const i = at[s.place - first]++;
            photons[i] = s.photon;
            x_[i] = s.photon.p.x, y_[i] = s.photon.p.y, z_[i] = s.photon.p.z;
        }
    });
}

/// Whether two rows of these cells have a place in common: then photons could be met twice.
bool PhotonGrid::share_a_place(Cell lo, Cell hi) const {
    auto const long_row = static_cast<std::uint32_t>(hi.x - lo.x);
    std::array<std::uint32_t, 9> begin;
    std::size_t rows = 0;
    for (int z = lo.z; z <= hi.z; ++z)
        for (int y = lo.y; y <= hi.y; ++y) {
            if (rows == begin.size()) return true;  // too many to say
            std::uint32_t const mine = place_of({lo.x, y, z});
            for (std::size_t i = 0; i < rows; ++i)
                if (((mine - begin[i]) & mask_) <= long_row || ((begin[i] - mine) & mask_) <= long_row)
                    return true;
            begin[rows++] = mine;
        }
    return false;
}

}  // namespace nephroid
