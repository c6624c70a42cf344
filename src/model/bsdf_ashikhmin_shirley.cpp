// Ashikhmin & Shirley 2000, "An Anisotropic Phong BRDF Model": a lobe about the half vector h, with an exponent along each
// tangent, over a diffuse base that gets what the lobe leaves. Equation numbers are the paper's; k1 = wo, k2 = wi.
//
// Energy: the lobe's f is F p(k2) / max(cos1, cos2), p being its own density (eq. 4), so its albedo is at most the mean of F.
// The base reflects R_d (1 - R_s) (1 - (1 - cos/2)^5) of the light from wo. Together they stay below 1 (measured in the tests).
#include "drawn.h"
#include "make_bsdf.h"
#include "sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

constexpr float kLargestExponent = 1e5f;

float power5(float x) { return sqr(sqr(x)) * x; }

/// Eq. 5's 1 - (1 - cos/2)^5: what the lobe above lets in, or out.
float passage(float cos_t) { return 1.0f - power5(1.0f - 0.5f * cos_t); }

/// Schlick's Fresnel factor.
Spectrum fresnel(AshikhminShirleyBsdf const& b, float cos_t) {
    return b.specular + (Spectrum(1.0f) - b.specular) * power5(1.0f - cos_t);
}

/// wo, wi and their half vector, turned so that all are above the surface.
struct Pair {
    Vec3 h;
    float cos1, cos2, k_dot_h;
};
std::optional<Pair> pair_of(Vec3 wo, Vec3 wi) {
    if (!same_hemisphere(wo, wi)) return std::nullopt;
    Vec3 const sum = wo + wi;
    float const size = length(sum);
    if (!(size > 0.0f)) return std::nullopt;
    // Of two unit vectors: the same from either side, to the last bit.
    float const k_dot_h = min(0.5f * size, 1.0f);
    return Pair{Vec3{sum.x, sum.y, std::abs(sum.z)} / size, abs_cos_theta(wo), abs_cos_theta(wi), k_dot_h};
}

/// Density of half vectors, eq. 6. The cosine is near 1 where exponents are large: its logarithm comes from the sine.
float half_vector_pdf(AshikhminShirleyBsdf const& b, Vec3 h) {
    float const x2 = sqr(h.x);
    float const y2 = sqr(h.y);
    float const s2 = x2 + y2;
    float const log_cos = s2 < 0.5f ? 0.5f * std::log1p(-s2) : std::log(h.z);
    float const exponent = s2 > 0.0f ? (b.nu * x2 + b.nv * y2) / s2 : 0.0f;
    return std::sqrt((b.nu + 1.0f) * (b.nv + 1.0f)) * kInvTwoPi * std::exp(exponent * log_cos);
}

/// Eq. 9 and 10. The square's x goes round the four quadrants, every other one backwards: a small step in u is one in h.
Vec3 sample_half_vector(AshikhminShirleyBsdf const& b, Vec2 u) {
    float const turn = 4.0f * u.x;
    int const quadrant = std::min(static_cast<int>(turn), 3);
    float part = turn - static_cast<float>(quadrant);
    if (quadrant % 2 == 1) part = 1.0f - part;
    // phi = atan(sqrt((nu+1)/(nv+1)) tan(pi part / 2)), by its sine and cosine: no tangent of a right angle.
    float const angle = kPiOver2 * part;
    float x = std::sqrt(b.nv + 1.0f) * max(std::cos(angle), 0.0f);
    float y = std::sqrt(b.nu + 1.0f) * std::sin(angle);
    float const r2 = sqr(x) + sqr(y);
    float const exponent = (b.nu * sqr(x) + b.nv * sqr(y)) / r2;
    float const log_cos = std::log1p(-u.y) / (exponent + 1.0f);
    // 1 - cos^2 without cancellation.
    float const scale = std::sqrt(-std::expm1(2.0f * log_cos) / r2);
    x *= quadrant == 1 || quadrant == 2 ? -scale : scale;
    y *= quadrant >= 2 ? -scale : scale;
    return {x, y, std::exp(log_cos)};
}

/// The chance that the base is drawn: its share of the light from wo, the lobe counted by its Fresnel factor there, and with at
/// least a tenth, for Schlick's factor rises above R_s where h is slanted. Of wo alone, so f stays reciprocal.
float base_chance(AshikhminShirleyBsdf const& b, float cos1) {
    float const base = (b.reflectance * (Spectrum(1.0f) - b.specular)).max() * passage(cos1);
    if (!(base > 0.0f)) return 0.0f;
    float const lobe = fresnel(b, cos1).max();
    return min(base / (base + lobe), 0.9f);
}

}  // namespace

Spectrum evaluate(AshikhminShirleyBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    auto const p = pair_of(wo, wi);
    if (!p) return {};
    // Eq. 4: the root over 8 pi is that of eq. 6 over 4.
    float const lobe = half_vector_pdf(b, p->h) / (4.0f * p->k_dot_h * max(p->cos1, p->cos2));
    // Eq. 5.
    float const base = 28.0f / (23.0f * kPi) * passage(p->cos1) * passage(p->cos2);
    Spectrum const f = lobe * fresnel(b, p->k_dot_h) + base * b.reflectance * (Spectrum(1.0f) - b.specular);
    // Both directions within the surface, opposite to each other: beyond the floats.
    return f.is_finite() ? f : Spectrum{};
}

float pdf(AshikhminShirleyBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    auto const p = pair_of(wo, wi);
    if (!p) return 0.0f;
    float const chance = base_chance(b, p->cos1);
    float const base =
        how == HemisphereSampling::Cosine ? cosine_hemisphere_pdf(p->cos2) : kUniformHemispherePdf;
    float const lobe = half_vector_pdf(b, p->h) / (4.0f * p->k_dot_h);  // of wi: by the mirror
    return chance * base + (1.0f - chance) * lobe;
}

std::optional<BsdfSample> sample(AshikhminShirleyBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    Vec3 const up{wo.x, wo.y, abs_cos_theta(wo)};
    Vec3 wi;
    if (uc < base_chance(b, up.z)) {
        wi = square_to_hemisphere(u, how);
    } else {
        Vec3 const h = sample_half_vector(b, u);
        wi = normalize(2.0f * dot(up, h) * h - up);
    }
    if (!(wi.z > 0.0f)) return result;  // the lobe's part below the surface is lost
    if (wo.z < 0.0f) wi.z = -wi.z;
    complete(result, b, wo, wi, mode, how);
    if (result && !std::isfinite(result->pdf)) result.reset();
    return result;
}

/// Of the base exactly; of the lobe, whose part below the surface is lost, the mean over 64 strata of its samples: within 0.04.
Spectrum albedo(AshikhminShirleyBsdf const& b, Vec3 wo) {
    constexpr int kSide = 8;
    Vec3 const up{wo.x, wo.y, abs_cos_theta(wo)};
    Spectrum lobe;
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y) {
            Vec3 const h = sample_half_vector(
                b, {(static_cast<float>(x) + 0.5f) / kSide, (static_cast<float>(y) + 0.5f) / kSide});
            float const k_dot_h = dot(up, h);
            float const cos2 = 2.0f * k_dot_h * h.z - up.z;
            if (!(cos2 > 0.0f && k_dot_h > 0.0f)) continue;
            lobe += fresnel(b, min(k_dot_h, 1.0f)) * (cos2 / max(cos2, up.z));  // f cos2 / p
        }
    return lobe / sqr(static_cast<float>(kSide)) +
           passage(up.z) * b.reflectance * (Spectrum(1.0f) - b.specular);
}

void make(AshikhminShirleyMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    // A texture may hold anything; max() makes 0 of what is no number.
    auto const exponent = [&](TextureId id) {
        return min(max(p.number(id, 100.0f), 0.0f), kLargestExponent);
    };
    bsdf.emplace<AshikhminShirleyBsdf>(AshikhminShirleyBsdf{clamp(p.spectrum(m.reflectance, {}), 0.0f, 1.0f),
                                                            clamp(p.spectrum(m.specular, {}), 0.0f, 1.0f),
                                                            exponent(m.nu), exponent(m.nv)});
}

}  // namespace nephroid
