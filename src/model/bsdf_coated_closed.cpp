// A coated conductor without random walks. Light that met the base n times has a lobe of its own, which is wider the larger n
// (Belcour 2018, "Efficient Rendering of Layered Materials using an Atomic Decomposition with Statistical Operators"). Here there are
// two, for n = 1 and n >= 2: microfacets of a combined roughness (coat_lobe_alpha), between the directions as they are inside the coat,
//
//   L_n(wo, wi) = t(wo) t(wi) / eta^2 * D(wm) G(wo', wi') / (4 cos' cos'),
//
// and instead of the paper's statistics of energy a scale g(wo) g(wi), which leaves them reciprocal, from a table made such that
// the albedo of each is that of an exact calculation (tools/coat_table.cpp). For a smooth coat and n = 1 it is exact anyhow, and
// g = 1. Fresnel's factor F of the conductor is taken at each lobe's microfacet: f = F L_1 + F^2 (1 + r F + …) L_2.
#include "model/bsdf_coated_closed.h"

#include "coat_table.h"
#include "diffuse_boundary.h"
#include "layer_boundary.h"
#include "make_bsdf.h"
#include "sampling/warp.h"

#include <array>
#include <cmath>

namespace nephroid {

namespace {

float mean_alpha(Microfacets const& m) { return m.smooth() ? 0.0f : std::sqrt(m.ax * m.ay); }

/// All that does not depend on the second direction. Directions are above.
struct Coated {
    ClosedCoatedConductorBsdf const& b;
    float coat, base;
    LayerBoundary boundary;

    explicit Coated(ClosedCoatedConductorBsdf const& m)
        : b(m), coat(mean_alpha(m.coat)), base(mean_alpha(m.base)), boundary(m.coat_eta, m.coat) {}

    /// Microfacets of the lobe of n meetings.
    [[nodiscard]] Microfacets lobe(int n) const {
        auto const along = [&](float Microfacets::*a) {
            return coat_lobe_alpha(b.coat.smooth() ? 0.0f : b.coat.*a, b.base.smooth() ? 0.0f : b.base.*a,
                                   b.coat_eta, n);
        };
        return {.ax = along(&Microfacets::ax), .ay = along(&Microfacets::ay)};
    }
    [[nodiscard]] CoatTable::Lobes table(float mu) const { return coat_lobes(b.coat_eta, coat, base, mu); }
    /// F^2 (1 + rF + …), as many terms as there are meetings.
    [[nodiscard]] Spectrum later(Spectrum f, CoatTable::Lobes const& t) const {
        Spectrum const turn = f * (t.tail * std::exp(-b.depth * (t.way[1] - t.way[0])));
        Spectrum sum, term = f * f;
        for (int n = 2; n <= b.bounces; ++n) {
            sum += term;
            term *= turn;
            if (term.max() < 1e-5f) break;
        }
        return sum;
    }
};
/// The table for a pair of directions: means, and products of scales.
CoatTable::Lobes pair(CoatTable::Lobes const& a, CoatTable::Lobes const& b) {
    CoatTable::Lobes p = a;
    for (std::size_t n = 0; n < 2; ++n) {
        p.g[n] *= b.g[n];
        p.way[n] = 0.5f * (a.way[n] + b.way[n]);
        p.excess[n] = 0.5f * (a.excess[n] + b.excess[n]);
    }
    p.tail = 0.5f * (a.tail + b.tail);
    return p;
}
/// Fresnel's factor where Schlick's weight is higher by `excess`.
Spectrum slanting(Spectrum f, float excess) { return clamp(f + (Spectrum(1.0f) - f) * excess, 0.0f, 1.0f); }

/// Of both smooth: one direction, all turns summed.
Spectrum mirror(ClosedCoatedConductorBsdf const& b, float mu) {
    float const r = fresnel_dielectric(mu, b.coat_eta);
    float const inner = inside_coat({safe_sqrt(1.0f - mu * mu), 0, mu}, b.coat_eta).z;
    Spectrum const base = fresnel_conductor(inner, b.eta, b.k) * std::exp(-2.0f * b.depth / inner);
    Spectrum sum, term = base * sqr(1.0f - r);
    for (int n = 1; n <= b.bounces; ++n) {
        sum += term;
        term *= base * r;
    }
    return Spectrum(r) + sum;
}

/// What chooses among the coat's reflection, the first and the later lobe: their albedos.
struct Lobes {
    std::array<Spectrum, 3> albedo;
    std::array<float, 3> probability{1, 0, 0};
};
Lobes lobes(Coated const& c, float mu) {
    Lobes l;
    CoatTable::Lobes const t = c.table(mu);
    Spectrum const f = fresnel_conductor(1.0f, c.b.eta, c.b.k);
    l.albedo = {Spectrum(boundary_reflectance(c.b.coat, c.b.coat_eta, mu)),
                slanting(f, t.slant[0]) * (t.albedo[0] * std::exp(-c.b.depth * t.way[0])),
                c.later(slanting(f, t.slant[1]), t) * (t.albedo[1] * std::exp(-c.b.depth * t.way[1]))};
    float const sum = l.albedo[0].average() + l.albedo[1].average() + l.albedo[2].average();
    if (sum > 0.0f)
        for (std::size_t i = 0; i < 3; ++i) l.probability[i] = l.albedo[i].average() / sum;
    return l;
}

/// So wide that much of it would be drawn beyond the critical angle, in vain: it is drawn by the cosine outside.
bool wide(Microfacets const& m) { return max(m.ax, m.ay) > 0.5f; }
/// The density of a lobe by outer solid angle: dw' cos' = dw cos / eta^2.
float lobe_pdf(Coated const& c, Microfacets const& m, Vec3 in, Vec3 out, float outer_cosine) {
    if (wide(m)) return cosine_hemisphere_pdf(outer_cosine);
    Vec3 const sum = in + out;
    float const twice = length(sum);
    if (!(twice > 0.0f) || !(out.z > 0.0f)) return 0.0f;
    return microfacet_pdf(m, in, sum / twice) / (2.0f * twice) * outer_cosine / (sqr(c.b.coat_eta) * out.z);
}

}  // namespace

Spectrum evaluate(ClosedCoatedConductorBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    if (!same_hemisphere(wo, wi) || traits(b).delta) return {};
    if (wo.z < 0.0f) {
        wo = -wo;
        wi = -wi;
    }
    Coated const c(b);
    Spectrum f(c.boundary.f_reflect(wo, wi));
    Vec3 const in = inside_coat(wo, b.coat_eta);
    Vec3 const out = inside_coat(wi, b.coat_eta);
    if (!(in.z > 0.0f) || !(out.z > 0.0f)) return f;
    Vec3 const sum = in + out;
    float const twice = length(sum);  // the cosine that both have with wm
    Vec3 const wm = sum / twice;
    Spectrum const metal = fresnel_conductor(0.5f * twice, b.eta, b.k);
    CoatTable::Lobes const t = pair(c.table(wo.z), c.table(wi.z));
    float const common = coat_lobe_passing(wo.z, c.coat, b.coat_eta) *
                         coat_lobe_passing(wi.z, c.coat, b.coat_eta) / (4.0f * sqr(b.coat_eta));
    auto const shape = [&](std::size_t n) {
        Microfacets const m = c.lobe(static_cast<int>(n) + 1);
        return common * t.g[n] * std::exp(-b.depth * t.way[n]) * microfacet_d(m, wm) *
               microfacet_g_over_cosines(m, in, out);
    };
    return f + slanting(metal, t.excess[0]) * shape(0) + c.later(slanting(metal, t.excess[1]), t) * shape(1);
}

float pdf(ClosedCoatedConductorBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    if (!same_hemisphere(wo, wi) || traits(b).delta) return 0.0f;
    if (wo.z < 0.0f) {
        wo = -wo;
        wi = -wi;
    }
    Coated const c(b);
    Lobes const l = lobes(c, wo.z);
    Vec3 const in = inside_coat(wo, b.coat_eta);
    Vec3 const out = inside_coat(wi, b.coat_eta);
    return l.probability[0] * c.boundary.pdf_reflect(wo, wi) +
           l.probability[1] * lobe_pdf(c, c.lobe(1), in, out, wi.z) +
           l.probability[2] * lobe_pdf(c, c.lobe(2), in, out, wi.z);
}

std::optional<BsdfSample> sample(ClosedCoatedConductorBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    bool const below = wo.z < 0.0f;
    Vec3 const above = below ? -wo : wo;
    auto const delta = [&](Spectrum weight, float p) {
        BsdfSample& s = result.emplace();
        s.wi = {-wo.x, -wo.y, wo.z};
        s.f = weight / abs_cos_theta(wo);
        s.pdf = p;
        s.delta = true;
        return result;
    };
    if (traits(b).delta) return delta(mirror(b, above.z), 1.0f);
    Coated const c(b);
    Lobes const l = lobes(c, above.z);
    Vec3 wi;
    if (uc < l.probability[0]) {
        if (c.boundary.smooth())
            return delta(Spectrum(fresnel_dielectric(above.z, b.coat_eta)), l.probability[0]);
        auto const step = c.boundary.reflect(above, u);
        if (!step) return result;
        wi = step->w;
    } else {
        Microfacets const m = c.lobe(uc < l.probability[0] + l.probability[1] ? 1 : 2);
        if (wide(m)) {
            wi = square_to_cosine_hemisphere(u);
        } else {
            Vec3 const in = inside_coat(above, b.coat_eta);
            Vec3 const wm = sample_microfacet(m, in, u);
            Vec3 const out = wm * (2.0f * dot(in, wm)) - in;
            // Beyond the critical angle it stays inside; the table counts what becomes of it.
            Vec2 const across{out.x * b.coat_eta, out.y * b.coat_eta};
            float const sin2 = sqr(across.x) + sqr(across.y);
            if (!(out.z > 0.0f) || sin2 >= 1.0f) return result;
            wi = {across.x, across.y, std::sqrt(1.0f - sin2)};
        }
    }
    if (below) wi = -wi;
    float const density = pdf(b, wo, wi, how);
    if (!(density > 0.0f) || wi.z == 0.0f) return result;
    BsdfSample& s = result.emplace();
    s.wi = wi;
    s.pdf = density;
    s.f = evaluate(b, wo, wi, mode);
    return result;
}

DeltaBranches delta_branches(ClosedCoatedConductorBsdf const& b, Vec3 wo, Mode) {
    if (!b.coat.smooth()) return {};
    float const mu = abs_cos_theta(wo);
    return mirror_branch(traits(b).delta ? mirror(b, mu) : Spectrum(fresnel_dielectric(mu, b.coat_eta)), wo);
}

Spectrum albedo(ClosedCoatedConductorBsdf const& b, Vec3 wo) {
    float const mu = abs_cos_theta(wo);
    if (traits(b).delta) return mirror(b, mu);
    Lobes const l = lobes(Coated(b), mu);
    return l.albedo[0] + l.albedo[1] + l.albedo[2];
}

}  // namespace nephroid
