// Irradiance, precomputed at photons (Christensen 1999, "Faster Photon Map Global Illumination"): a gather ray then looks up one number
// instead of estimating.
#pragma once

#include "density.h"

namespace nephroid {

class IrradianceMap {
  public:
    IrradianceMap() = default;
    /// At every fourth photon of the map, in whose order neighbours follow each other. Runs in the caller's arena; the same on any
    /// number of threads.
    IrradianceMap(World const& world, PhotonMap const& map, EstimateRule const& rule, RayStats& stats);

    [[nodiscard]] std::size_t size() const { return places_.size(); }
    [[nodiscard]] std::size_t bytes() const { return places_.bytes(); }
    /// The mean radius of the estimates that it was made by.
    [[nodiscard]] float typical_radius() const { return typical_radius_; }
    /// W/m^2 (per nm) at the nearest place on a surface that faces like n, no farther than the rule's radius; black where there is none.
    [[nodiscard]] Spectrum at(Vec3 p, Vec3 n, NearestPhotons& nearest) const;

  private:
    PhotonMap places_;  // "photons" whose power is the irradiance
    float radius_ = 0, typical_radius_ = 0;
};

}  // namespace nephroid
