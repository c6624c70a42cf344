// Photons in space, and who is near.
#pragma once

#include "transport/photon.h"
#include "transport/photon_grid.h"
#include "transport/photon_tree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid {

class PhotonMap {
  public:
    PhotonMap() = default;
    /// Takes the photons in any order, fewer than 2^32 of them; those at places that are not finite are left out. The map is the
    /// same on any number of threads. Runs in the caller's arena. Where all questions will be within() of one radius, `for_radius`,
    /// a grid takes a quarter of the time to build; 0 where the nearest are asked for, or different radii. Either answers all.
    explicit PhotonMap(std::vector<Photon> photons, float for_radius = 0);

    [[nodiscard]] std::size_t size() const { return photons_.size(); }
    [[nodiscard]] bool empty() const { return photons_.empty(); }
    [[nodiscard]] Photon const& operator[](std::size_t i) const { return photons_[i]; }
    /// About 48 a photon: itself 32, its place once more 12, and 2 to 4 for what leads there. While it is built, 48 more.
    [[nodiscard]] std::size_t bytes() const {
        return photons_.capacity() * sizeof(Photon) + tree_.bytes() + grid_.bytes();
    }

    /// Calls f(index, squared distance) for every photon nearer than `radius`. None is near to no place (NaN).
    template <class F>
    void within(Vec3 p, float radius, F&& f) const {
        if (!asks(p, radius)) return;
        // Written down first, without a branch: which of eight are near is not to be guessed.
        constexpr std::size_t kRoom = 64;
        std::array<float, kRoom + 8> distance2;
        std::array<std::uint32_t, kRoom + 8> index;
        std::size_t found = 0;
        auto const hand_over = [&] {
            for (std::size_t i = 0; i < found; ++i) f(index[i], distance2[i]);
            found = 0;
        };
        Float8 const most = all8(radius * radius);
        auto const each = [&](std::uint32_t first, Float8 d2) {
            found += pack8(less8(d2, most), d2, first, &distance2[found], &index[found]);
            if (found > kRoom) hand_over();
        };
        if (grid_.size() > 0)
            grid_.eights_within(p, radius, each);
        else
            tree_.eights_within(p, radius * radius, each);
        hand_over();
    }
    /// The k nearest photons that are nearer than max_radius, all of them if there are no more than that. Of photons at the same
    /// distance as the k-th it is not said which are in, but always the same.
    void nearest(Vec3 p, std::uint32_t k, float max_radius, NearestPhotons& out) const;

  private:
    static bool asks(Vec3 p, float radius) {
        return radius > 0.0f && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    }

    std::vector<Photon> photons_;  // in the order of the one of these that is made
    PhotonTree tree_;
    PhotonGrid grid_;
};

}  // namespace nephroid
