#include "model/assets.h"

#include "casts.h"
#include "measured_tables.h"
#include "scene/fields.h"
#include "scene/match.h"
#include "spectrum/color.h"

#include <functional>
#include <map>

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

/// The index of refraction that a kind of material gives as a spectrum.
Spd const* index_of(MaterialKind const& kind) {
    return match(kind, [](auto const& m) -> Spd const* {
        if constexpr (requires { m.coat; })
            return &m.coat.eta;
        else if constexpr (requires { std::get<ConstantSpd>(m.eta); })
            return &m.eta;
        else
            return nullptr;
    });
}
Interior const* interior_of(MaterialKind const& kind) {
    return match(kind, [](auto const& m) -> Interior const* {
        if constexpr (requires { m.interior; })
            return &m.interior;
        else if constexpr (requires { m.transmission.interior; })
            return m.transmission.thin ? nullptr : &m.transmission.interior;  // a thin wall has no inside
        else
            return nullptr;
    });
}
bool is_oriented(Roughness const& r) { return r.u.valid() && r.v.valid() && r.u != r.v; }
template <class M>
bool is_oriented(M const& m) {
    if constexpr (requires { m.anisotropy; })
        return m.anisotropy.strength.valid();
    else if constexpr (requires { m.nu; })
        return true;
    else if constexpr (std::same_as<M, MeasuredMaterial>)
        return true;
    else if constexpr (std::same_as<M, CoatedConductorMaterial>)
        return is_oriented(m.coat.roughness) || is_oriented(m.conductor.roughness);
    else if constexpr (requires { m.coat; })
        return is_oriented(m.coat.roughness);
    else if constexpr (requires { m.roughness.distribution; })
        return is_oriented(m.roughness);
    else
        return false;
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
    materials_.resize(scene.materials.size());
    std::map<std::string, std::shared_ptr<MeasuredTables const>> measured;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        Material const& material = scene.materials[i];
        MaterialData& d = materials_[i];
        auto const compiled = [&](Spd const& spd) {
            try {
                return spectra_.compile(spd, SpectrumRole::Unbounded);
            } catch (Error const& e) {
                throw Error(e.kind(), scene.locate(material.where) + ": " + e.what());
            }
        };
        if (Spd const* const eta = index_of(material.kind)) d.eta = compiled(with_ends_kept(*eta));
        if (auto const* const m = std::get_if<MeasuredMaterial>(&material.kind)) {
            auto& tables = measured[m->file.path];
            try {
                if (!tables) {
                    tables = std::make_shared<MeasuredTables const>(m->file.path);
                    measured_bytes_ += tables->bytes();
                }
            } catch (Error const& e) {
                throw Error(e.kind(), scene.locate(m->file.where) + ": " + e.what());
            }
            d.measured = tables;
        }
        if (Interior const* const inside = interior_of(material.kind)) {
            d.absorption = compiled(with_ends_kept(inside->absorption));
            d.priority = inside->priority;
            d.encloses = d.priority > 0 || !d.absorption.is_black();
        }
    }
    auto const needs_point = [&](TextureId id) { return id.valid() && !textures_[id.value].flat; };
    std::vector<std::uint8_t> known(scene.materials.size());
    // What a mix needs and lets pass is what its parts do; each material is looked at once, however often it is mixed.
    std::function<MaterialData const&(MaterialId)> look = [&](MaterialId id) -> MaterialData const& {
        MaterialData& d = materials_[id.value];
        if (known[id.value]) return d;
        known[id.value] = 1;
        Material const& material = scene[id];
        if (auto const* mix = std::get_if<MixMaterial>(&material.kind)) {
            MaterialData const& first = look(mix->a);
            MaterialData const& second = look(mix->b);
            d.mix = true;
            d.textured = needs_point(mix->amount) || first.textured || second.textured;
            d.passes = first.passes || second.passes;
            d.encloses = first.encloses || second.encloses;
            d.casts = first.casts || second.casts;
            return d;
        }
        d.passes = std::holds_alternative<InterfaceMaterial>(material.kind);
        d.casts = may_be_specular(*this, material.kind);
        d.perturbed = material.displacement.valid() || material.normal_map.image.valid();
        d.oriented = match(material.kind, [](auto const& m) { return is_oriented(m); });
        // The random walks of coats are keyed by the place.
        bool const keyed = match(material.kind, [](auto const& m) {
            return requires { m.coat; };
        });
        d.textured = d.perturbed || d.oriented || keyed;
        for_each_leaf(material.kind, [&](auto const& leaf) {
            if constexpr (std::same_as<std::remove_cvref_t<decltype(leaf)>, TextureId>)
                d.textured = d.textured || needs_point(leaf);
        });
        if (auto const* const m = std::get_if<DiffuseMaterial>(&material.kind)) {
            d.plain = !d.perturbed && m->reflectance.valid() &&
                      std::holds_alternative<ConstantSpectrumTexture>(scene[m->reflectance].kind);
            if (d.plain) d.reflectance = data(m->reflectance).spectrum;
        }
        return d;
    };
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) look(MaterialId{i});
}

}  // namespace nephroid
