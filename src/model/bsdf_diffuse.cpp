// Lambert's law (PBRT 4th ed., 9.2).
#include "drawn.h"
#include "make_bsdf.h"

namespace nephroid {

std::optional<BsdfSample> sample(DiffuseBsdf const& b, Vec3 wo, float, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    // One object, built where the caller wants it: a copy right after it was written costs more than the rest.
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    Vec3 wi = square_to_hemisphere(u, how);
    if (wo.z < 0.0f) wi.z = -wi.z;
    complete(result, b, wo, wi, mode, how);
    return result;
}

void make(DiffuseMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    bsdf.emplace<DiffuseBsdf>(DiffuseBsdf{clamp(p.spectrum(m.reflectance, {}), 0.0f, 1.0f)});
}

}  // namespace nephroid
