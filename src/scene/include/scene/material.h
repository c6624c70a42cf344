// Materials: what a surface does to light, as a scene describes it. Names and defaults are pbrt-v4's.
#pragma once

#include "scene/id.h"
#include "spectrum/spd.h"

#include <string>
#include <variant>

namespace nephroid {

/// Lambertian reflection, f = reflectance / pi.
struct DiffuseMaterial {
    TextureId reflectance;  // spectrum
};
/// Smooth boundary between air and a dielectric of index `eta` (inside, that is, opposite the normal, relative to outside).
struct DielectricMaterial {
    Spd eta = ConstantSpd{1.5f};
};
/// Smooth metal with complex index eta + i k; or, where `reflectance` is given, the k that makes a metal of eta = 1
/// reflect that much at normal incidence (pbrt-v4).
struct ConductorMaterial {
    TextureId eta, k;       // spectra
    TextureId reflectance;  // spectrum; wins when valid
};
/// Two parallel smooth boundaries so close that refraction does not shift the ray; all inner reflections are summed.
struct ThinDielectricMaterial {
    Spd eta = ConstantSpd{1.5f};
};
/// Only separates media: light passes as if nothing were there.
struct InterfaceMaterial {};
/// Chooses b with probability `amount`, else a.
struct MixMaterial {
    MaterialId a, b;
    TextureId amount;  // float
};

using MaterialKind = std::variant<DiffuseMaterial, DielectricMaterial, ConductorMaterial,
                                  ThinDielectricMaterial, InterfaceMaterial, MixMaterial>;

struct Material {
    MaterialKind kind;
    std::string name;  // of a named material, else empty
    SourceLocation where;
};

}  // namespace nephroid
