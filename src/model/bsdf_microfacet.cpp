// To be replaced by the model.
#include "make_bsdf.h"

namespace nephroid {

Spectrum evaluate(RoughConductorBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(RoughConductorBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(RoughConductorBsdf const&, Vec3, float, Vec2, Mode, HemisphereSampling) {
    return {};
}
Spectrum albedo(RoughConductorBsdf const&, Vec3) { return {}; }
Spectrum evaluate(RoughDielectricBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(RoughDielectricBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(RoughDielectricBsdf const&, Vec3, float, Vec2, Mode, HemisphereSampling) {
    return {};
}
Spectrum albedo(RoughDielectricBsdf const&, Vec3) { return {}; }

}  // namespace nephroid
