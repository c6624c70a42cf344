#include "model/sheen.h"

#include "model/angle_table.h"

#include <cmath>

namespace nephroid {

namespace {

/// The fit's L(x) with its coefficients between a = 1 and a = 0 (Conty Estevez & Kulla 2017, section 2.2 and table 1).
float fitted(float x, float alpha) {
    float const t = sqr(1.0f - alpha);
    float const a = lerp(t, 21.5473f, 25.3245f);
    float const b = lerp(t, 3.82987f, 3.32435f);
    float const c = lerp(t, 0.19823f, 0.16801f);
    float const d = lerp(t, -1.97760f, -1.27393f);
    float const e = lerp(t, -4.32054f, -4.85967f);
    return a / (1.0f + b * std::pow(x, c)) + d * x + e;
}
/// Smith's Lambda.
float lambda(float mu, float alpha) {
    mu = clamp(mu, 0.0f, 1.0f);
    return mu < 0.5f ? std::exp(fitted(mu, alpha))
                     : std::exp(2.0f * fitted(0.5f, alpha) - fitted(1.0f - mu, alpha));
}
/// D of sin^2 of the half vector's angle.
float density(float sin2, float alpha) {
    return (2.0f + 1.0f / alpha) * std::pow(clamp(sin2, 0.0f, 1.0f), 0.5f / alpha) * kInvTwoPi;
}

/// The paper's albedo: midpoint rule, with cosines spaced as squares because all happens at the horizon.
float integrate(float mu, float alpha) {
    constexpr int kHeights = 32, kAzimuths = 24;
    float const lo = lambda(mu, alpha);
    float const so = safe_sqrt(1.0f - mu * mu);
    float sum = 0;
    for (int i = 0; i < kHeights; ++i) {
        float const x = (static_cast<float>(i) + 0.5f) / kHeights;
        float const z = x * x;
        float const si = safe_sqrt(1.0f - z * z);
        float d = 0;
        for (int k = 0; k < kAzimuths; ++k) {
            float const phi = kPi * (static_cast<float>(k) + 0.5f) / kAzimuths;
            float const across2 = so * so + si * si + 2.0f * so * si * std::cos(phi);
            d += density(across2 / (across2 + sqr(mu + z)), alpha);
        }
        // f cos = D G / (4 mu), dz = 2 x dx
        sum += d / kAzimuths * 2.0f * x / (4.0f * mu * (1.0f + lo + lambda(z, alpha)));
    }
    return kTwoPi * sum / kHeights;
}

AngleTable<float> const kTable(std::sqrt(kSheenAlphaMin),
                               [](float mu, float roughness) { return integrate(mu, sqr(roughness)); });
float paper_albedo(float alpha, float mu) { return kTable(mu, std::sqrt(alpha)); }

}  // namespace

float sheen_brdf(float alpha, Vec3 wo, Vec3 wi) {
    Vec3 const h = wo + wi;
    float const across2 = h.x * h.x + h.y * h.y;
    float const d = density(across2 / (across2 + h.z * h.z), alpha);
    float const f = d / (4.0f * wo.z * wi.z * (1.0f + lambda(wo.z, alpha) + lambda(wi.z, alpha)));
    return f / (max(1.0f, paper_albedo(alpha, wo.z)) * max(1.0f, paper_albedo(alpha, wi.z)));
}

float sheen_albedo(float alpha, float mu) { return min(1.0f, paper_albedo(alpha, mu)); }

}  // namespace nephroid
