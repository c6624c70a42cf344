// A Lambertian base under a dielectric boundary (Wolff 1994, "Diffuse-Reflectance Model for Smooth Dielectric Surfaces", for the
// smooth one; the same with microfacets, as Mitsuba's roughplastic). Because the base forgets where light came from, the light that
// turns between the two is a geometric series, and the value is exact:
// f = boundary + t(wo) t(wi) / (eta^2 pi) * sum_n rho^n K^(n-1).
#include "diffuse_boundary.h"
#include "drawn.h"
#include "layer_boundary.h"
#include "make_bsdf.h"
#include "sampling/warp.h"

#include <algorithm>

namespace nephroid {

namespace {

/// rho + rho^2 K + … : what a base reflects of light that arrives at it, all turns counted.
Spectrum base_series(PlasticBsdf const& b, float k) {
    if (!b.nonlinear) return b.reflectance / (1.0f - k);
    Spectrum const turn = b.reflectance * k;
    Spectrum rest(1.0f);
    Spectrum missing;
    if (b.bounces > 0) {
        missing = Spectrum(1.0f);
        for (int i = 0; i < b.bounces; ++i) missing *= turn;
    }
    return b.reflectance * (rest - missing) / (rest - turn);
}

/// Albedos of the two parts, which choose between them.
struct Parts {
    Spectrum mirror, diffuse;
    [[nodiscard]] float mirror_probability() const {
        float const m = mirror.average();
        float const d = diffuse.average();
        return m + d > 0.0f ? m / (m + d) : 1.0f;
    }
};
Parts parts(PlasticBsdf const& b, float mu) {
    DiffuseBoundary const inner = diffuse_boundary(b.facets, b.eta, b.depth);
    return {b.specular * boundary_reflectance(b.facets, b.eta, mu),
            base_series(b, inner.back) * (boundary_transmittance(b.facets, b.eta, b.depth, mu) * inner.out)};
}

}  // namespace

Spectrum evaluate(PlasticBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    if (!same_hemisphere(wo, wi)) return {};
    float const through = boundary_transmittance(b.facets, b.eta, b.depth, abs_cos_theta(wo)) *
                          boundary_transmittance(b.facets, b.eta, b.depth, abs_cos_theta(wi));
    float const k = diffuse_boundary(b.facets, b.eta, b.depth).back;
    Spectrum const diffuse = base_series(b, k) * (through * kInvPi / sqr(b.eta));
    if (wo.z < 0.0f) {
        // The boundary of a coated surface looks the same from both sides.
        wo = -wo;
        wi = -wi;
    }
    return b.specular * LayerBoundary(b.eta, b.facets).f_reflect(wo, wi) + diffuse;
}

float pdf(PlasticBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    if (!same_hemisphere(wo, wi)) return 0.0f;
    float const p = parts(b, abs_cos_theta(wo)).mirror_probability();
    float const diffuse =
        how == HemisphereSampling::Cosine ? cosine_hemisphere_pdf(abs_cos_theta(wi)) : kUniformHemispherePdf;
    if (wo.z < 0.0f) {
        wo = -wo;
        wi = -wi;
    }
    return p * LayerBoundary(b.eta, b.facets).pdf_reflect(wo, wi) + (1.0f - p) * diffuse;
}

std::optional<BsdfSample> sample(PlasticBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    bool const below = wo.z < 0.0f;
    Vec3 const above = below ? -wo : wo;
    float const p = parts(b, above.z).mirror_probability();
    LayerBoundary const boundary(b.eta, b.facets);
    Vec3 wi;
    if (uc < p) {
        auto const step = boundary.reflect(above, u);
        if (!step) return result;
        wi = below ? -step->w : step->w;
        if (boundary.smooth()) {
            BsdfSample& s = result.emplace();
            s.wi = wi;
            s.f = b.specular * (step->weight / abs_cos_theta(wi));
            s.pdf = p;
            s.delta = true;
            return result;
        }
    } else {
        wi = square_to_hemisphere(u, how);
        if (below) wi = -wi;
    }
    complete(result, b, wo, wi, mode, how);
    return result;
}

DeltaBranches delta_branches(PlasticBsdf const& b, Vec3 wo, Mode) {
    if (!b.facets.smooth()) return {};
    return mirror_branch(b.specular * fresnel_dielectric(abs_cos_theta(wo), b.eta), wo);
}

Spectrum albedo(PlasticBsdf const& b, Vec3 wo) {
    Parts const a = parts(b, abs_cos_theta(wo));
    return a.mirror + a.diffuse;
}

void make(PlasticMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    RuntimeSpectrum const& eta = p.data().eta;
    PlasticBsdf b;
    b.reflectance = clamp(p.spectrum(m.reflectance, Spectrum(0.5f)), 0.0f, 1.0f);
    b.specular = clamp(p.spectrum(m.specular, Spectrum(1.0f)), 0.0f, 1.0f);
    b.eta = p.index(eta)[0];
    // A boundary between equal indices is none.
    if (b.eta != 1.0f) b.facets = p.facets(m.roughness);
    b.nonlinear = m.nonlinear;
    b.dispersive = p.disperses(eta);
    bsdf.emplace<PlasticBsdf>(b);
}

}  // namespace nephroid
