// Materials of ours as the nearest of pbrt-v4's.
#include "portable.h"

#include "scene/match.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

class Portable {
  public:
    Portable(Scene& scene, Material const& m) : scene_(scene), where_(m.where) {}

    MaterialKind operator()(PlasticMaterial const& m) {
        note("\"plastic\" is replaced by \"coateddiffuse\"");
        CoatedDiffuseMaterial c{m.reflectance, thin_coat()};
        c.coat.eta = m.eta;
        c.coat.roughness = facets(m.roughness);
        return c;
    }
    MaterialKind operator()(AshikhminShirleyMaterial const& m) {
        note("\"ashikhminshirley\" is replaced by \"coateddiffuse\"");
        CoatedDiffuseMaterial c{m.reflectance, thin_coat()};
        // The index that reflects as much at normal incidence, and the alpha of an exponent.
        if (auto const s = level(m.specular)) {
            float const root = std::sqrt(clamp(*s, 0.0f, 0.25f));
            c.coat.eta = ConstantSpd{std::max((1 + root) / (1 - root), 1.001f)};
        }
        auto const alpha = [&](TextureId nu) {
            auto const n = value(nu, 100);
            if (!n) note("an exponent by a texture is replaced by 100");
            return number(std::sqrt(2 / (std::max(n.value_or(100), 0.0f) + 2)));
        };
        c.coat.roughness = {alpha(m.nu), alpha(m.nv), false};
        return c;
    }
    MaterialKind operator()(MetallicRoughnessMaterial const& m) {
        Roughness const rough{squared(m.roughness), {}, false};
        ConductorMaterial metal;
        metal.reflectance = m.base_color;
        metal.roughness = rough;
        CoatedDiffuseMaterial plastic{m.base_color, thin_coat()};
        float const ior = m.index.ior == 0 ? 1.5f : std::max(m.index.ior, 1.001f);
        plastic.coat.eta = ConstantSpd{ior};
        plastic.coat.roughness = rough;
        auto const metallic = value(m.metallic, 1), through = value(m.transmission.factor, 0);
        if (through.value_or(0) >= 0.5f && metallic.value_or(0) < 0.5f) {
            note(is_white(m.base_color) ? "\"metallicroughness\" is replaced by glass"
                                        : "\"metallicroughness\" is replaced by glass without its colour");
            if (m.transmission.thin) return ThinDielectricMaterial{ConstantSpd{ior}};
            return kept(DielectricMaterial{ConstantSpd{ior}, rough, m.transmission.interior});
        }
        if (metallic && (*metallic == 0 || *metallic == 1)) {
            note(*metallic == 1 ? "\"metallicroughness\" is replaced by \"conductor\""
                                : "\"metallicroughness\" is replaced by \"coateddiffuse\"");
            if (*metallic == 1) return metal;
            return plastic;
        }
        note("\"metallicroughness\" is replaced by a mix of \"conductor\" and \"coateddiffuse\"");
        MaterialId const a = scene_.add(Material{plastic, {}, where_});
        MaterialId const b = scene_.add(Material{metal, {}, where_});
        return MixMaterial{a, b, m.metallic};
    }
    MaterialKind operator()(DielectricMaterial m) { return kept(std::move(m)); }
    MaterialKind operator()(ConductorMaterial m) {
        m.roughness = facets(m.roughness);
        return m;
    }
    MaterialKind operator()(CoatedDiffuseMaterial m) {
        m.coat = kept(m.coat);
        return m;
    }
    MaterialKind operator()(CoatedConductorMaterial m) {
        m.coat = kept(m.coat);
        m.conductor.roughness = facets(m.conductor.roughness);
        if (m.conductor.roughness.remap != m.coat.roughness.remap) {
            note("the metal's roughness is mapped to alpha as the coat's is");
            m.conductor.roughness.remap = m.coat.roughness.remap;
        }
        return m;
    }
    // pbrt-v4's as they are.
    MaterialKind operator()(DiffuseMaterial const& m) { return m; }
    MaterialKind operator()(ThinDielectricMaterial const& m) { return m; }
    MaterialKind operator()(InterfaceMaterial const& m) { return m; }
    MaterialKind operator()(MixMaterial const& m) { return m; }
    MaterialKind operator()(DiffuseTransmissionMaterial const& m) { return m; }
    MaterialKind operator()(MeasuredMaterial const& m) { return m; }

    void note(char const* text) { scene_.note(where_, text); }

  private:
    TextureId number(float x) { return scene_.add(Texture{ConstantFloatTexture{x}, where_}); }
    /// A constant's; nothing for what varies.
    [[nodiscard]] std::optional<float> value(TextureId id, float otherwise) const {
        if (!id.valid()) return otherwise;
        auto const* c = std::get_if<ConstantFloatTexture>(&scene_[id].kind);
        return c ? std::optional(c->value) : std::nullopt;
    }
    [[nodiscard]] std::optional<float> level(TextureId id) const {
        auto const* c = std::get_if<ConstantSpectrumTexture>(&scene_[id].kind);
        if (!c) return std::nullopt;
        return match(
            c->value, [](ConstantSpd const& s) { return std::optional(s.value); },
            [](RgbAlbedoSpd const& s) { return std::optional((s.rgb.x + s.rgb.y + s.rgb.z) / 3); },
            [](auto const&) { return std::optional<float>(); });
    }
    [[nodiscard]] bool is_white(TextureId id) const {
        if (!id.valid()) return true;
        auto const* c = std::get_if<ConstantSpectrumTexture>(&scene_[id].kind);
        return c &&
               match(
                   c->value, [](ConstantSpd const& s) { return s.value == 1; },
                   [](RgbAlbedoSpd const& s) { return s.rgb == Vec3{1}; }, [](auto const&) { return false; });
    }
    /// glTF's alpha is the square of its roughness.
    TextureId squared(TextureId id) {
        if (auto const x = value(id, 1)) return number(*x * *x);
        return scene_.add(Texture{ScaleTexture{id, id}, where_});
    }
    Coat thin_coat() {
        Coat c;
        c.thickness = number(0.01f);
        c.g = number(0);
        return c;
    }
    Roughness facets(Roughness r) {
        if (r.distribution != Distribution::TrowbridgeReitz)
            note("the distribution of microfacets is replaced by \"trowbridgereitz\"");
        if (r.multiscatter) note("what microfacets reflect among themselves is lost, as in pbrt-v4");
        r.distribution = Distribution::TrowbridgeReitz;
        r.multiscatter = false;
        for (TextureId* id : {&r.u, &r.v})
            if (id->valid() && value(*id, 0).value_or(0) > 1) *id = number(1);
        return r;
    }
    DielectricMaterial kept(DielectricMaterial m) {
        if (m.interior.priority != 0)
            note("\"priority\" is left out: bodies that overlap are not what they were");
        m.interior.priority = 0;
        m.roughness = facets(m.roughness);
        return m;
    }
    Coat kept(Coat c) {
        c.roughness = facets(c.roughness);
        c.model = CoatModel::Automatic;
        return c;
    }

    Scene& scene_;
    SourceLocation where_;
};

}  // namespace

void make_materials_portable(Scene& scene) {
    std::size_t const count = scene.materials.size();  // those that are added are pbrt's already
    for (std::size_t i = 0; i < count; ++i) {
        Material m = scene.materials[i];
        Portable portable(scene, m);
        m.kind = match(MaterialKind(m.kind), [&](auto const& kind) { return portable(kind); });
        if (m.normal_map.image.valid() && m.normal_map.scale != 1) {
            portable.note("\"normalscale\" is left out");
            m.normal_map.scale = 1;
        }
        // A mix has no surface of its own.
        if (std::holds_alternative<MixMaterial>(m.kind)) m.displacement = {}, m.normal_map = {};
        scene.materials[i] = std::move(m);
    }
}

void make_textures_portable(Scene& scene) {
    for (std::uint32_t i = 0; i < scene.textures.size(); ++i) {
        auto* b = std::get_if<BilerpTexture>(&scene.textures[i].kind);
        if (!b) continue;
        for (TextureId* corner : {&b->v00, &b->v01, &b->v10, &b->v11}) {
            auto const& kind = scene[*corner].kind;
            if (std::holds_alternative<ConstantFloatTexture>(kind) ||
                std::holds_alternative<ConstantSpectrumTexture>(kind))
                continue;
            scene.note(scene.textures[i].where,
                       "a corner of \"bilerp\" that is a texture is replaced by the next one's");
            *corner = corner == &b->v00 ? b->v11 : b->v00;
        }
    }
}

}  // namespace nephroid
