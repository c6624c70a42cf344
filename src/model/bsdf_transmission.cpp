// To be replaced by the model.
#include "make_bsdf.h"

namespace nephroid {

Spectrum evaluate(DiffuseTransmissionBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(DiffuseTransmissionBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(DiffuseTransmissionBsdf const&, Vec3, float, Vec2, Mode,
                                 HemisphereSampling) {
    return {};
}
Spectrum albedo(DiffuseTransmissionBsdf const&, Vec3) { return {}; }
void make(DiffuseTransmissionMaterial const&, MaterialPoint const&, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{Spectrum(0.5f)});
}

}  // namespace nephroid
