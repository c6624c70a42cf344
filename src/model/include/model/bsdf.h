// Scattering at a point: small values in the local shading frame, normal +z; wo and wi point away from the surface.
// `evaluate` and `pdf` are by solid angle and leave out delta parts; f does not contain the cosine.
//
// Radiance or importance (Veach 1997, 5.2): refraction scales radiance by (n_i/n_t)^2; importance it leaves alone. Mode says
// what is carried along the path that is being built from wo to wi.
#pragma once

#include "math/frame.h"
#include "model/fresnel.h"
#include "scene/match.h"
#include "scene/settings.h"
#include "spectrum/spectrum.h"

#include <optional>
#include <variant>

namespace nephroid {

enum class Mode : std::uint8_t { Radiance, Importance };

struct BsdfSample {
    Spectrum f;  // value; for a delta part the weight / |cos|, so that f |cos| / pdf is the throughput
    Vec3 wi{0, 0, 1};
    float pdf = 0;  // for a delta part the probability of having chosen it
    float eta = 1;  // n_transmitted / n_incident where it refracted
    bool delta = false;
    bool transmitted = false;
    bool keep_hero = false;  // the direction depends on the wavelength: only the hero lane may go on
};

/// Lambertian reflection on the side(s) where both directions lie together.
struct DiffuseBsdf {
    Spectrum reflectance;
};
/// Smooth dielectric boundary, eta = n_inside / n_outside; lanes differ where it is dispersive.
struct DielectricBsdf {
    Spectrum eta;
    bool dispersive = false;
};
struct ThinDielectricBsdf {
    Spectrum eta;
};
/// Smooth conductor, eta + i k relative to outside.
struct ConductorBsdf {
    Spectrum eta, k;
};

using Bsdf = std::variant<DiffuseBsdf, DielectricBsdf, ThinDielectricBsdf, ConductorBsdf>;
static_assert(sizeof(Bsdf) <= 48, "a Bsdf is copied at every hit: keep it small");

// --- diffuse ----------------------------------------------------------------------------------------------------------
inline bool is_delta(DiffuseBsdf const&) { return false; }
inline Spectrum evaluate(DiffuseBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    return same_hemisphere(wo, wi) ? b.reflectance * kInvPi : Spectrum{};
}
float pdf(DiffuseBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling how);
std::optional<BsdfSample> sample(DiffuseBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how);
inline Spectrum albedo(DiffuseBsdf const& b, Vec3) { return b.reflectance; }
inline bool spreads_through(DiffuseBsdf const&) { return false; }

// --- the smooth ones: nothing but delta parts ----------------------------------------------------------------------------
#define NEPHROID_DELTA_BSDF(B)                                                         \
    inline bool is_delta(B const&) { return true; }                                    \
    inline bool spreads_through(B const&) { return false; }                            \
    inline Spectrum evaluate(B const&, Vec3, Vec3, Mode) { return {}; }                \
    inline float pdf(B const&, Vec3, Vec3, HemisphereSampling) { return 0.0f; }        \
    std::optional<BsdfSample> sample(B const& b, Vec3 wo, float uc, Vec2 u, Mode mode, \
                                     HemisphereSampling how);                          \
    Spectrum albedo(B const& b, Vec3 wo);
NEPHROID_DELTA_BSDF(DielectricBsdf)
NEPHROID_DELTA_BSDF(ThinDielectricBsdf)
NEPHROID_DELTA_BSDF(ConductorBsdf)
#undef NEPHROID_DELTA_BSDF

template <class B>
concept ScatteringModel = requires(B const& b, Vec3 w, float uc, Vec2 u, Mode m, HemisphereSampling how) {
    { is_delta(b) } -> std::same_as<bool>;
    { spreads_through(b) } -> std::same_as<bool>;
    { evaluate(b, w, w, m) } -> std::same_as<Spectrum>;
    { pdf(b, w, w, how) } -> std::same_as<float>;
    { sample(b, w, uc, u, m, how) } -> std::same_as<std::optional<BsdfSample>>;
    { albedo(b, w) } -> std::same_as<Spectrum>;
};
static_assert(ScatteringModel<DiffuseBsdf>);
static_assert(ScatteringModel<DielectricBsdf>);
static_assert(ScatteringModel<ThinDielectricBsdf>);
static_assert(ScatteringModel<ConductorBsdf>);

// --- the sum ----------------------------------------------------------------------------------------------------------
/// Nothing but delta parts: no light can be sampled towards.
inline bool is_delta(Bsdf const& bsdf) {
    return match(bsdf, [](auto const& b) { return is_delta(b); });
}
/// `evaluate` may be above 0 with wo and wi on different sides.
inline bool spreads_through(Bsdf const& bsdf) {
    return match(bsdf, [](auto const& b) { return spreads_through(b); });
}
inline Spectrum evaluate(Bsdf const& bsdf, Vec3 wo, Vec3 wi, Mode mode) {
    return match(bsdf, [&](auto const& b) { return evaluate(b, wo, wi, mode); });
}
inline float pdf(Bsdf const& bsdf, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    return match(bsdf, [&](auto const& b) { return pdf(b, wo, wi, how); });
}
/// uc chooses among parts, u a direction. Nothing where no light is scattered.
inline std::optional<BsdfSample> sample(Bsdf const& bsdf, Vec3 wo, float uc, Vec2 u, Mode mode,
                                        HemisphereSampling how) {
    return match(bsdf, [&](auto const& b) { return sample(b, wo, uc, u, mode, how); });
}
/// Directional albedo: what part of light from wo is scattered at all.
inline Spectrum albedo(Bsdf const& bsdf, Vec3 wo) {
    return match(bsdf, [&](auto const& b) { return albedo(b, wo); });
}

/// The two deterministic branches of a smooth surface, for Whitted's tree.
struct DeltaBranches {
    std::optional<BsdfSample> reflected, transmitted;  // pdf = 1 each
};
DeltaBranches delta_branches(Bsdf const& bsdf, Vec3 wo, Mode mode);

}  // namespace nephroid
