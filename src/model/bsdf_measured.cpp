// To be replaced by the model.
#include "make_bsdf.h"

namespace nephroid {

Spectrum evaluate(MeasuredBsdf const&, Vec3, Vec3, Mode) { return {}; }
float pdf(MeasuredBsdf const&, Vec3, Vec3, HemisphereSampling) { return 0; }
std::optional<BsdfSample> sample(MeasuredBsdf const&, Vec3, float, Vec2, Mode, HemisphereSampling) {
    return {};
}
Spectrum albedo(MeasuredBsdf const&, Vec3) { return {}; }
void make(MeasuredMaterial const&, MaterialPoint const&, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{Spectrum(0.5f)});
}

}  // namespace nephroid
