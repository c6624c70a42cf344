// From one kind of material to its scattering value; each kind's function is in the file of its model.
#pragma once

#include "model/assets.h"
#include "model/bsdf.h"
#include "model/material.h"
#include "model/texture.h"

#include <cmath>

namespace nephroid {

/// A point of a surface where a material is asked what it is.
struct MaterialPoint {
    Assets const& assets;
    MaterialId id;
    TexturePoint const& at;
    Wavelengths const& lambda;

    [[nodiscard]] MaterialData const& data() const { return assets.data(id); }
    /// A float texture, or `otherwise` where there is none. Never NaN, which sums of infinities in textures can be: 0 then.
    [[nodiscard]] float number(TextureId texture, float otherwise) const {
        if (!texture.valid()) return otherwise;
        float const x = evaluate_float(assets, texture, at);
        return std::isnan(x) ? 0.0f : x;
    }
    /// A spectrum texture, or `otherwise` where there is none. Never NaN either.
    [[nodiscard]] Spectrum spectrum(TextureId texture, Spectrum otherwise) const {
        return texture.valid() ? numbers(evaluate_spectrum(assets, texture, at, lambda)) : otherwise;
    }
    static Spectrum numbers(Spectrum s) {
        if (!s.is_finite())
            for (int i = 0; i < 4; ++i)
                if (std::isnan(s[i])) s.set(i, 0.0f);
        return s;
    }
    /// Microfacets of a roughness.
    [[nodiscard]] Microfacets facets(Roughness const& r) const;
    [[nodiscard]] Spectrum index(RuntimeSpectrum const& eta) const { return index_lanes(eta, lambda); }
    /// The lanes' indices differ.
    [[nodiscard]] bool disperses(RuntimeSpectrum const& eta) const {
        return !lambda.is_rgb() && !eta.is_constant();
    }
};

void make(DiffuseMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(DielectricMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(ConductorMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(ThinDielectricMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(CoatedDiffuseMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(CoatedConductorMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(DiffuseTransmissionMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(MeasuredMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(AshikhminShirleyMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(PlasticMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);
void make(MetallicRoughnessMaterial const& m, MaterialPoint const& p, Bsdf& bsdf);

/// Complex index of a conductor by lane.
struct ComplexIndex {
    Spectrum eta, k;
};
ComplexIndex complex_index(ConductorMaterial const& m, MaterialPoint const& p);

}  // namespace nephroid
