// Spectra, textures and materials.
#include "check.h"
#include "scene/match.h"

namespace nephroid {

void check_spd(Check const& c, Spd const& spd, char const* what) {
    check_finite(c, spd, what);
    match(
        spd,
        [&](TabulatedSpd const& t) {
            c.require(!t.lambda.empty(), "the tabulated spectrum is empty: give wavelengths and values");
            c.require(t.lambda.size() == t.value.size(),
                      "the tabulated spectrum needs as many values as wavelengths");
            for (std::size_t i = 1; i < t.lambda.size(); ++i)
                c.require(t.lambda[i - 1] < t.lambda[i],
                          "the wavelengths of a tabulated spectrum must increase");
        },
        [&](BlackbodySpd const& b) {
            c.require(b.kelvin > 0, "a black body's temperature must be above 0 K");
        },
        [&](NamedSpd const& n) { c.require(!n.name.empty(), "a spectrum's name is empty: name one"); },
        [](auto const&) {});
}

namespace {

void check_mapping(Check const& c, TextureMapping const& mapping) {
    check_finite(c, mapping, "the texture's mapping");
    match(
        mapping, [](UvMapping const&) {},
        [&](auto const& m) { check_matrix(c, m.world_to_texture, "the texture's transform"); });
}

void check_index(Check const& c, Spd const& eta) {
    check_spd(c, eta, "the index of refraction");
    // Beyond, Fresnel's formulas leave the floats; no dielectric is near either end.
    constexpr float kLeast = 1e-3f, kMost = 1e3f;
    auto const check = [&](float index) {
        c.require(index > 0, "the index of refraction must be above 0 at every wavelength (glass: 1.5)");
        c.require(index >= kLeast && index <= kMost,
                  "the index of refraction must be between 0.001 and 1000 (glass: 1.5)");
    };
    auto const check_rgb = [&](auto const& s) { check(s.rgb.x), check(s.rgb.y), check(s.rgb.z); };
    match(
        eta, [&](ConstantSpd const& s) { check(s.value); },
        [&](TabulatedSpd const& s) {
            for (float const value : s.value) check(value);
        },
        [&](RgbAlbedoSpd const& s) { check_rgb(s); }, [&](RgbUnboundedSpd const& s) { check_rgb(s); },
        [&](RgbIlluminantSpd const& s) { check_rgb(s); }, [](BlackbodySpd const&) {}, [](NamedSpd const&) {});
}

void check_interior(Check const& c, Interior const& inside) {
    check_spd(c, inside.absorption, "the absorption");
    bool negative = false;
    match(
        inside.absorption, [&](ConstantSpd const& s) { negative = s.value < 0; },
        [&](TabulatedSpd const& s) {
            for (float const value : s.value) negative = negative || value < 0;
        },
        [&](RgbUnboundedSpd const& s) { negative = s.rgb.x < 0 || s.rgb.y < 0 || s.rgb.z < 0; },
        [](auto const&) {});
    c.require(!negative, "the absorption must not be negative");
    c.require(inside.priority >= 0, "the priority of an interior must not be negative");
}

void check_conductor(Check const& c, ConductorMaterial const& m) {
    c.require(m.reflectance.valid() || (m.eta.valid() && m.k.valid()),
              "the conductor needs a reflectance, or eta and k: name textures for them");
}

void check_coat(Check const& c, Coat const& coat) {
    check_index(c, coat.eta);
    c.require(coat.max_depth >= 1 && coat.max_depth <= 255, "the coat's depth must be between 1 and 255");
    c.require(coat.samples >= 1 && coat.samples <= 255, "the coat's samples must be between 1 and 255");
}

}  // namespace

void check_texture(Check const& c, Texture const& texture) {
    check_ids(c, texture.kind, "the texture");
    auto const operand = [&](TextureId id) {
        c.require(id.valid(), "the texture is made of others but names none: name them");
    };
    auto const noise = [&](auto const& t) {
        check_finite(c, t, "the texture");
        check_matrix(c, t.world_to_texture, "the texture's transform");
        c.require(t.octaves >= 0 && t.octaves <= kMaxOctaves, "the texture's octaves must be 0 to 64");
    };
    match(
        texture.kind, [&](ConstantFloatTexture const& t) { check_finite(c, t, "the texture"); },
        [&](ConstantSpectrumTexture const& t) { check_spd(c, t.value, "the texture"); },
        [&](ImageTexture const& t) {
            c.require(t.image.valid(), "the image texture names no picture: name one");
            check_finite(c, t.scale, "the texture's scale");
            c.require(t.max_anisotropy >= 1, "the texture's maxanisotropy must be at least 1");
            check_mapping(c, t.mapping);
        },
        [&](CheckerboardTexture const& t) {
            c.require(t.dimension == 2 || t.dimension == 3, "a checkerboard has 2 or 3 dimensions");
            check_mapping(c, t.mapping);
            check_matrix(c, t.world_to_texture, "the texture's transform");
            operand(t.tex1), operand(t.tex2);
        },
        [&](ScaleTexture const& t) { operand(t.tex), operand(t.scale); },
        [&](MixTexture const& t) { operand(t.tex1), operand(t.tex2), operand(t.amount); },
        [&](DirectionMixTexture const& t) {
            operand(t.tex1), operand(t.tex2);
            check_finite(c, t.dir, "the texture's direction");
            c.require(t.dir != Vec3{0}, "the texture's direction has no length: give it one");
        },
        [&](BilerpTexture const& t) {
            check_mapping(c, t.mapping);
            operand(t.v00), operand(t.v01), operand(t.v10), operand(t.v11);
        },
        [&](DotsTexture const& t) {
            check_mapping(c, t.mapping);
            operand(t.inside), operand(t.outside);
        },
        [&](WindyTexture const& t) { check_matrix(c, t.world_to_texture, "the texture's transform"); },
        [&](FbmTexture const& t) { noise(t); }, [&](WrinkledTexture const& t) { noise(t); },
        [&](MarbleTexture const& t) { noise(t); });
}

void check_material(Check const& c, Material const& material) {
    check_ids(c, material, "the material");
    match(
        material.kind,
        [&](DiffuseMaterial const& m) {
            c.require(m.reflectance.valid(), "the diffuse material names no reflectance: name a texture");
        },
        [&](ConductorMaterial const& m) { check_conductor(c, m); },
        [&](DielectricMaterial const& m) {
            check_index(c, m.eta);
            check_interior(c, m.interior);
        },
        [&](ThinDielectricMaterial const& m) { check_index(c, m.eta); },
        [&](CoatedDiffuseMaterial const& m) {
            c.require(m.reflectance.valid(), "the coated base names no reflectance: name a texture");
            check_coat(c, m.coat);
        },
        [&](CoatedConductorMaterial const& m) {
            check_conductor(c, m.conductor);
            check_coat(c, m.coat);
        },
        [&](DiffuseTransmissionMaterial const& m) {
            c.require(m.reflectance.valid() && m.transmittance.valid(),
                      "the material names no reflectance or no transmittance: name textures for both");
            c.require(m.scale >= 0, "the scale of reflectance and transmittance must not be negative");
        },
        [&](MeasuredMaterial const& m) {
            c.require(!m.file.path.empty(), "the measured material names no file: name one");
        },
        [&](AshikhminShirleyMaterial const& m) {
            c.require(m.reflectance.valid() && m.specular.valid() && m.nu.valid() && m.nv.valid(),
                      "the material needs a reflectance, a specular reflectance and two exponents");
        },
        [&](PlasticMaterial const& m) {
            c.require(m.reflectance.valid(), "the plastic names no reflectance: name a texture");
            check_index(c, m.eta);
        },
        [&](MetallicRoughnessMaterial const& m) {
            c.require(m.base_color.valid(), "the material names no base color: name a texture");
            c.require(m.index.ior == 0 || m.index.ior >= 1,
                      "the index of refraction must be 0 or at least 1");
            c.require(m.index.dispersion >= 0, "the dispersion must not be negative");
            check_interior(c, m.transmission.interior);
        },
        [&](MixMaterial const& m) {
            c.require(m.a.valid() && m.b.valid(), "the mix names fewer than two materials: name both");
            c.require(m.amount.valid(), "the mix names no amount: name a float texture");
        },
        [](InterfaceMaterial const&) {});
    check_finite(c, material.kind, "the material");
    check_finite(c, material.normal_map, "the normal map");
}

}  // namespace nephroid
