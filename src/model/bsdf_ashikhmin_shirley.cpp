// To be replaced by the model.
#include "make_bsdf.h"

namespace nephroid {

Spectrum evaluate(AshikhminShirleyBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(AshikhminShirleyBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(AshikhminShirleyBsdf const&, Vec3, float, Vec2, Mode, HemisphereSampling) {
    return {};
}
Spectrum albedo(AshikhminShirleyBsdf const&, Vec3) { return {}; }
void make(AshikhminShirleyMaterial const&, MaterialPoint const&, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{Spectrum(0.5f)});
}

}  // namespace nephroid
