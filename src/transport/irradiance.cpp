#include "irradiance.h"

namespace nephroid {

IrradianceMap::IrradianceMap(World const&, PhotonMap const&, EstimateRule const&, RayStats&) {}
std::size_t IrradianceMap::size() const { return 0; }
std::size_t IrradianceMap::bytes() const { return 0; }
Spectrum IrradianceMap::at(Vec3, Vec3) const { return {}; }

}  // namespace nephroid
