// Textures: values stay where they are used, what varies gets a name.
#include "writer.h"

#include "scene/match.h"

#include <cmath>

namespace nephroid {

namespace {

/// Which a reader leaves as it is.
bool is_unit(Vec3 d) {
    auto const squared = [](float x) { return static_cast<double>(x) * static_cast<double>(x); };
    return std::abs(squared(d.x) + squared(d.y) + squared(d.z) - 1) < 1e-6;
}

/// Only some mappings are somewhere.
void mapping_place(TextureMapping const& m, Mat4& place) {
    match(
        m, [](UvMapping const&) {}, [&](auto const& other) { place = other.world_to_texture; });
}

bool is_plain(TextureMapping const& m) {
    auto const* uv = std::get_if<UvMapping>(&m);
    return uv && uv->su == 1 && uv->sv == 1 && uv->du == 0 && uv->dv == 0;
}

constexpr std::array<char const*, 4> kWraps{"repeat", "black", "clamp", "octahedralsphere"};
constexpr std::array<char const*, 4> kFilters{"point", "bilinear", "trilinear", "ewa"};

}  // namespace

bool Writer::is_spectrum(TextureId id) const {
    return match(
        scene_[id].kind, [](ConstantFloatTexture const&) { return false; },
        [](ConstantSpectrumTexture const&) { return true; },
        [](ImageTexture const& t) { return t.is_spectrum; },
        [&](CheckerboardTexture const& t) { return is_spectrum(t.tex1); },
        [&](ScaleTexture const& t) { return is_spectrum(t.tex); },
        [&](MixTexture const& t) { return is_spectrum(t.tex1); },
        [&](DirectionMixTexture const& t) { return is_spectrum(t.tex1); },
        [&](BilerpTexture const& t) { return is_spectrum(t.v00); },
        [&](DotsTexture const& t) { return is_spectrum(t.inside); }, [](FbmTexture const&) { return false; },
        [](WrinkledTexture const&) { return false; }, [](WindyTexture const&) { return false; },
        [](MarbleTexture const&) { return true; });
}

void Writer::number(ParamText& p, std::string_view name, TextureId id, std::optional<float> otherwise,
                    SourceLocation /*where*/) {
    if (!id.valid()) return;
    if (auto const* constant = std::get_if<ConstantFloatTexture>(&scene_[id].kind)) {
        if (constant->value != otherwise) p.number(name, constant->value);
        return;
    }
    p.texture(name, texture(id, SpectrumRole::Albedo));
}

void Writer::spectrum(ParamText& p, std::string_view name, TextureId id, SpectrumRole role,
                      std::optional<float> otherwise, SourceLocation where) {
    if (!id.valid()) return;
    auto const* constant = std::get_if<ConstantSpectrumTexture>(&scene_[id].kind);
    if (!constant) return p.texture(name, texture(id, role));
    if (constant->role != role) refuse(where, "a texture of another role in \"" + std::string(name) + "\"");
    auto const* level = std::get_if<ConstantSpd>(&constant->value);
    if (!level || level->value != otherwise) spd(p, name, constant->value, role, where);
}

void Writer::input(ParamText& p, std::string_view name, TextureId id, bool spectra, SpectrumRole role,
                   float otherwise, SourceLocation where) {
    if (spectra)
        spectrum(p, name, id, role, otherwise, where);
    else
        number(p, name, id, otherwise, where);
}

std::string const& Writer::texture(TextureId id, SpectrumRole role) {
    auto const found = texture_names_.find({id.value, role});
    if (found != texture_names_.end()) return found->second;
    std::string const name = unique(taken_textures_, "texture " + std::to_string(taken_textures_.size() + 1));
    write_texture(name, scene_[id], role);
    return texture_names_[{id.value, role}] = name;
}

void Writer::mapping(ParamText& p, TextureMapping const& m) {
    match(
        m,
        [&](UvMapping const& uv) {
            p.number("uscale", uv.su, 1);
            p.number("vscale", uv.sv, 1);
            p.number("udelta", uv.du, 0);
            p.number("vdelta", uv.dv, 0);
        },
        [&](SphericalMapping const&) { p.string("mapping", "spherical"); },
        [&](CylindricalMapping const&) { p.string("mapping", "cylindrical"); },
        [&](PlanarMapping const& plane) {
            p.string("mapping", "planar");
            p.vector("v1", plane.v1);
            p.vector("v2", plane.v2);
            p.number("udelta", plane.du, 0);
            p.number("vdelta", plane.dv, 0);
        });
}

void Writer::write_texture(std::string const& name, Texture const& t, SpectrumRole role) {
    ParamText p;
    Mat4 from_world;
    SourceLocation const where = t.where;
    bool spectra = false;
    auto const noise = [&](auto const& k) {
        from_world = k.world_to_texture;
        p.integer("octaves", k.octaves, 8);
        p.number("roughness", k.roughness, 0.5f);
    };
    // Two inputs, with what they are where nothing is said.
    auto const between = [&](auto const& k, float tex1, float tex2) {
        spectra = is_spectrum(k.tex1);
        input(p, "tex1", k.tex1, spectra, role, tex1, where);
        input(p, "tex2", k.tex2, spectra, role, tex2, where);
    };
    char const* const kind = match(
        t.kind,
        [&](ConstantFloatTexture const& k) {
            p.number("value", k.value);
            return "constant";
        },
        [&](ConstantSpectrumTexture const& k) {
            spectra = true;
            if (k.role != role) refuse(where, "a texture of two roles");
            spd(p, "value", k.value, role, where);
            return "constant";
        },
        [&](ImageTexture const& k) {
            spectra = k.is_spectrum;
            if (k.role != (spectra ? role : SpectrumRole::Albedo))
                refuse(where, "a picture of another role than that of its place");
            p.string("filename", file_name(scene_[k.image].path));
            if (auto const& encoding = scene_[k.image].encoding; !encoding.empty())
                p.string("encoding", encoding);
            p.choice("wrap", kWraps[static_cast<std::size_t>(k.wrap)], "repeat");
            p.choice("filter", kFilters[static_cast<std::size_t>(k.filter)], "bilinear");
            p.number("maxanisotropy", k.max_anisotropy, 8);
            p.number("scale", k.scale, 1);
            p.boolean("invert", k.invert, false);
            mapping(p, k.mapping);
            mapping_place(k.mapping, from_world);
            return "imagemap";
        },
        [&](CheckerboardTexture const& k) {
            p.integer("dimension", k.dimension, 2);
            if (k.dimension == 2 ? !is_identity(k.world_to_texture) : !is_plain(k.mapping))
                refuse(where, "a checkerboard with the mapping of another dimension");
            if (k.dimension == 2) {
                mapping(p, k.mapping);
                mapping_place(k.mapping, from_world);
            } else {
                from_world = k.world_to_texture;
            }
            between(k, 1, 0);
            return "checkerboard";
        },
        [&](ScaleTexture const& k) {
            spectra = is_spectrum(k.tex);
            input(p, "tex", k.tex, spectra, role, 1, where);
            number(p, "scale", k.scale, 1.0f, where);
            return "scale";
        },
        [&](MixTexture const& k) {
            between(k, 0, 1);
            number(p, "amount", k.amount, 0.5f, where);
            return "mix";
        },
        [&](DirectionMixTexture const& k) {
            between(k, 0, 1);
            if (!portable_ && !is_unit(k.dir)) refuse(where, "a direction that is not of length 1");
            p.vector("dir", k.dir);
            return "directionmix";
        },
        [&](BilerpTexture const& k) {
            spectra = is_spectrum(k.v00);
            mapping(p, k.mapping);
            mapping_place(k.mapping, from_world);
            input(p, "v00", k.v00, spectra, role, 0, where);
            input(p, "v01", k.v01, spectra, role, 1, where);
            input(p, "v10", k.v10, spectra, role, 0, where);
            input(p, "v11", k.v11, spectra, role, 1, where);
            return "bilerp";
        },
        [&](DotsTexture const& k) {
            spectra = is_spectrum(k.inside);
            mapping(p, k.mapping);
            mapping_place(k.mapping, from_world);
            // The reader's exchange, back again: what pbrt calls inside lies around the dots.
            input(p, "inside", k.outside, spectra, role, 1, where);
            input(p, "outside", k.inside, spectra, role, 0, where);
            return "dots";
        },
        [&](FbmTexture const& k) { return noise(k), "fbm"; },
        [&](WrinkledTexture const& k) { return noise(k), "wrinkled"; },
        [&](WindyTexture const& k) { return from_world = k.world_to_texture, "windy"; },
        [&](MarbleTexture const& k) {
            spectra = true;
            noise(k);
            p.number("scale", k.scale, 1);
            p.number("variation", k.variation, 0.2f);
            return "marble";
        });
    std::string const place = inverse_transform(p, from_world, name + " from world");
    std::string const text = "Texture " + in_quotes(name) + (spectra ? " \"spectrum\" \"" : " \"float\" \"") +
                             kind + '"' + p.text() + '\n';
    textures_ += place.empty() ? text : "AttributeBegin\n" + place + text + "AttributeEnd\n";
}

}  // namespace nephroid
