#include "model/assets.h"

#include "scene/match.h"
#include "spectrum/color.h"

#include <functional>

namespace nephroid {

namespace {

/// A table that ends within the visible range, kept at its end values: an index of refraction of 0 is none.
Spd with_ends_kept(Spd spd) {
    auto* table = std::get_if<TabulatedSpd>(&spd);
    if (!table || table->lambda.empty()) return spd;
    if (table->lambda.front() > kLambdaMin) {
        table->lambda.insert(table->lambda.begin(), kLambdaMin);
        table->value.insert(table->value.begin(), table->value.front());
    }
    if (table->lambda.back() < kLambdaMax) {
        table->lambda.push_back(kLambdaMax);
        table->value.push_back(table->value.back());
    }
    return spd;
}

Transform mapping_transform(Scene const& scene, SourceLocation where, Mat4 const& m) {
    auto const t = make_transform(m);
    if (!t) scene.fail(where, "the texture's transform cannot be inverted; remove a scale by 0");
    return *t;
}

}  // namespace

Assets::Assets(Scene const& scene) : scene_(&scene), pictures_(scene) {
    Spd const white = RgbIlluminantSpd{{1, 1, 1}};
    neutral_ = spectra_.compile(white, SpectrumRole::Illuminant)
                   .scaled(static_cast<float>(1.0 / photometric(white)));
    for (Texture const& texture : scene.textures) {
        TextureData d;
        auto const mapped = [&](TextureMapping const& mapping) {
            match(
                mapping, [](UvMapping const&) {},
                [&](auto const& m) {
                    d.mapping = mapping_transform(scene, texture.where, m.world_to_texture);
                });
        };
        match(
            texture.kind,
            [&](ConstantFloatTexture const& t) {
                d.value = t.value;
                d.flat = true;
            },
            [&](ConstantSpectrumTexture const& t) {
                try {
                    d.spectrum = spectra_.compile(t.value, t.role);
                } catch (Error const& e) {
                    throw Error(e.kind(), scene.locate(texture.where) + ": " + e.what());
                }
                d.flat = true;
            },
            [&](ImageTexture const& t) { mapped(t.mapping); },
            [&](CheckerboardTexture const& t) {
                if (t.dimension == 3) {
                    d.mapping = mapping_transform(scene, texture.where, t.world_to_texture);
                } else {
                    mapped(t.mapping);
                }
            },
            [](ScaleTexture const&) {}, [](MixTexture const&) {},
            [&](DirectionMixTexture const& t) { d.direction = normalize(t.dir); },
            [&](BilerpTexture const& t) { mapped(t.mapping); },
            [&](DotsTexture const& t) { mapped(t.mapping); },
            [&](auto const& noise) {
                d.mapping = mapping_transform(scene, texture.where, noise.world_to_texture);
            });
        textures_.push_back(d);
    }
    auto const needs_point = [&](TextureId id) { return id.valid() && !textures_[id.value].flat; };
    std::vector<std::uint8_t> known(scene.materials.size());
    materials_.resize(scene.materials.size());
    // What a mix needs and lets pass is what its parts do; each material is looked at once, however often it is mixed.
    std::function<MaterialData const&(MaterialId)> look = [&](MaterialId id) -> MaterialData const& {
        MaterialData& d = materials_[id.value];
        if (known[id.value]) return d;
        known[id.value] = 1;
        match(
            scene[id].kind, [&](DiffuseMaterial const& m) { d.textured = needs_point(m.reflectance); },
            [&](ConductorMaterial const& m) {
                d.textured = needs_point(m.eta) || needs_point(m.k) || needs_point(m.reflectance);
            },
            [&](InterfaceMaterial const&) { d.passes = true; },
            [&](MixMaterial const& m) {
                MaterialData const& first = look(m.a);
                MaterialData const& second = look(m.b);
                d.mix = true;
                d.textured = needs_point(m.amount) || first.textured || second.textured;
                d.passes = first.passes || second.passes;
            },
            [](auto const&) {});
        return d;
    };
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        Material const& material = scene.materials[i];
        look(MaterialId{i});
        auto const compile_eta = [&](Spd const& eta) {
            try {
                materials_[i].eta = spectra_.compile(with_ends_kept(eta), SpectrumRole::Unbounded);
            } catch (Error const& e) {
                throw Error(e.kind(), scene.locate(material.where) + ": " + e.what());
            }
        };
        match(
            material.kind, [&](DielectricMaterial const& m) { compile_eta(m.eta); },
            [&](ThinDielectricMaterial const& m) { compile_eta(m.eta); }, [](auto const&) {});
    }
}

}  // namespace nephroid
