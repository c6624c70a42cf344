// Albedos of Schlick's microfacets, out of their tables.
#include "model/schlick.h"

#include "table_place.h"

#include <cmath>

namespace nephroid {

namespace {

using T = LayerAlbedos;

/// Roughnesses along and across, and where the anisotropic table has them.
struct Pair {
    TablePlace major, ratio;
};
Pair pair_of(Microfacets const& m) {
    return {{std::sqrt(m.ax), T::kMajor}, {std::sqrt(m.ay / m.ax), T::kRatio}};
}

}  // namespace

SchlickAlbedo schlick_albedo(float mu, float alpha) {
    if (alpha < 1e-3f) return {1.0f, schlick_weight(mu)};
    TablePlace const rough{std::sqrt(alpha), T::kRough};
    TablePlace const angle{std::sqrt(mu), T::kAngles};
    return {between(nephroid_layer_albedos.one, rough, angle),
            between(nephroid_layer_albedos.edge, rough, angle)};
}

SchlickAlbedo schlick_albedo(Microfacets const& m, Vec3 w) {
    if (m.ax == m.ay || m.smooth()) return schlick_albedo(w.z, m.ax);
    Pair const p = pair_of(m);
    TablePlace const turn{std::atan2(std::abs(w.y), std::abs(w.x)) / kPiOver2, T::kTurns};
    TablePlace const angle{std::sqrt(w.z), T::kFewAngles};
    return {between(nephroid_layer_albedos.anisotropic_one, p.major, p.ratio, turn, angle),
            between(nephroid_layer_albedos.anisotropic_edge, p.major, p.ratio, turn, angle)};
}

SchlickAlbedo schlick_mean(Microfacets const& m) {
    if (m.smooth()) return {1.0f, 1.0f / 21.0f};
    if (m.ax == m.ay) {
        TablePlace const rough{std::sqrt(m.ax), T::kRough};
        return {between(nephroid_layer_albedos.one_mean, rough),
                between(nephroid_layer_albedos.edge_mean, rough)};
    }
    Pair const p = pair_of(m);
    return {between(nephroid_layer_albedos.anisotropic_one_mean, p.major, p.ratio),
            between(nephroid_layer_albedos.anisotropic_edge_mean, p.major, p.ratio)};
}

namespace {

TablePlace index_place(SolidBoundary const& b) {
    constexpr float kLeast = 1.0f / T::kIndexMax;
    return {(1.0f / b.index - kLeast) / (1.0f - kLeast), T::kIndices};
}
float lost_of(SolidBoundary const& b, T::Solid const& s) {
    return clamp(1.0f - s.base - b.f0 * s.first - b.f90 * s.edge, 0.0f, 1.0f);
}

}  // namespace

float SolidBoundary::lost(float mu, bool inside) const {
    return lost_of(*this, between(nephroid_layer_albedos.solid[inside], index_place(*this),
                                  TablePlace{std::sqrt(alpha), T::kSolidRough},
                                  TablePlace{std::sqrt(mu), T::kFewAngles}));
}
float SolidBoundary::lost_mean(bool inside) const {
    return lost_of(*this, between(nephroid_layer_albedos.solid_mean[inside], index_place(*this),
                                  TablePlace{std::sqrt(alpha), T::kSolidRough}));
}
bool SolidBoundary::known() const { return index >= 1.0f && index <= T::kIndexMax; }

}  // namespace nephroid
