// From one kind of material to its scattering value; each kind's function is in the file of its model.
#pragma once

#include "model/assets.h"
#include "model/bsdf.h"
#include "model/material.h"
#include "model/texture.h"

namespace nephroid {

/// A point of a surface where a material is asked what it is.
struct MaterialPoint {
    Assets const& assets;
    MaterialId id;
    TexturePoint const& at;
    Wavelengths const& lambda;

    [[nodiscard]] MaterialData const& data() const { return assets.data(id); }
    /// A float texture, or `otherwise` where there is none.
    [[nodiscard]] float number(TextureId texture, float otherwise) const {
        return texture.valid() ? evaluate_float(assets, texture, at) : otherwise;
    }
    /// A spectrum texture, or `otherwise` where there is none.
    [[nodiscard]] Spectrum spectrum(TextureId texture, Spectrum otherwise) const {
        return texture.valid() ? evaluate_spectrum(assets, texture, at, lambda) : otherwise;
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
