// What all scattering models share. Directions are in the local shading frame, normal +z; wo and wi point away from the
// surface. `evaluate` and `pdf` are by solid angle and leave out delta parts; f does not contain the cosine.
#pragma once

#include "model/adjoint.h"
#include "scene/match.h"
#include "scene/settings.h"
#include "spectrum/spectrum.h"

#include <concepts>
#include <optional>

namespace nephroid {

struct BsdfSample {
    Spectrum f;  // value; for a delta part the weight / |cos|, so that f |cos| / pdf is the throughput
    Vec3 wi{0, 0, 1};
    float pdf = 0;  // for a delta part the probability of having chosen it
    float eta = 1;  // n_transmitted / n_incident where it refracted
    bool delta = false;
    bool transmitted = false;
    bool keep_hero = false;     // the direction depends on the wavelength: only the hero lane may go on
    bool proportional = false;  // f / pdf is right, but the density of wi is what pdf() says, not `pdf`
};

/// What a walk has to know of a model before it asks. One byte, lest each model fill five.
struct BsdfTraits {
    bool delta : 1 = false;            // nothing but delta parts: no light can be sampled towards
    bool spreads_through : 1 = false;  // `evaluate` may be above 0 with wo and wi on different sides
    bool chooses : 1 = false;          // `sample` looks at uc
    bool hero_only : 1 = false;        // it holds for the hero lane alone: the others end here
    bool near_specular : 1 = false;  // nothing but delta and near-specular parts (Microfacets::near_specular)
};

/// The functions of one model, defined in its own file.
#define NEPHROID_BSDF(B)                                                               \
    Spectrum evaluate(B const& b, Vec3 wo, Vec3 wi, Mode mode);                        \
    float pdf(B const& b, Vec3 wo, Vec3 wi, HemisphereSampling how);                   \
    std::optional<BsdfSample> sample(B const& b, Vec3 wo, float uc, Vec2 u, Mode mode, \
                                     HemisphereSampling how);                          \
    Spectrum albedo(B const& b, Vec3 wo)

template <class B>
concept ScatteringModel = requires(B const& b, Vec3 w, float uc, Vec2 u, Mode m, HemisphereSampling how) {
    { traits(b) } -> std::same_as<BsdfTraits>;
    { evaluate(b, w, w, m) } -> std::same_as<Spectrum>;
    { pdf(b, w, w, how) } -> std::same_as<float>;
    { sample(b, w, uc, u, m, how) } -> std::same_as<std::optional<BsdfSample>>;
    { albedo(b, w) } -> std::same_as<Spectrum>;
};

}  // namespace nephroid
