// To be replaced by the model.
#include "make_bsdf.h"

namespace nephroid {

Spectrum evaluate(CoatedDiffuseBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(CoatedDiffuseBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(CoatedDiffuseBsdf const&, Vec3, float, Vec2, Mode, HemisphereSampling) {
    return {};
}
Spectrum albedo(CoatedDiffuseBsdf const&, Vec3) { return {}; }
Spectrum evaluate(CoatedConductorBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(CoatedConductorBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(CoatedConductorBsdf const&, Vec3, float, Vec2, Mode, HemisphereSampling) {
    return {};
}
Spectrum albedo(CoatedConductorBsdf const&, Vec3) { return {}; }
void make(CoatedDiffuseMaterial const&, MaterialPoint const&, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{Spectrum(0.5f)});
}
void make(CoatedConductorMaterial const&, MaterialPoint const&, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{Spectrum(0.5f)});
}

}  // namespace nephroid
