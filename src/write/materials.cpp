// Materials: each gets a name of its own, which its objects use.
#include "writer.h"

#include "scene/match.h"

namespace nephroid {

std::string const& Writer::material(MaterialId id) {
    auto const found = material_names_.find(id.value);
    if (found != material_names_.end()) return found->second;
    Material const& m = scene_[id];
    // Those that it is a mix of stand before it, as pbrt wants it.
    if (auto const* mix = std::get_if<MixMaterial>(&m.kind)) material(mix->a), material(mix->b);
    std::string const name =
        unique(taken_materials_,
               m.name.empty() ? "material " + std::to_string(taken_materials_.size() + 1) : m.name);
    write_material(name, m);
    return material_names_[id.value] = name;
}

void Writer::write_material(std::string const& name, Material const& m) {
    constexpr auto kAlbedo = SpectrumRole::Albedo;
    SourceLocation const where = m.where;
    ParamText p;
    char const* const type = match(
        m.kind,
        [&](DiffuseMaterial const& k) {
            spectrum(p, "reflectance", k.reflectance, kAlbedo, 0.5f, where);
            return "diffuse";
        },
        [&](DielectricMaterial const& k) {
            index(p, "eta", k.eta, where);
            roughness(p, "", k.roughness, where);
            surface_of_facets(p, "", k.roughness);
            if (!portable_) interior(p, k.interior, where);
            return "dielectric";
        },
        [&](ConductorMaterial const& k) {
            conductor(p, "", k, where);
            roughness(p, "", k.roughness, where);
            surface_of_facets(p, "", k.roughness);
            return "conductor";
        },
        [&](ThinDielectricMaterial const& k) {
            index(p, "eta", k.eta, where);
            return "thindielectric";
        },
        [](InterfaceMaterial const&) { return "interface"; },
        [&](MixMaterial const& k) {
            p.strings("materials", {material(k.a), material(k.b)});
            number(p, "amount", k.amount, 0.5f, where);
            return "mix";
        },
        [&](CoatedDiffuseMaterial const& k) {
            spectrum(p, "reflectance", k.reflectance, kAlbedo, 0.5f, where);
            coat(p, "", k.coat, where);
            surface_of_facets(p, "", k.coat.roughness);
            return "coateddiffuse";
        },
        [&](CoatedConductorMaterial const& k) {
            conductor(p, "conductor.", k.conductor, where);
            roughness(p, "conductor.", k.conductor.roughness, where);
            surface_of_facets(p, "conductor.", k.conductor.roughness);
            coat(p, "interface.", k.coat, where);
            surface_of_facets(p, "interface.", k.coat.roughness);
            return "coatedconductor";
        },
        [&](DiffuseTransmissionMaterial const& k) {
            spectrum(p, "reflectance", k.reflectance, kAlbedo, 0.25f, where);
            spectrum(p, "transmittance", k.transmittance, kAlbedo, 0.25f, where);
            p.number("scale", k.scale, 1);
            return "diffusetransmission";
        },
        [&](MeasuredMaterial const& k) {
            p.string("filename", file_name(k.file.path));
            return "measured";
        },
        [&](AshikhminShirleyMaterial const& k) {
            spectrum(p, "reflectance", k.reflectance, kAlbedo, 0.5f, where);
            spectrum(p, "specular", k.specular, kAlbedo, 0.05f, where);
            number(p, "nu", k.nu, 100.0f, where);
            number(p, "nv", k.nv, 100.0f, where);
            return "ashikhminshirley";
        },
        [&](PlasticMaterial const& k) {
            spectrum(p, "reflectance", k.reflectance, kAlbedo, 0.5f, where);
            spectrum(p, "specular", k.specular, kAlbedo, {}, where);
            index(p, "eta", k.eta, where);
            roughness(p, "", k.roughness, where);
            surface_of_facets(p, "", k.roughness);
            p.boolean("nonlinear", k.nonlinear, true);
            return "plastic";
        },
        [&](MetallicRoughnessMaterial const& k) {
            metallic_roughness(p, k, where);
            return "metallicroughness";
        });
    bool const has_surface =
        !std::holds_alternative<InterfaceMaterial>(m.kind) && !std::holds_alternative<MixMaterial>(m.kind);
    if (!has_surface && (m.displacement.valid() || m.normal_map.image.valid()))
        refuse(where, "bumps on a material without a surface of its own");
    if (!m.normal_map.image.valid() && m.normal_map.scale != 1)
        refuse(where, "the scale of a normal map that is not there");
    number(p, "displacement", m.displacement, {}, where);
    if (m.normal_map.image.valid()) {
        p.string("normalmap", picture(m.normal_map.image, "linear", where));
        p.number("normalscale", m.normal_map.scale, 1);
    }
    materials_ +=
        "MakeNamedMaterial " + in_quotes(name) + " \"string type\" \"" + type + '"' + p.text() + '\n';
}

void Writer::roughness(ParamText& p, std::string const& prefix, Roughness const& r, SourceLocation where) {
    auto const value = [&](TextureId id) {
        auto const* constant = id.valid() ? std::get_if<ConstantFloatTexture>(&scene_[id].kind) : nullptr;
        return constant ? std::optional(constant->value) : std::nullopt;
    };
    bool const same = !r.v.valid() || r.u == r.v || (value(r.u) && value(r.u) == value(r.v));
    if (same) return number(p, prefix + "roughness", r.u, {}, where);
    number(p, prefix + "uroughness", r.u, {}, where);
    number(p, prefix + "vroughness", r.v, {}, where);
}

void Writer::surface_of_facets(ParamText& p, std::string const& prefix, Roughness const& r) {
    constexpr std::array<char const*, 3> kDistributions{"trowbridgereitz", "beckmann", "blinn"};
    // pbrt has one for both surfaces of a coated metal, and without a prefix.
    p.boolean(portable_ && prefix != "conductor." ? "remaproughness" : prefix + "remaproughness", r.remap,
              true);
    p.choice(prefix + "distribution", kDistributions[static_cast<std::size_t>(r.distribution)],
             "trowbridgereitz");
    p.boolean(prefix + "multiscatter", r.multiscatter, false);
}

void Writer::interior(ParamText& p, Interior const& inside, SourceLocation where) {
    p.integer("priority", inside.priority, 0);
    auto const* none = std::get_if<ConstantSpd>(&inside.absorption);
    if (!none || none->value != 0) spd(p, "absorption", inside.absorption, SpectrumRole::Unbounded, where);
}

void Writer::conductor(ParamText& p, std::string const& prefix, ConductorMaterial const& m,
                       SourceLocation where) {
    if (m.reflectance.valid()) {
        if (m.eta.valid() || m.k.valid()) refuse(where, "a metal of an index and of a reflectance");
        return spectrum(p, "reflectance", m.reflectance, SpectrumRole::Albedo, {}, where);
    }
    spectrum(p, prefix + "eta", m.eta, SpectrumRole::Unbounded, {}, where);
    spectrum(p, prefix + "k", m.k, SpectrumRole::Unbounded, {}, where);
}

void Writer::coat(ParamText& p, std::string const& prefix, Coat const& c, SourceLocation where) {
    constexpr std::array<char const*, 3> kModels{"auto", "stochastic", "closed"};
    index(p, prefix + "eta", c.eta, where);
    roughness(p, prefix, c.roughness, where);
    number(p, "thickness", c.thickness, 0.01f, where);
    spectrum(p, "albedo", c.albedo, SpectrumRole::Albedo, {}, where);
    number(p, "g", c.g, 0.0f, where);
    p.integer("maxdepth", c.max_depth, 10);
    p.integer("nsamples", c.samples, 1);
    p.choice("layers", kModels[static_cast<std::size_t>(c.model)], "auto");
}

void Writer::metallic_roughness(ParamText& p, MetallicRoughnessMaterial const& m, SourceLocation where) {
    constexpr auto kAlbedo = SpectrumRole::Albedo;
    spectrum(p, "basecolor", m.base_color, kAlbedo, 1.0f, where);
    number(p, "metallic", m.metallic, {}, where);
    number(p, "roughness", m.roughness, {}, where);
    p.number("ior", m.index.ior, 1.5f);
    p.number("dispersion", m.index.dispersion, 0);
    number(p, "specular", m.specular.factor, {}, where);
    spectrum(p, "specularcolor", m.specular.color, kAlbedo, {}, where);
    number(p, "transmission", m.transmission.factor, {}, where);
    p.boolean("thinwalled", m.transmission.thin, true);
    interior(p, m.transmission.interior, where);
    number(p, "clearcoat", m.clearcoat.factor, {}, where);
    number(p, "clearcoatroughness", m.clearcoat.roughness, {}, where);
    spectrum(p, "sheencolor", m.sheen.color, kAlbedo, {}, where);
    number(p, "sheenroughness", m.sheen.roughness, {}, where);
    number(p, "anisotropy", m.anisotropy.strength, {}, where);
    if (m.anisotropy.rotation != 0) p.angle("anisotropyrotation", m.anisotropy.rotation, !portable_);
    p.boolean("multiscatter", m.multiscatter, true);
}

std::string const& Writer::medium(Spd const& absorption, SourceLocation where) {
    ParamText p;
    spd(p, "sigma_a", absorption, SpectrumRole::Unbounded, where);
    p.rgb("sigma_s", {0, 0, 0});
    auto const [it, is_new] = medium_names_.try_emplace(p.text());
    if (is_new) {
        it->second = "medium " + std::to_string(medium_names_.size());
        media_ +=
            "MakeNamedMedium " + in_quotes(it->second) + " \"string type\" \"homogeneous\"" + p.text() + '\n';
    }
    return it->second;
}

}  // namespace nephroid
