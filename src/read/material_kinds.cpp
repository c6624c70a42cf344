// The kinds of materials, with pbrt-v4's parameters and defaults.
#include "materials.h"
#include "shown.h"
#include "spectra.h"
#include "spectrum/named.h"

#include <array>
#include <cmath>
#include <utility>

namespace nephroid {

namespace {

/// What pbrt-v3 called a material, and what to write instead.
constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kOldNames{
    {{"matte", "\"diffuse\" with \"rgb reflectance\""},
     {"plastic", "\"coateddiffuse\" with \"rgb reflectance\""},
     {"substrate", "\"coateddiffuse\" with \"rgb reflectance\""},
     {"metal", "\"conductor\" with \"spectrum eta\" and \"spectrum k\""},
     {"mirror", "\"conductor\" with \"rgb reflectance\""},
     {"glass", "\"dielectric\" with \"float eta\""},
     {"translucent", "\"diffusetransmission\""},
     {"uber", "\"coateddiffuse\""},
     {"disney", "\"coateddiffuse\""},
     {"kdsubsurface", "\"subsurface\""},
     {"fourier", "\"measured\""}}};

/// What a spectrum may be given as.
constexpr auto kSpectral = {ParamType::Rgb, ParamType::Spectrum, ParamType::Texture, ParamType::Blackbody,
                            ParamType::Float};

Spd copper(char const* what) { return NamedSpd{std::string("metal-Cu-") + what}; }

}  // namespace

MaterialKind Materials::kind_of(std::string const& type, Params& p, Pending const& pending) {
    if (type == "mix") return mix(p, pending);
    if (type == "interface") return InterfaceMaterial{};
    if (type.empty() || type == "none") {
        p.note("is pbrt-v3's name; in pbrt-v4 it is \"interface\"");
        return InterfaceMaterial{};
    }
    if (type == "diffuse") return DiffuseMaterial{albedo(p, "reflectance", 0.5f)};
    if (type == "dielectric") {
        DielectricMaterial m;
        m.eta = index(p, "eta");
        m.roughness = roughness(p, "");
        m.interior = interior(p);
        return m;
    }
    if (type == "thindielectric") return ThinDielectricMaterial{index(p, "eta")};
    if (type == "conductor") {
        auto m = conductor(p, "");
        m.roughness = roughness(p, "");
        return m;
    }
    if (type == "coateddiffuse") {
        CoatedDiffuseMaterial m;
        m.reflectance = albedo(p, "reflectance", 0.5f);
        m.coat = coat(p, "");
        return m;
    }
    if (type == "coatedconductor") {
        CoatedConductorMaterial m;
        m.conductor = conductor(p, "conductor.");
        m.conductor.roughness = roughness(p, "conductor.");
        m.coat = coat(p, "interface.");
        return m;
    }
    if (type == "diffusetransmission") {
        DiffuseTransmissionMaterial m;
        m.reflectance = albedo(p, "reflectance", 0.25f);
        m.transmittance = albedo(p, "transmittance", 0.25f);
        m.scale = p.number("scale", 1);
        if (m.scale < 0) p.fail("\"scale\" must not be negative");
        return m;
    }
    if (type == "measured") {
        auto const filename = p.string("filename", "");
        if (filename.empty()) p.fail("needs a \"string filename\" (a .bsdf file)");
        auto const where = p.find("filename")->where;
        return MeasuredMaterial{{context_.resolve(where, filename).string(), where}};
    }
    if (type == "ashikhminshirley") {
        AshikhminShirleyMaterial m;
        m.reflectance = albedo(p, "reflectance", 0.5f);
        m.specular = albedo(p, "specular", 0.05f);
        m.nu = textures_.float_param(p, "nu", 100.0f);
        m.nv = textures_.float_param(p, "nv", 100.0f);
        return m;
    }
    if (type == "plastic") return plastic(p);
    if (type == "metallicroughness") return metallic_roughness(p);
    return approximated(type, p);
}

MaterialKind Materials::approximated(std::string const& type, Params& p) {
    for (char const* other : {"subsurface", "sheen", "cloth"})
        if (type == other) {
            p.note("\"" + shown(type) +
                   "\" is not rendered yet: a diffuse surface of its reflectance stands in");
            p.ignore_all();
            return DiffuseMaterial{albedo(p, "reflectance", 0.5f)};
        }
    if (type == "hair") {
        p.note("\"hair\" is not rendered yet: a diffuse surface of its color stands in");
        p.ignore_all();
        return DiffuseMaterial{albedo(p, p.find("color", kSpectral) ? "color" : "reflectance", 0.5f)};
    }
    for (auto const& [old, now] : kOldNames)
        if (type == old)
            p.fail("material \"" + shown(type) + "\" is of pbrt-v3; in pbrt-v4 write " + std::string(now));
    p.fail("unknown material \"" + shown(type) + "\"" +
           did_you_mean(type, {"diffuse", "dielectric", "thindielectric", "conductor", "coateddiffuse",
                               "coatedconductor", "diffusetransmission", "subsurface", "hair", "measured",
                               "mix", "interface", "ashikhminshirley", "plastic", "metallicroughness"}));
}

TextureId Materials::albedo(Params& p, std::string_view name, std::optional<float> otherwise) {
    auto const constant = [](float value) { return Spd{ConstantSpd{value}}; };
    return textures_.spectrum_param(p, name, otherwise ? std::optional(constant(*otherwise)) : std::nullopt,
                                    SpectrumRole::Albedo);
}

/// The index of refraction of a boundary: "float eta" or "spectrum eta"; ours also by the coefficients of a formula.
Spd Materials::index(Params& p, std::string const& name) {
    using enum ParamType;
    auto const formula = [&](char const* coefficients, std::size_t count) -> std::vector<float> {
        auto const c = p.numbers(coefficients);
        if (c.empty()) return c;
        if (c.size() != count)
            p.fail("\"" + std::string(coefficients) + "\" needs " + std::to_string(count) + " numbers");
        if (p.find(name)) p.fail("give either \"" + name + "\" or \"" + coefficients + "\", not both");
        return c;
    };
    auto const checked = [&](std::optional<TabulatedSpd> table, char const* coefficients) -> Spd {
        if (!table)
            p.fail("\"" + std::string(coefficients) +
                   "\" gives no index of refraction between 360 and 830 nm (wavelengths are in micrometres)");
        return std::move(*table);
    };
    if (auto const c = formula("sellmeier", 6); !c.empty()) {
        auto const at = [&](std::size_t i) { return static_cast<double>(c[i]); };
        return checked(tabulated(Sellmeier{at(0), at(1), at(2), at(3), at(4), at(5)}), "sellmeier");
    }
    if (auto const c = formula("cauchy", 3); !c.empty())
        return checked(tabulated(Cauchy{static_cast<double>(c[0]), static_cast<double>(c[1]),
                                        static_cast<double>(c[2])}),
                       "cauchy");
    auto const* eta = p.find(name, {Float, Spectrum, Rgb, Blackbody, Texture});
    if (!eta) return ConstantSpd{1.5f};
    if (eta->type == Texture) {
        p.note("a texture for \"" + name + "\" is not rendered yet: 1.5 stands in");
        return ConstantSpd{1.5f};
    }
    if (eta->type != Float) return spd_of(context_, *eta, SpectrumRole::Unbounded);
    float const value = p.number(name, 1.5f);
    if (!(value > 0)) context_.fail(eta->where, "\"float " + name + "\" must be above 0 (glass: 1.5)");
    return ConstantSpd{value};
}

Roughness Materials::roughness(Params& p, std::string const& prefix) {
    Roughness r;
    auto const number = [&](std::string const& name) {
        auto const full = prefix + name;
        auto const* value = p.find(full, {ParamType::Float, ParamType::Texture});
        if (!value) return TextureId{};
        if (value->type == ParamType::Float) {
            float const x = p.number(full, 0);
            if (x < 0) context_.fail(value->where, "\"float " + full + "\" must not be negative");
            if (x > 1) p.note("\"" + full + "\" above 1 is rendered as 1");
        }
        return textures_.float_param(p, full, 0.0f);
    };
    TextureId const both = number("roughness");
    TextureId const u = number("uroughness");
    TextureId const v = number("vroughness");
    r.u = u.valid() ? u : both;
    r.v = v.valid() ? v : both;
    // One direction alone leaves the other smooth.
    if (r.u.valid() != r.v.valid()) (r.u.valid() ? r.v : r.u) = textures_.constant(0.0f, p.where());
    // pbrt's have no prefix. Ours may, where the two surfaces of a coated material differ.
    r.remap = p.boolean(prefix + "remaproughness", p.boolean("remaproughness", true));
    constexpr std::array kDistributions{Distribution::TrowbridgeReitz, Distribution::TrowbridgeReitz,
                                        Distribution::Beckmann, Distribution::Blinn};
    auto const distribution = [&](std::string const& name, std::size_t otherwise) {
        return p.choice(name, {"trowbridgereitz", "ggx", "beckmann", "blinn"}, otherwise);
    };
    r.distribution = kDistributions[distribution(prefix + "distribution", distribution("distribution", 0))];
    r.multiscatter = p.boolean(prefix + "multiscatter", p.boolean("multiscatter", false));
    return r;
}

/// What is inside: "integer priority", and absorption as a coefficient or as the colour that is left after a distance.
Interior Materials::interior(Params& p) {
    Interior inside;
    inside.priority = p.integer("priority", 0);
    if (inside.priority < 0) p.fail("\"priority\" must not be negative (0: overlaps with nothing)");
    auto const* absorption = p.find("absorption", {ParamType::Rgb, ParamType::Spectrum, ParamType::Float});
    auto const* color = p.find("attenuationcolor", {ParamType::Rgb});
    float const distance = p.number("attenuationdistance", 1);
    if (absorption && color) p.fail("give either \"absorption\" or \"attenuationcolor\", not both");
    if (absorption) {
        inside.absorption = absorption->type == ParamType::Float
                                ? Spd{ConstantSpd{p.number("absorption", 0)}}
                                : spd_of(context_, *absorption, SpectrumRole::Unbounded);
    } else if (color) {
        // Beer's law backwards: exp(-absorption distance) = color (KHR_materials_volume).
        if (!(distance > 0)) p.fail("\"attenuationdistance\" must be above 0");
        auto const spd = spd_of(context_, *color, SpectrumRole::Albedo);
        auto const& rgb = std::get<RgbAlbedoSpd>(spd).rgb;
        constexpr float kBlack = 1e-4f;  // ln 0 would be no number
        Vec3 sigma;
        for (int i = 0; i < 3; ++i) sigma[i] = -std::log(max(rgb[i], kBlack)) / distance;
        inside.absorption = RgbUnboundedSpd{sigma};
    }
    return inside;
}

ConductorMaterial Materials::conductor(Params& p, std::string const& prefix) {
    constexpr auto kRole = SpectrumRole::Unbounded;
    auto const eta = prefix + "eta", k = prefix + "k";
    ConductorMaterial m;
    // "reflectance" has no prefix, not even in coatedconductor.
    if (p.find("reflectance", kSpectral)) {
        if (p.find(eta, kSpectral) || p.find(k, kSpectral))
            p.fail("give either \"reflectance\" or \"" + eta + "\" and \"" + k + "\", not both");
        m.reflectance = albedo(p, "reflectance", std::nullopt);
        return m;
    }
    m.eta = textures_.spectrum_param(p, eta, copper("eta"), kRole);
    m.k = textures_.spectrum_param(p, k, copper("k"), kRole);
    return m;
}

/// The parameters that pbrt's two coated materials share; what is the interface's own has its prefix.
Coat Materials::coat(Params& p, std::string const& prefix) {
    Coat c;
    c.eta = index(p, prefix + "eta");
    c.roughness = roughness(p, prefix);
    c.thickness = textures_.float_param(p, "thickness", 0.01f);
    c.g = textures_.float_param(p, "g", 0.0f);
    // Black is no medium at all, and need not be evaluated to find that out.
    if (p.find("albedo", kSpectral)) c.albedo = albedo(p, "albedo", std::nullopt);
    auto const count = [&](char const* name, int otherwise) {
        int const n = p.integer(name, otherwise);
        if (n < 1 || n > 255) p.fail("\"" + std::string(name) + "\" must be between 1 and 255");
        return n;
    };
    c.max_depth = count("maxdepth", 10);
    c.samples = count("nsamples", 1);
    constexpr std::array kModels{CoatModel::Automatic, CoatModel::Stochastic, CoatModel::ClosedForm};
    c.model = kModels[p.choice("layers", {"auto", "stochastic", "closed"}, 0)];
    return c;
}

PlasticMaterial Materials::plastic(Params& p) {
    PlasticMaterial m;
    m.reflectance = albedo(p, "reflectance", 0.5f);
    m.specular = albedo(p, "specular", std::nullopt);
    m.eta = index(p, "eta");
    m.roughness = roughness(p, "");
    m.nonlinear = p.boolean("nonlinear", true);
    return m;
}

/// glTF's names without their capitals; textures and values alike.
MetallicRoughnessMaterial Materials::metallic_roughness(Params& p) {
    auto const number = [&](char const* name) { return textures_.float_param(p, name, std::nullopt); };
    MetallicRoughnessMaterial m;
    m.base_color = albedo(p, "basecolor", 1.0f);
    m.metallic = number("metallic");
    m.roughness = number("roughness");
    m.index = {p.number("ior", 1.5f), p.number("dispersion", 0)};
    if (m.index.ior != 0 && !(m.index.ior >= 1)) p.fail("\"ior\" must be 0 or at least 1");
    if (m.index.dispersion < 0) p.fail("\"dispersion\" must not be negative");
    m.specular = {number("specular"), albedo(p, "specularcolor", std::nullopt)};
    m.transmission.factor = number("transmission");
    m.transmission.thin = p.boolean("thinwalled", true);
    m.transmission.interior = interior(p);
    for (char const* name : {"priority", "absorption", "attenuationcolor"})
        if (m.transmission.thin && p.find(name))
            p.note("\"" + std::string(name) +
                   "\" is ignored: thin walls have no inside; set \"thinwalled\" to false");
    m.clearcoat = {number("clearcoat"), number("clearcoatroughness")};
    m.sheen = {albedo(p, "sheencolor", std::nullopt), number("sheenroughness")};
    m.anisotropy = {number("anisotropy"), p.angle("anisotropyrotation", 0)};
    m.multiscatter = p.boolean("multiscatter", true);
    return m;
}

MaterialKind Materials::mix(Params& p, Pending const& pending) {
    auto const names = p.strings("materials");
    if (names.size() != 2) p.fail("needs \"string materials\" with two names");
    std::array<MaterialId, 2> ids;
    for (std::size_t i = 0; i < 2; ++i) {
        auto const it = names_.find(names[i]);
        // As in pbrt, which makes all named ones first: a named one sees earlier ones only, so there is no cycle.
        bool const is_named = !pending.name.empty();
        auto const visible = [&](Name const& n) {
            return n.defined && (!is_named || n.order < pending.order);
        };
        if (it == names_.end() || !visible(it->second)) {
            std::vector<std::string> candidates;
            for (auto const& [name, entry] : names_)
                if (visible(entry)) candidates.push_back(name);
            p.fail("no material \"" + shown(names[i]) + "\" is defined" + (is_named ? " before" : "") +
                   did_you_mean(names[i], candidates));
        }
        ids[i] = it->second.id;
    }
    return MixMaterial{ids[0], ids[1], textures_.float_param(p, "amount", 0.5f)};
}

void Materials::perturb_normals(Params& p, Material& m) {
    m.displacement = textures_.float_param(p, "displacement", std::nullopt);
    auto const filename = p.string("normalmap", "");
    if (filename.empty()) return;
    auto const where = p.find("normalmap")->where;
    m.normal_map.image =
        context_.scene.add(ImageFile{context_.resolve(where, filename).string(), "linear", where});
    m.normal_map.scale = p.number("normalscale", 1);
}

}  // namespace nephroid
