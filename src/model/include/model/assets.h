// What evaluating textures and materials needs beside the scene's own structs: compiled spectra and picture pyramids.
// Derived once when the world is compiled; lies beside the Scene, indexed by the same ids.
#pragma once

#include "image/pyramid.h"
#include "model/pictures.h"
#include "scene/scene.h"
#include "spectrum/runtime.h"

#include <memory>
#include <vector>

namespace nephroid {

class MeasuredTables;  // a measured material's file; see measured_tables.h

struct TextureData {
    RuntimeSpectrum spectrum;  // of a ConstantSpectrumTexture
    float value = 0;           // of a ConstantFloatTexture
    Transform mapping;         // world -> texture space, where the mapping has one
    Vec3 direction{0, 1, 0};   // of a DirectionMixTexture, unit
    bool flat = false;         // a constant: needs no coordinates
};
struct MaterialData {
    RuntimeSpectrum eta;                             // of a dielectric, thin or a coat
    RuntimeSpectrum absorption;                      // inside, 1 / length
    RuntimeSpectrum reflectance;                     // of a plain one
    std::shared_ptr<MeasuredTables const> measured;  // of a measured material; one of each file
    int priority = 0;                                // of its interior (scene/material.h)
    bool plain = false;  // diffuse and of one colour, on the surface as it is: nothing else has to be asked
    bool encloses = false;   // its interior has a priority or absorbs: paths have to know that they are in it
    bool textured = false;   // needs uv and tangents at the hit
    bool oriented = false;   // the shading frame's x axis matters
    bool perturbed = false;  // a normal map or bumps
    bool mix = false;        // has to be resolved at each hit …
    bool casts = false;      // may scatter (near-)specularly somewhere: throws caustics
    bool passes = false;  // … and some of its parts, or it itself, let light pass as if nothing were there
};

class Assets {
  public:
    Assets() = default;
    /// Compiles every spectrum and reads every picture. Throws Error with file:line. The scene must outlive this and stay put.
    explicit Assets(Scene const& scene);

    [[nodiscard]] Scene const& scene() const { return *scene_; }
    [[nodiscard]] TextureData const& data(TextureId id) const { return textures_[id.value]; }
    [[nodiscard]] MaterialData const& data(MaterialId id) const { return materials_[id.value]; }
    [[nodiscard]] Pyramid const& pyramid(ImageId id) const { return pictures_[id]; }
    /// White light of luminance 1 (D65): what turns an albedo into a colour.
    [[nodiscard]] RuntimeSpectrum const& neutral_illuminant() const { return neutral_; }
    SpectrumStore& spectra() { return spectra_; }
    /// Memory of the pictures, and how many files they are.
    [[nodiscard]] std::size_t image_bytes() const { return pictures_.bytes(); }
    [[nodiscard]] std::size_t image_files() const { return pictures_.files(); }
    /// Of spectra and of measured materials, which are spectra by direction.
    [[nodiscard]] std::size_t spectrum_bytes() const { return spectra_.bytes() + measured_bytes_; }

  private:
    Scene const* scene_ = nullptr;
    SpectrumStore spectra_;
    std::size_t measured_bytes_ = 0;
    RuntimeSpectrum neutral_;
    std::vector<TextureData> textures_;
    std::vector<MaterialData> materials_;
    Pictures pictures_;
};

}  // namespace nephroid
