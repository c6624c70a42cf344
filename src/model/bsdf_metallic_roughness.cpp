// glTF's layered surface: evaluation; what it is said to be stands in the header.
#include "model/bsdf_metallic_roughness.h"

#include "metallic_roughness_layers.h"

namespace nephroid {

namespace gltf {

namespace {

using B = MetallicRoughnessBsdf;

Spectrum reflected(View const& v, Vec3 wi) {
    B const& b = v.b;
    Vec3 const wm = normalize(v.wo + wi);
    float const c = dot(v.wo, wm);
    Spectrum specular;
    if (!b.facets.smooth()) specular = split(v, c).reflected * facet_brdf(b.facets, v.wo, wi, wm);
    if (SolidLoss::wanted(b)) specular += Spectrum(SolidLoss(b).value(v, wi) * b.transmitting() * kInvPi);
    if (v.inside) return specular + b.base_color * (b.diffusing() * kInvPi);

    Base const base(b);
    if (b.diffusing() > 0.0f || base.makes_up()) {
        BaseAlbedo const o = base.albedo(v.wo);
        BaseAlbedo const i = base.albedo(wi);
        if (b.diffusing() > 0.0f)
            specular += b.base_color * base.under_specular(o, i) * (b.diffusing() * kInvPi);
        if (base.makes_up()) specular += base.ms * (base.lost(o, i) * kInvPi);
    }
    Passed const p = passed(v, wi);
    Spectrum f = specular * p.both;
    if (b.has_sheen()) f += b.sheen_color * (p.coat * sheen_brdf(b.sheen_alpha, v.wo, wi));
    if (b.has_rough_coat())
        f += Spectrum(b.clearcoat * schlick(kCoatF0, 1.0f, schlick_weight(c)) *
                      facet_brdf(coat_facets(b), v.wo, wi, wm));
    return f;
}

Spectrum transmitted(View const& v, Vec3 wi, Mode mode) {
    B const& b = v.b;
    if (b.facets.smooth() || !(b.transmitting() > 0.0f) || b.unbent()) return {};
    Spectrum f;
    if (b.solid) {
        Facet const m = refracting_facet(v, wi);
        if (m.across_o > 0.0f) {
            // Walter et al. 2007, eq. 21; PBRT 4th ed., eq. 9.40.
            float const btdf = microfacet_d(b.facets, m.wm) * microfacet_g_over_cosines(b.facets, v.wo, wi) *
                               m.across_o * refraction_jacobian(m, v.eta);
            f = split(v, m.across_o).transmitted * btdf;
        }
        if (SolidLoss::wanted(b)) f += b.base_color * (SolidLoss(b).value(v, wi) * b.transmitting() * kInvPi);
        f *= refraction_scale(mode, v.eta);
    } else {
        // Two rough sides close together: as spread as reflection, on the other side.
        Vec3 const back = flipped(wi);
        Vec3 const wm = normalize(v.wo + back);
        f = split(v, dot(v.wo, wm)).transmitted * facet_brdf(b.facets, v.wo, back, wm);
        Base const base(b);
        if (base.makes_up()) {
            float const lost = base.lost(base.albedo(v.wo), base.albedo(back));
            f += b.base_color * (Spectrum(1.0f) - base.glass_ms) * (b.transmitting() * lost * kInvPi);
        }
    }
    return f * passed(v, wi).both;
}

}  // namespace

Spectrum value(View const& v, Vec3 wi, Mode mode) {
    return wi.z > 0.0f ? reflected(v, wi) : transmitted(v, wi, mode);
}

}  // namespace gltf

Spectrum evaluate(MetallicRoughnessBsdf const& b, Vec3 wo, Vec3 wi, Mode mode) {
    if (wo.z == 0.0f || wi.z == 0.0f) return {};
    gltf::View const v(b, wo);
    return gltf::value(v, v.to_local(wi), mode);
}

}  // namespace nephroid
