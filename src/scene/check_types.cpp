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
    for (Material const& material : scene.materials)
        match(
            material.kind,
            [&](DiffuseMaterial const& m) {
                types.require(material.where, m.reflectance, Type::Spectrum, "the reflectance");
            },
            [&](ConductorMaterial const& m) {
                types.require(material.where, m.reflectance, Type::Spectrum, "the reflectance");
                types.require(material.where, m.eta, Type::Spectrum, "the index eta");
                types.require(material.where, m.k, Type::Spectrum, "the absorption k");
            },
            [&](MixMaterial const& m) {
                types.require(material.where, m.amount, Type::Float, "the mix's amount");
            },
            [](auto const&) {});
    for (Group const& group : scene.groups)
        for (Object const& object : group.objects)
            types.require(object.where, object.alpha, Type::Float, "the object's alpha");
}

}  // namespace nephroid
