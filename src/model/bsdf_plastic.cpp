// To be replaced by the model.
#include "make_bsdf.h"

namespace nephroid {

Spectrum evaluate(PlasticBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(PlasticBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(PlasticBsdf const&, Vec3, float, Vec2, Mode, HemisphereSampling) {
    return {};
}
Spectrum albedo(PlasticBsdf const&, Vec3) { return {}; }
void make(PlasticMaterial const&, MaterialPoint const&, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{Spectrum(0.5f)});
}

}  // namespace nephroid
