// Photons in space, and who is near.
#pragma once

#include "math/bounds.h"
#include "transport/photon.h"

#include <cstdint>
#include <vector>

namespace nephroid {

struct FoundPhoton {
    float distance2 = 0;
    std::uint32_t index = 0;  // into the map
};

/// Room for the answer of nearest(): made once, used for many queries.
class NearestPhotons {
  public:
    std::vector<FoundPhoton> found;  // in no order
};

class PhotonMap {
  public:
    PhotonMap() = default;
    /// Takes the photons in any order; the map is the same on any number of threads. Runs in the caller's arena.
    explicit PhotonMap(std::vector<Photon> photons);

    [[nodiscard]] std::size_t size() const { return photons_.size(); }
    [[nodiscard]] bool empty() const { return photons_.empty(); }
    [[nodiscard]] Photon const& operator[](std::size_t i) const { return photons_[i]; }
    [[nodiscard]] std::size_t bytes() const { return photons_.capacity() * sizeof(Photon); }

    /// Calls f(index, squared distance) for every photon nearer than `radius`.
    template <class F>
    void within(Vec3 p, float radius, F&& f) const {
        for (std::size_t i = 0; i < photons_.size(); ++i) {
            Vec3 const d = photons_[i].p() - p;
            float const d2 = dot(d, d);
            if (d2 < radius * radius) f(static_cast<std::uint32_t>(i), d2);
        }
    }
    /// The k nearest photons that are nearer than max_radius, all of them if there are no more than that. Of photons at the same
    /// distance as the k-th it is not said which are in.
    void nearest(Vec3 p, std::uint32_t k, float max_radius, NearestPhotons& out) const;

  private:
    std::vector<Photon> photons_;
};

}  // namespace nephroid
