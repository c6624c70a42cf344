// The kinds of materials, with pbrt-v4's parameters and defaults.
#include "materials.h"
#include "shown.h"
#include "spectra.h"

#include <array>
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
constexpr auto kSpectral = {ParamType::Rgb, ParamType::Spectrum, ParamType::Texture, ParamType::Blackbody};

Spd copper(char const* what) { return NamedSpd{std::string("metal-Cu-") + what}; }

}  // namespace

MaterialKind Materials::kind_of(std::string const& type, Params& p, Pending const& pending) {
    if (type == "mix") return mix(p, pending);
    if (type == "interface") return InterfaceMaterial{};
    if (type.empty() || type == "none") {
        p.note("is pbrt-v3's name; in pbrt-v4 it is \"interface\"");
        return InterfaceMaterial{};
    }
    if (type == "diffuse") {
        auto m = diffuse(p, 0.5f);
        note_displaced(p);
        return m;
    }
    if (type == "dielectric") {
        DielectricMaterial m{index(p), {}, {}};
        note_rough(p);
        note_displaced(p);
        return m;
    }
    if (type == "thindielectric") {
        ThinDielectricMaterial m{index(p)};
        note_displaced(p);
        return m;
    }
    if (type == "conductor") {
        auto m = conductor(p, "");
        note_rough(p);
        note_displaced(p);
        return m;
    }
    return approximated(type, p);
}

MaterialKind Materials::approximated(std::string const& type, Params& p) {
    struct Diffuse {
        char const* type;
        float reflectance;
    };
    for (auto const [name, reflectance] : {Diffuse{"coateddiffuse", 0.5f},
                                           {"diffusetransmission", 0.25f},
                                           {"subsurface", 0.5f},
                                           {"measured", 0.5f},
                                           {"sheen", 0.5f},
                                           {"cloth", 0.5f}})
        if (type == name) {
            p.note("\"" + shown(type) +
                   "\" is not rendered yet: a diffuse surface of its reflectance stands in");
            p.ignore_all();
            return diffuse(p, reflectance);
        }
    if (type == "hair") {
        p.note("\"hair\" is not rendered yet: a diffuse surface of its color stands in");
        p.ignore_all();
        auto const* name = p.find("color", kSpectral) ? "color" : "reflectance";
        return DiffuseMaterial{
            textures_.spectrum_param(p, name, Spd{ConstantSpd{0.5f}}, SpectrumRole::Albedo)};
    }
    if (type == "coatedconductor") {
        p.note("\"coatedconductor\" is not rendered yet: its smooth conductor stands in, without the coat");
        p.ignore_all();
        return conductor(p, "conductor.");
    }
    for (auto const& [old, now] : kOldNames)
        if (type == old)
            p.fail("material \"" + shown(type) + "\" is of pbrt-v3; in pbrt-v4 write " + std::string(now));
    p.fail("unknown material \"" + shown(type) + "\"" +
           did_you_mean(type, {"diffuse", "dielectric", "thindielectric", "conductor", "coateddiffuse",
                               "coatedconductor", "diffusetransmission", "subsurface", "hair", "measured",
                               "mix", "interface"}));
}

MaterialKind Materials::diffuse(Params& p, float reflectance) {
    return DiffuseMaterial{
        textures_.spectrum_param(p, "reflectance", Spd{ConstantSpd{reflectance}}, SpectrumRole::Albedo)};
}

/// The index of refraction of a boundary: "float eta" or "spectrum eta".
Spd Materials::index(Params& p) {
    using enum ParamType;
    auto const* eta = p.find("eta", {Float, Spectrum, Rgb, Blackbody, Texture});
    if (!eta) return ConstantSpd{1.5f};
    if (eta->type == Texture) {
        p.note("a texture for \"eta\" is not rendered yet: 1.5 stands in");
        return ConstantSpd{1.5f};
    }
    if (eta->type != Float) return spd_of(context_, *eta, SpectrumRole::Unbounded);
    float const value = p.number("eta", 1.5f);
    if (!(value > 0)) context_.fail(eta->where, "\"float eta\" must be above 0 (glass: 1.5)");
    return ConstantSpd{value};
}

MaterialKind Materials::conductor(Params& p, std::string const& prefix) {
    constexpr auto kRole = SpectrumRole::Unbounded;
    auto const eta = prefix + "eta", k = prefix + "k";
    ConductorMaterial m;
    // "reflectance" has no prefix, not even in coatedconductor.
    if (p.find("reflectance", kSpectral)) {
        if (p.find(eta, kSpectral) || p.find(k, kSpectral))
            p.fail("give either \"reflectance\" or \"" + eta + "\" and \"" + k + "\", not both");
        m.reflectance = textures_.spectrum_param(p, "reflectance", {}, SpectrumRole::Albedo);
        return m;
    }
    m.eta = textures_.spectrum_param(p, eta, copper("eta"), kRole);
    m.k = textures_.spectrum_param(p, k, copper("k"), kRole);
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

void Materials::note_rough(Params& p) {
    p.find("remaproughness");
    bool rough = false;
    for (char const* name : {"roughness", "uroughness", "vroughness"}) {
        auto const* r = p.find(name, {ParamType::Float, ParamType::Texture});
        if (r) rough |= r->type == ParamType::Texture || p.number(name, 0) != 0;
    }
    if (rough) p.note("roughness is not rendered yet: the smooth surface stands in");
}

void Materials::note_displaced(Params& p) {
    if (p.find("displacement", {ParamType::Float, ParamType::Texture}))
        p.note("displacement is not rendered yet");
    if (p.find("normalmap", {ParamType::String})) p.note("normal maps are not rendered yet");
}

}  // namespace nephroid
