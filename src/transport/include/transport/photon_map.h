// Photons in space, and who is near.
#pragma once

#include "transport/photon.h"
#include "transport/photon_tree.h"

#include <cstdint>
#include <vector>

namespace nephroid {

class PhotonMap {
  public:
    PhotonMap() = default;
    /// Takes the photons in any order, fewer than 2^32 of them; those at places that are not finite are left out. The map is the
    /// same on any number of threads. Runs in the caller's arena.
    explicit PhotonMap(std::vector<Photon> photons);

    [[nodiscard]] std::size_t size() const { return photons_.size(); }
    [[nodiscard]] bool empty() const { return photons_.empty(); }
    [[nodiscard]] Photon const& operator[](std::size_t i) const { return photons_[i]; }
    /// About 48 a photon: itself 32, its place once more 12, and its share of the nodes 3.4.
    [[nodiscard]] std::size_t bytes() const { return photons_.capacity() * sizeof(Photon) + tree_.bytes(); }

    /// Calls f(index, squared distance) for every photon nearer than `radius`. None is near a NaN.
    template <class F>
    void within(Vec3 p, float radius, F&& f) const {
        if (asks(p, radius)) tree_.within(p, radius * radius, f);
    }
    /// The k nearest photons that are nearer than max_radius, all of them if there are no more than that. Of photons at the same
    /// distance as the k-th it is not said which are in, but always the same.
    void nearest(Vec3 p, std::uint32_t k, float max_radius, NearestPhotons& out) const {
        tree_.nearest(p, asks(p, max_radius) ? k : 0, max_radius * max_radius, out);
    }

  private:
    static bool asks(Vec3 p, float radius) {
        return radius > 0.0f && !std::isnan(p.x) && !std::isnan(p.y) && !std::isnan(p.z);
    }

    std::vector<Photon> photons_;
    PhotonTree tree_;
};

}  // namespace nephroid
