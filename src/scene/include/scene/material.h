// Materials: what a surface does to light, as a scene describes it. Names and defaults are pbrt-v4's where it has the model.
// Texture ids may be none where that is said. Lengths (thickness, absorption) are in the scene's unit.
#pragma once

#include "scene/id.h"
#include "spectrum/spd.h"

#include <string>
#include <variant>

namespace nephroid {

/// How the normals of microfacets are spread.
enum class Distribution : std::uint8_t {
    TrowbridgeReitz,  // GGX, pbrt's
    Beckmann,
    Blinn  // a power of the cosine; roughness by the exponent n = 2 / alpha^2 - 2
};
/// A surface of microfacets; smooth where both roughnesses are none or (nearly) 0.
struct Roughness {
    TextureId u, v;     // float, along dp/du and dp/dv; v none = as u
    bool remap = true;  // alpha = sqrt(roughness) (pbrt), else alpha = roughness
    Distribution distribution = Distribution::TrowbridgeReitz;
    bool multiscatter = false;  // makes up for what microfacets reflect among themselves
};
/// What is inside a closed surface (opposite the normal).
struct Interior {
    Spd absorption = ConstantSpd{0};  // 1 / length; Beer's law
    // Where bodies overlap, the one of the highest priority is there (Schmidt & Budge 2002). 0: takes no part, its index is
    // relative to whatever is outside, as in pbrt.
    int priority = 0;
};

/// Lambertian reflection, f = reflectance / pi.
struct DiffuseMaterial {
    TextureId reflectance;  // spectrum
};
/// Boundary of a dielectric of index `eta` (inside, that is, opposite the normal, relative to outside).
struct DielectricMaterial {
    Spd eta = ConstantSpd{1.5f};
    Roughness roughness;
    Interior interior;
};
/// Metal with complex index eta + i k; or, where `reflectance` is given, the k that makes a metal of eta = 1
/// reflect that much at normal incidence (pbrt-v4).
struct ConductorMaterial {
    TextureId eta, k;       // spectra
    TextureId reflectance;  // spectrum; wins when valid
    Roughness roughness;
};
/// Two parallel smooth boundaries so close that refraction does not shift the ray; all inner reflections are summed.
struct ThinDielectricMaterial {
    Spd eta = ConstantSpd{1.5f};
};

/// How light between a coat and its base is followed.
enum class CoatModel : std::uint8_t {
    Automatic,   // closed form where it holds, else random walks
    Stochastic,  // random walks between the layers, as pbrt-v4
    ClosedForm
};
/// A dielectric layer over a base, perhaps with a scattering medium inside.
struct Coat {
    Spd eta = ConstantSpd{1.5f};
    Roughness roughness;
    TextureId thickness;  // float
    TextureId albedo;     // spectrum, of the medium; none = nothing is inside
    TextureId g;          // float, Henyey-Greenstein's asymmetry
    int max_depth = 10;   // boundaries that a walk meets
    int samples = 1;      // walks an evaluation
    CoatModel model = CoatModel::Automatic;
};
struct CoatedDiffuseMaterial {
    TextureId reflectance;  // spectrum
    Coat coat;
};
struct CoatedConductorMaterial {
    ConductorMaterial conductor;  // indices relative to vacuum: the coat's is divided out
    Coat coat;
};
/// Lambertian reflection and transmission.
struct DiffuseTransmissionMaterial {
    TextureId reflectance, transmittance;  // spectra
    float scale = 1;
};
/// A file as a scene names it; its contents belong to the scene.
struct DataFile {
    std::string path;
    SourceLocation where;
};
/// Measured isotropic or anisotropic reflection (Dupuy & Jakob 2018).
struct MeasuredMaterial {
    DataFile file;
};

/// Ashikhmin & Shirley 2000: an anisotropic Phong lobe over a diffuse base that gets what the lobe leaves.
struct AshikhminShirleyMaterial {
    TextureId reflectance, specular;  // spectra: R_d, and R_s at normal incidence
    TextureId nu, nv;                 // float exponents
};
/// A diffuse base under a dielectric boundary, in closed form; `nonlinear`: light that is reflected back inside takes on more
/// of the base's colour at each turn.
struct PlasticMaterial {
    TextureId reflectance;  // spectrum
    TextureId specular;     // spectrum, scales the boundary's reflection; none = 1
    Spd eta = ConstantSpd{1.5f};
    Roughness roughness;
    bool nonlinear = true;
};

/// glTF 2.0's metallic-roughness model with its KHR extensions.
struct MetallicRoughnessMaterial {
    struct Index {
        float ior = 1.5f;      // KHR_materials_ior
        float dispersion = 0;  // KHR_materials_dispersion: 20 / Abbe number
    };
    struct Specular {
        TextureId factor;  // float; none = 1
        TextureId color;   // spectrum; none = 1
    };
    struct Transmission {
        TextureId factor;   // float; none = 0
        bool thin = true;   // no volume behind the surface (KHR_materials_volume absent)
        Interior interior;  // KHR_materials_volume's attenuation
    };
    struct Clearcoat {
        TextureId factor, roughness;  // float; none = 0
    };
    struct Sheen {
        TextureId color;      // spectrum; none = 0
        TextureId roughness;  // float; none = 0
    };
    struct Anisotropy {
        TextureId strength;  // float; none = 0
        float rotation = 0;  // radians, from dp/du towards dp/dv
    };
    TextureId base_color;           // spectrum
    TextureId metallic, roughness;  // float; none = 1
    Index index;
    Specular specular;
    Transmission transmission;
    Clearcoat clearcoat;
    Sheen sheen;
    Anisotropy anisotropy;
    bool multiscatter = true;
};

/// Only separates media: light passes as if nothing were there.
struct InterfaceMaterial {};
/// Chooses b with probability `amount`, else a.
struct MixMaterial {
    MaterialId a, b;
    TextureId amount;  // float
};

using MaterialKind =
    std::variant<DiffuseMaterial, DielectricMaterial, ConductorMaterial, ThinDielectricMaterial,
                 InterfaceMaterial, MixMaterial, CoatedDiffuseMaterial, CoatedConductorMaterial,
                 DiffuseTransmissionMaterial, MeasuredMaterial, AshikhminShirleyMaterial, PlasticMaterial,
                 MetallicRoughnessMaterial>;

/// Normals as a picture gives them, in the frame of dp/du, dp/dv and the shading normal.
struct NormalMap {
    ImageId image;  // none: no map
    float scale = 1;
};

struct Material {
    MaterialKind kind;
    std::string name;  // of a named material, else empty
    SourceLocation where;
    TextureId displacement =
        {};  // float; none: no bumps. Moves the surface along its normal, as far as normals show it
    NormalMap normal_map = {};
};

}  // namespace nephroid
