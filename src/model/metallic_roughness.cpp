// From glTF's material to its scattering value: textures, units and ranges.
#include "make_bsdf.h"
#include "model/sheen.h"

namespace nephroid {

namespace {

/// alpha = roughness^2 along the facets' x axis, and that of anisotropy across: mix(alpha, 1, strength^2)
/// along the axis (KHR_materials_anisotropy).
Microfacets facets_of(float roughness, float strength, bool multiscatter) {
    Microfacets m;
    m.multiscatter = multiscatter;
    m.ay = sqr(roughness);
    m.ax = lerp(sqr(strength), m.ay, 1.0f);
    // Where one of the two is not smooth the other must not be a line.
    if (!m.smooth()) m.ay = max(m.ay, 1e-4f);
    return m;
}

/// The largest of a colour's r, g, b, whatever the path's wavelengths.
float top_of(MaterialPoint const& p, TextureId color, float otherwise) {
    if (!color.valid()) return otherwise;
    Spectrum const rgb = MaterialPoint::numbers(evaluate_spectrum(p.assets, color, p.at, Wavelengths::rgb()));
    return clamp(max(rgb[0], max(rgb[1], rgb[2])), 0.0f, kInfinity);
}

}  // namespace

void make(MetallicRoughnessMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    // A texture may hold anything.
    auto const share = [&](TextureId id, float otherwise) {
        return clamp(p.number(id, otherwise), 0.0f, 1.0f);
    };
    MetallicRoughnessBsdf& b = bsdf.emplace<MetallicRoughnessBsdf>();
    b.base_color = clamp(p.spectrum(m.base_color, Spectrum(1.0f)), 0.0f, 1.0f);
    b.metallic = share(m.metallic, 1.0f);
    b.transmission = share(m.transmission.factor, 0.0f);
    b.solid = !m.transmission.thin;
    b.facets = facets_of(share(m.roughness, 1.0f), share(m.anisotropy.strength, 0.0f), m.multiscatter);
    if (b.facets.ax != b.facets.ay) {
        b.axis_x = std::cos(m.anisotropy.rotation);
        b.axis_y = std::sin(m.anisotropy.rotation);
    }
    // ior 0 stands for infinity (KHR_materials_ior): F is 1 before colours, and nothing says how it would
    // bend light.
    float const ior = m.index.ior;
    float const r0 = sqr((ior - 1.0f) / (ior + 1.0f));
    b.f90 = share(m.specular.factor, 1.0f);
    b.f0 = clamp(p.spectrum(m.specular.color, Spectrum(1.0f)) * r0, 0.0f, 1.0f) * b.f90;
    b.f0_top = min(1.0f, top_of(p, m.specular.color, 1.0f) * r0) * b.f90;
    b.eta = ior < 1.0f ? 1.0f : ior;
    // The indices of the three lanes beside the hero's are not asked: they end here.
    if (b.solid && b.transmission > 0.0f && m.index.dispersion > 0.0f && ior > 1.0f && !p.lambda.is_rgb()) {
        b.eta = cauchy_index(ior, m.index.dispersion, p.lambda.lambda(0));
        b.dispersive = true;
    }
    b.clearcoat = share(m.clearcoat.factor, 0.0f);
    b.clearcoat_alpha = sqr(share(m.clearcoat.roughness, 0.0f));
    if (m.sheen.color.valid()) {
        b.sheen_color = clamp(p.spectrum(m.sheen.color, {}), 0.0f, 1.0f);
        b.sheen_top = min(1.0f, top_of(p, m.sheen.color, 0.0f));
        b.sheen_alpha = max(kSheenAlphaMin, sqr(share(m.sheen.roughness, 0.0f)));
    }
    if (p.lambda.is_rgb()) {
        // The fourth lane carries nothing, and must not steer choices.
        b.f0.set(3, 0.0f);
        b.base_color.set(3, 0.0f);
        b.sheen_color.set(3, 0.0f);
    }
}

}  // namespace nephroid
