// glTF's layered surface: sampling. One lobe is chosen by its albedo as wo sees it; the density is that of
// all together.
//
// The facets' lobe draws a normal wm first and then reflects or transmits by the Fresnel reflectance there,
// as PBRT 4th ed., 9.7.
#include "metallic_roughness_layers.h"
#include "model/fresnel.h"
#include "sampling/warp.h"

#include <array>

namespace nephroid {

namespace {

using namespace gltf;
using B = MetallicRoughnessBsdf;

// --- choosing ----------------------------------------------------------------------------------------------
enum Lobe : std::uint8_t {
    CoatLobe,
    // Sheen, and what makes up for multiple reflection: both are brightest at the horizon, where a cosine
    // draws too seldom.
    EvenLobe,
    FacetLobe,  // reflected or transmitted
    DiffuseLobe,
    ThroughLobe,  // what makes up for multiple reflection, on the other side
    UnbentLobe,   // straight on, through a solid of the outside's index
    kLobes
};
struct Chances {
    std::array<float, kLobes> p{};
};

/// What goes straight on where nothing bends: both sides see the same angle, and give the same.
Spectrum straight_share(View const& v) {
    Base const base(v.b);
    return (Spectrum(1.0f) - base.albedo(v.wo).specular) * v.b.base_color * v.b.transmitting();
}

/// Coat and base are mirrors: their reflections are one.
bool one_mirror(View const& v) {
    return v.b.clearcoat > 0.0f && v.b.facets.smooth() && !v.b.has_rough_coat() && !v.inside;
}

/// Shares of light from wo by lobe, from the albedos.
struct Shares {
    std::array<Spectrum, kLobes> s{};
    Spectrum sum;
};
/// What a solid's rough boundary makes up for.
void add_loss(View const& v, Spectrum below, std::array<Spectrum, kLobes>& s) {
    B const& b = v.b;
    if (!SolidLoss::wanted(b)) return;
    SolidLoss const loss(b);
    Spectrum const lost = below * (loss.boundary.lost(v.wo.z, v.inside) * b.transmitting());
    s[EvenLobe] += lost * (1.0f - loss.through[v.inside]);
    s[ThroughLobe] += lost * b.base_color * loss.through[v.inside];
}
Shares shares(View const& v) {
    B const& b = v.b;
    Shares r;
    auto& s = r.s;
    if (v.inside) {
        Split const macro = split(v, v.wo.z);
        s[FacetLobe] = macro.reflected + macro.transmitted;
        s[DiffuseLobe] = b.base_color * b.diffusing();
        if (b.unbent() && !b.facets.smooth()) {
            Base const base(b);
            SchlickAlbedo const one = base.albedo(v.wo).single;
            s[FacetLobe] = one.of(b.f0, Spectrum(b.f90)) * b.transmitting() +
                           one.of(b.base_color, Spectrum(1.0f)) * b.metallic;
            s[UnbentLobe] = straight_share(v);
        }
        add_loss(v, Spectrum(1.0f), s);
    } else {
        Base const base(b);
        BaseAlbedo const o = base.albedo(v.wo);
        Spectrum const past = past_sheen(b, v.wo.z);
        float const coat = coat_albedo(b, v.wo.z);
        Spectrum const below = past * (1.0f - coat);
        s[CoatLobe] = Spectrum(coat);
        if (b.has_sheen())
            s[EvenLobe] = b.sheen_color * (sheen_albedo(b.sheen_alpha, v.wo.z) * (1.0f - coat));
        Spectrum const f0 = b.f0 * (1.0f - b.metallic) + b.base_color * b.metallic;
        Spectrum const f90(b.f90 * (1.0f - b.metallic) + b.metallic);
        Spectrum const one(1.0f);
        Spectrum const through = b.base_color * b.transmitting();
        s[FacetLobe] = o.single.of(f0, f90);
        Spectrum const refracted =
            (Spectrum(o.single.one) - o.single.of(base.top, Spectrum(b.f90))) * through;
        s[DiffuseLobe] = b.base_color * b.diffusing() * (one - o.specular);
        if (base.makes_up()) {
            float const lost = 1.0f - o.single.one;
            s[EvenLobe] += base.ms * below * lost;
            if (!b.solid) s[ThroughLobe] = (one - base.glass_ms) * through * lost;
        }
        if (b.unbent() && !b.facets.smooth())
            s[UnbentLobe] = straight_share(v);
        else
            s[FacetLobe] += refracted;
        for (int const k : {FacetLobe, DiffuseLobe, ThroughLobe, UnbentLobe})
            s[static_cast<std::size_t>(k)] *= below;
        add_loss(v, below, s);
        if (one_mirror(v)) {
            s[FacetLobe] += s[CoatLobe];
            s[CoatLobe] = {};
        }
    }
    for (Spectrum const& x : s) r.sum += x;
    return r;
}
Chances chances(View const& v) {
    Shares const r = shares(v);
    Chances c;
    float sum = 0;
    for (std::size_t i = 0; i < kLobes; ++i) sum += c.p[i] = r.s[i].max();
    if (sum > 0.0f)
        for (float& p : c.p) p /= sum;
    return c;
}

/// How likely a smooth base's light is taken as reflected.
float mirror_probability(View const& v, Split s) {
    if (!one_mirror(v)) return reflect_probability(s);
    float const coat = coat_albedo(v.b, v.wo.z);
    s.reflected = s.reflected * (1.0f - coat) + Spectrum(coat);
    s.transmitted *= 1.0f - coat;
    return reflect_probability(s);
}

float hemisphere_pdf(float mu, HemisphereSampling how) {
    return how == HemisphereSampling::Cosine ? cosine_hemisphere_pdf(mu) : kUniformHemispherePdf;
}
Vec3 sample_hemisphere(Vec2 u, HemisphereSampling how) {
    return how == HemisphereSampling::Cosine ? square_to_cosine_hemisphere(u)
                                             : square_to_uniform_hemisphere(u);
}

/// The density of everything that is no delta part, wi in the facets' frame.
float density(View const& v, Chances const& c, Vec3 wi, HemisphereSampling how) {
    B const& b = v.b;
    bool const rough = !b.facets.smooth();
    if (wi.z > 0.0f) {
        float d = c.p[DiffuseLobe] * hemisphere_pdf(wi.z, how) + c.p[EvenLobe] * kUniformHemispherePdf;
        Vec3 const wm = normalize(v.wo + wi);
        float const across = dot(v.wo, wm);
        if (b.has_rough_coat() && c.p[CoatLobe] > 0.0f)
            d += c.p[CoatLobe] * microfacet_pdf(coat_facets(b), v.wo, wm) / (4.0f * across);
        if (rough && c.p[FacetLobe] > 0.0f) {
            Split s = split(v, across);
            if (b.unbent()) s.transmitted = {};
            d += c.p[FacetLobe] * reflect_probability(s) * microfacet_pdf(b.facets, v.wo, wm) /
                 (4.0f * across);
        }
        return d;
    }
    if (!rough || !(b.transmitting() > 0.0f) || b.unbent()) return 0.0f;
    if (!b.solid) {
        Vec3 const wm = normalize(v.wo + flipped(wi));
        float const across = dot(v.wo, wm);
        return c.p[ThroughLobe] * kUniformHemispherePdf +
               c.p[FacetLobe] * (1.0f - reflect_probability(split(v, across))) *
                   microfacet_pdf(b.facets, v.wo, wm) / (4.0f * across);
    }
    Facet const m = refracting_facet(v, wi);
    float const through = c.p[ThroughLobe] * kUniformHemispherePdf;
    if (!(m.across_o > 0.0f)) return through;
    return through + c.p[FacetLobe] * (1.0f - reflect_probability(split(v, m.across_o))) *
                         microfacet_pdf(b.facets, v.wo, m.wm) * refraction_jacobian(m, v.eta);
}

// --- delta parts -------------------------------------------------------------------------------------------
BsdfSample delta(View const& v, Spectrum weight, Vec3 wi, float probability) {
    BsdfSample s;
    s.wi = v.from_local(wi);
    s.f = weight / abs_cos_theta(wi);
    s.pdf = probability;
    s.delta = true;
    s.transmitted = wi.z < 0.0f;
    return s;
}
BsdfSample coat_mirror(View const& v, float probability) {
    return delta(v, Spectrum(coat_albedo(v.b, v.wo.z)), mirrored(v.wo), probability);
}
BsdfSample base_mirror(View const& v, Split const& s, float probability) {
    Vec3 const wi = mirrored(v.wo);
    Spectrum weight = s.reflected * passed(v, wi).both;
    if (one_mirror(v)) weight += Spectrum(coat_albedo(v.b, v.wo.z));
    return delta(v, weight, wi, probability);
}
std::optional<BsdfSample> base_window(View const& v, Split const& s, float probability, Mode mode) {
    Vec3 wi = -v.wo;
    float eta = v.eta;
    if (v.b.solid && !refract(v.wo, eta, wi)) return std::nullopt;
    if (wi.z == 0.0f) return std::nullopt;
    BsdfSample r =
        delta(v, s.transmitted * passed(v, wi).both * refraction_scale(mode, eta), wi, probability);
    r.eta = eta;
    r.keep_hero = v.b.dispersive;
    return r;
}
BsdfSample straight_on(View const& v, float probability, Mode mode) {
    Vec3 const wi = -v.wo;
    BsdfSample r =
        delta(v, straight_share(v) * passed(v, wi).both * refraction_scale(mode, v.eta), wi, probability);
    r.eta = v.eta;
    r.keep_hero = v.b.dispersive;
    return r;
}

}  // namespace

float pdf(B const& b, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    if (wo.z == 0.0f || wi.z == 0.0f) return 0.0f;
    View const v(b, wo);
    return density(v, chances(v), v.to_local(wi), how);
}

std::optional<BsdfSample> sample(B const& b, Vec3 wo, float uc, Vec2 u, Mode mode, HemisphereSampling how) {
    if (wo.z == 0.0f) return std::nullopt;
    View const v(b, wo);
    Chances const c = chances(v);
    std::size_t lobe = 0;
    float below = 0;
    std::size_t last = kLobes;
    for (std::size_t i = 0; i < kLobes; ++i) {
        if (!(c.p[i] > 0.0f)) continue;
        last = i;
        if (uc < below + c.p[i]) break;
        below += c.p[i];
    }
    if (last == kLobes) return std::nullopt;  // black
    lobe = last;
    float const p = c.p[lobe];
    float const rest = clamp((uc - below) / p, 0.0f, kOneMinusEpsilon);

    Vec3 wi{0, 0, 0};
    float eta = 1;
    switch (lobe) {
        case CoatLobe: {
            if (!b.has_rough_coat()) return coat_mirror(v, p);
            Vec3 const wm = sample_microfacet(coat_facets(b), v.wo, u);
            wi = wm * (2.0f * dot(v.wo, wm)) - v.wo;
            if (!(wi.z > 0.0f)) return std::nullopt;
            break;
        }
        case EvenLobe:
            wi = square_to_uniform_hemisphere(u);
            break;
        case DiffuseLobe:
            wi = sample_hemisphere(u, how);
            break;
        case ThroughLobe:
            wi = flipped(square_to_uniform_hemisphere(u));
            eta = v.eta;
            break;
        case UnbentLobe:
            return straight_on(v, p, mode);
        default: {
            bool const smooth = b.facets.smooth();
            Vec3 const wm = smooth ? Vec3{0, 0, 1} : sample_microfacet(b.facets, v.wo, u);
            float const across = dot(v.wo, wm);
            Split s = split(v, across);
            if (b.unbent() && !smooth) s.transmitted = {};
            float const q = smooth ? mirror_probability(v, s) : reflect_probability(s);
            bool const reflects = rest < q;
            if (smooth && reflects) return base_mirror(v, s, p * q);
            if (smooth) return base_window(v, s, p * (1.0f - q), mode);
            if (reflects || !b.solid) {
                wi = wm * (2.0f * across) - v.wo;
                if (!(wi.z > 0.0f)) return std::nullopt;
                if (!reflects) wi = flipped(wi);
            } else {
                // Refraction about wm: seen from it, wo is (across, the part along the facet).
                eta = v.eta;
                float const sin2_t = max(0.0f, 1.0f - sqr(across)) / sqr(eta);
                if (sin2_t >= 1.0f) return std::nullopt;
                float const cos_t = std::sqrt(1.0f - sin2_t);
                wi = normalize(v.wo * (-1.0f / eta) + wm * (across / eta - cos_t));
                if (!(wi.z < 0.0f)) return std::nullopt;
            }
        }
    }
    if (wi.z == 0.0f) return std::nullopt;
    BsdfSample s;
    s.pdf = density(v, c, wi, how);
    if (!(s.pdf > 0.0f)) return std::nullopt;
    s.f = value(v, wi, mode);
    s.wi = v.from_local(wi);
    s.transmitted = wi.z < 0.0f;
    s.eta = eta;
    s.keep_hero = s.transmitted && b.dispersive;
    return s;
}

Spectrum albedo(B const& b, Vec3 wo) {
    if (wo.z == 0.0f) return {};
    return shares(View(b, wo)).sum;
}

DeltaBranches delta_branches(B const& b, Vec3 wo, Mode mode) {
    if (wo.z == 0.0f) return {};
    View const v(b, wo);
    DeltaBranches r;
    if (!b.facets.smooth() && b.clearcoat > 0.0f && !b.has_rough_coat() && !v.inside)
        r.reflected = coat_mirror(v, 1.0f);
    if (b.facets.smooth()) {
        Split const s = split(v, v.wo.z);
        r.reflected = base_mirror(v, s, 1.0f);
        if (!s.transmitted.is_black()) r.transmitted = base_window(v, s, 1.0f, mode);
    } else if (b.unbent() && b.transmitting() > 0.0f) {
        r.transmitted = straight_on(v, 1.0f, mode);
    }
    return r;
}

}  // namespace nephroid
