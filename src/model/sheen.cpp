#include "model/sheen.h"

#include "sheen_fit.h"
#include "table_place.h"

#include <cmath>

namespace nephroid {

namespace {

float paper_albedo(float alpha, float mu) {
    float const least = std::sqrt(kSheenAlphaMin);
    TablePlace const rough{(std::sqrt(alpha) - least) / (1.0f - least), LayerAlbedos::kRough};
    return between(nephroid_layer_albedos.sheen, rough, TablePlace{std::sqrt(mu), LayerAlbedos::kAngles});
}

}  // namespace

float sheen_brdf(float alpha, Vec3 wo, Vec3 wi) {
    Vec3 const h = wo + wi;
    float const across2 = h.x * h.x + h.y * h.y;
    float const d = sheen_density(across2 / (across2 + h.z * h.z), alpha);
    float const shadowing = 1.0f + sheen_lambda(wo.z, alpha) + sheen_lambda(wi.z, alpha);
    float const f = d / (max(4.0f * wo.z * wi.z, 1e-30f) * shadowing);
    return f / (max(1.0f, paper_albedo(alpha, wo.z)) * max(1.0f, paper_albedo(alpha, wi.z)));
}

float sheen_albedo(float alpha, float mu) { return min(1.0f, paper_albedo(alpha, mu)); }

}  // namespace nephroid
