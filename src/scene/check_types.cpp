// Which textures are numbers and which are spectra. What is made of others is what they are.
#include "check.h"
#include "scene/match.h"

namespace nephroid {

namespace {

enum class Type : std::uint8_t { Float, Spectrum };

class Types {
  public:
    Types(Scene const& scene, std::vector<std::uint32_t> const& children_first)
        : scene_(scene), types_(scene.textures.size()) {
        for (std::uint32_t const i : children_first) types_[i] = type_of(scene.textures[i]);
    }
    void require(SourceLocation where, TextureId id, Type type, std::string const& what) const {
        if (!id.valid() || types_[id.value] == type) return;
        scene_.fail(where, what + (type == Type::Float ? " needs a float texture, not one of spectra"
                                                       : " needs a spectrum texture, not one of floats"));
    }

  private:
    [[nodiscard]] Type type_of(Texture const& texture) const {
        auto const same = [&](TextureId a, TextureId b, std::string const& what) {
            require(texture.where, b, types_[a.value], what + "'s second texture");
            return types_[a.value];
        };
        return match(
            texture.kind, [](ConstantFloatTexture const&) { return Type::Float; },
            [](ConstantSpectrumTexture const&) { return Type::Spectrum; },
            [](ImageTexture const& t) { return t.is_spectrum ? Type::Spectrum : Type::Float; },
            [&](CheckerboardTexture const& t) { return same(t.tex1, t.tex2, "the checkerboard"); },
            [&](ScaleTexture const& t) {
                require(texture.where, t.scale, Type::Float, "the texture's scale");
                return types_[t.tex.value];
            },
            [&](MixTexture const& t) {
                require(texture.where, t.amount, Type::Float, "the mix's amount");
                return same(t.tex1, t.tex2, "the mix");
            },
            [&](DirectionMixTexture const& t) { return same(t.tex1, t.tex2, "the mix"); },
            [&](BilerpTexture const& t) {
                for (TextureId const other : {t.v01, t.v10, t.v11})
                    require(texture.where, other, types_[t.v00.value], "each corner of the bilerp");
                return types_[t.v00.value];
            },
            [&](DotsTexture const& t) { return same(t.outside, t.inside, "the pattern of dots"); },
            [](FbmTexture const&) { return Type::Float; }, [](WrinkledTexture const&) { return Type::Float; },
            [](WindyTexture const&) { return Type::Float; },
            [](MarbleTexture const&) { return Type::Spectrum; });
    }

    Scene const& scene_;
    std::vector<Type> types_;
};

}  // namespace

void check_texture_types(Scene const& scene, std::vector<std::uint32_t> const& children_first) {
    Types const types(scene, children_first);
    for (Material const& material : scene.materials) {
        auto const number = [&](TextureId id, char const* what) {
            types.require(material.where, id, Type::Float, what);
        };
        auto const spectrum = [&](TextureId id, char const* what) {
            types.require(material.where, id, Type::Spectrum, what);
        };
        auto const rough = [&](Roughness const& r) {
            number(r.u, "the roughness");
            number(r.v, "the roughness");
        };
        auto const conductor = [&](ConductorMaterial const& m) {
            spectrum(m.reflectance, "the reflectance");
            spectrum(m.eta, "the index eta");
            spectrum(m.k, "the absorption k");
            rough(m.roughness);
        };
        auto const coat = [&](Coat const& m) {
            rough(m.roughness);
            number(m.thickness, "the coat's thickness");
            number(m.g, "the coat's asymmetry g");
            spectrum(m.albedo, "the coat's albedo");
        };
        number(material.displacement, "the displacement");
        match(
            material.kind, [&](DiffuseMaterial const& m) { spectrum(m.reflectance, "the reflectance"); },
            [&](DielectricMaterial const& m) { rough(m.roughness); },
            [&](ConductorMaterial const& m) { conductor(m); }, [](ThinDielectricMaterial const&) {},
            [](InterfaceMaterial const&) {},
            [&](MixMaterial const& m) { number(m.amount, "the mix's amount"); },
            [&](CoatedDiffuseMaterial const& m) {
                spectrum(m.reflectance, "the reflectance");
                coat(m.coat);
            },
            [&](CoatedConductorMaterial const& m) {
                conductor(m.conductor);
                coat(m.coat);
            },
            [&](DiffuseTransmissionMaterial const& m) {
                spectrum(m.reflectance, "the reflectance");
                spectrum(m.transmittance, "the transmittance");
            },
            [](MeasuredMaterial const&) {},
            [&](AshikhminShirleyMaterial const& m) {
                spectrum(m.reflectance, "the reflectance");
                spectrum(m.specular, "the specular reflectance");
                number(m.nu, "the exponent nu");
                number(m.nv, "the exponent nv");
            },
            [&](PlasticMaterial const& m) {
                spectrum(m.reflectance, "the reflectance");
                spectrum(m.specular, "the specular reflectance");
                rough(m.roughness);
            },
            [&](MetallicRoughnessMaterial const& m) {
                spectrum(m.base_color, "the base color");
                spectrum(m.specular.color, "the specular color");
                spectrum(m.sheen.color, "the sheen's color");
                number(m.metallic, "the metalness");
                number(m.roughness, "the roughness");
                number(m.specular.factor, "the specular factor");
                number(m.transmission.factor, "the transmission");
                number(m.clearcoat.factor, "the clearcoat");
                number(m.clearcoat.roughness, "the clearcoat's roughness");
                number(m.sheen.roughness, "the sheen's roughness");
                number(m.anisotropy.strength, "the anisotropy");
            });
    }
    for (Group const& group : scene.groups)
        for (Object const& object : group.objects)
            types.require(object.where, object.alpha, Type::Float, "the object's alpha");
}

}  // namespace nephroid
