// Irradiance, precomputed at photons (Christensen 1999, "Faster Photon Map Global Illumination"): a gather ray then looks up one number
// instead of estimating.
#pragma once

#include "density.h"

#include <optional>

namespace nephroid {

class IrradianceMap {
  public:
    IrradianceMap() = default;
    /// At every fourth photon of the map. Runs in the caller's arena; the same on any number of threads.
    IrradianceMap(World const& world, PhotonMap const& map, EstimateRule const& rule, RayStats& stats);

    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] std::size_t bytes() const;
    /// The mean radius of the estimates that it was made by.
    [[nodiscard]] float typical_radius() const { return 0; }
    /// Irradiance at the nearest place on a surface that faces like n, no farther than the rule's radius; nothing there is black.
    [[nodiscard]] Spectrum at(Vec3 p, Vec3 n) const;
};

}  // namespace nephroid
