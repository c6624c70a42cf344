// Textures: values stay where they are used, what varies gets a name.
#include "writer.h"

#include "scene/match.h"

#include <cmath>

namespace nephroid {

namespace {

/// A transform under which (0, 1, 0) becomes a vector that is `d` after it is made a unit one and rounded.
std::optional<Mat4> transform_to(Vec3 d) {
    // d is a unit vector rounded: there is one within half a step of each of its numbers.
    std::array<double, 3> low{}, high{};
    auto const squared = [](std::array<double, 3> const& v) {
        return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    };
    for (std::size_t i = 0; i < 3; ++i) {
        float const x = std::abs(d[static_cast<int>(i)]);
        auto const half_step = [&](float y) {
            return 0.4999 * (static_cast<double>(y) - static_cast<double>(x));
        };
        low[i] = static_cast<double>(x) + (x > 0 ? half_step(std::nextafter(x, 0.0f)) : 0);
        high[i] = static_cast<double>(x) + half_step(std::nextafter(x, kInfinity));
    }
    if (!(squared(low) <= 1 && squared(high) >= 1)) return std::nullopt;
    std::array<double, 3> v{};
    double lo = 0, hi = 1;
    for (int step = 0; step < 60; ++step) {
        double const t = 0.5 * (lo + hi);
        for (std::size_t i = 0; i < 3; ++i) v[i] = low[i] + t * (high[i] - low[i]);
        (squared(v) < 1 ? lo : hi) = t;
    }
    Mat4 m;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        m.m[i] = {0, std::copysign(v[i], static_cast<double>(d[static_cast<int>(i)])), 0, 0};
        if (v[i] > v[longest]) longest = i;
    }
    // The other two columns: any that leave the matrix an inverse.
    m.m[(longest + 1) % 3][0] = m.m[(longest + 2) % 3][2] = 1;
    return m;
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
    std::string place;  // a transform of another kind
    SourceLocation const where = t.where;
    bool spectra = false;
    auto const noise = [&](auto const& k) {
        from_world = k.world_to_texture;
        p.integer("octaves", k.octaves, 8);
        p.number("roughness", k.roughness, 0.5f);
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
            spectra = is_spectrum(k.tex1);
            p.integer("dimension", k.dimension, 2);
            if (k.dimension == 2 ? !is_identity(k.world_to_texture) : !is_plain(k.mapping))
                refuse(where, "a checkerboard with the mapping of another dimension");
            if (k.dimension == 2) {
                mapping(p, k.mapping);
                mapping_place(k.mapping, from_world);
            } else {
                from_world = k.world_to_texture;
            }
            input(p, "tex1", k.tex1, spectra, role, 1, where);
            input(p, "tex2", k.tex2, spectra, role, 0, where);
            return "checkerboard";
        },
        [&](ScaleTexture const& k) {
            spectra = is_spectrum(k.tex);
            input(p, "tex", k.tex, spectra, role, 1, where);
            number(p, "scale", k.scale, 1.0f, where);
            return "scale";
        },
        [&](MixTexture const& k) {
            spectra = is_spectrum(k.tex1);
            input(p, "tex1", k.tex1, spectra, role, 0, where);
            input(p, "tex2", k.tex2, spectra, role, 1, where);
            number(p, "amount", k.amount, 0.5f, where);
            return "mix";
        },
        [&](DirectionMixTexture const& k) {
            spectra = is_spectrum(k.tex1);
            input(p, "tex1", k.tex1, spectra, role, 0, where);
            input(p, "tex2", k.tex2, spectra, role, 1, where);
            if (portable_) {
                p.vector("dir", k.dir);
            } else {
                auto const m = transform_to(k.dir);
                if (!m) refuse(where, "a direction that is not of length 1");
                place = "Transform" + matrix_text(*m) + '\n';
            }
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
    place += inverse_transform(p, from_world, name + " from world");
    std::string const text = "Texture " + in_quotes(name) + (spectra ? " \"spectrum\" \"" : " \"float\" \"") +
                             kind + '"' + p.text() + '\n';
    textures_ += place.empty() ? text : "AttributeBegin\n" + place + text + "AttributeEnd\n";
}

}  // namespace nephroid
