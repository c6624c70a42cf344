#include "textures.h"
#include "shown.h"

#include "spectra.h"

#include <utility>

namespace nephroid {

void Textures::define(std::string name, std::string const& type, std::string kind, ParamList params,
                      SharedParams inherited, Place place, SourceLocation where) {
    if (type != "float" && type != "spectrum")
        context_.fail(where, "Texture \"" + shown(name) + "\": type \"" + shown(type) +
                                 "\" must be \"float\" or \"spectrum\"" +
                                 (type == "color" ? " (\"color\" is pbrt-v3's name for spectrum)" : ""));
    bool const spectrum = type == "spectrum";
    auto& names = spectrum ? spectrum_names_ : float_names_;
    if (auto const it = names.find(name); it != names.end())
        context_.fail(where, "texture \"" + shown(name) + "\" is already defined at " +
                                 context_.scene.locate(it->second->where));
    bool const picture = kind == "imagemap" || kind == "ptex";
    Rank const rank{picture ? 0 : spectrum ? 2 : 1, definitions_.size()};
    definitions_.push_back({name,
                            std::move(kind),
                            spectrum,
                            std::move(params),
                            std::move(inherited),
                            std::move(place),
                            where,
                            rank,
                            {}});
    names.emplace(std::move(name), &definitions_.back());
}

Textures::Definition& Textures::look_up(Param const& param, bool spectrum) {
    if (param.strings.size() != 1)
        context_.fail(param.where, "parameter \"texture " + shown(param.name) + "\" needs one name");
    auto const& names = spectrum ? spectrum_names_ : float_names_;
    auto const& name = param.strings[0];
    if (auto const it = names.find(name); it != names.end() && it->second->rank < visible_)
        return *it->second;

    std::string const type = spectrum ? "spectrum" : "float";
    auto const& others = spectrum ? float_names_ : spectrum_names_;
    if (others.contains(name))
        context_.fail(param.where, "parameter \"" + shown(param.name) + "\" needs a " + type +
                                       " texture, and \"" + shown(name) + "\" is a " +
                                       (spectrum ? "float" : "spectrum") + " texture");
    std::vector<std::string> candidates;
    for (auto const& [n, d] : names)
        if (d->rank < visible_) candidates.push_back(n);
    context_.fail(param.where,
                  "no " + type + " texture \"" + shown(name) + "\" is defined" +
                      (names.contains(name) ? " before this one" : did_you_mean(name, candidates)));
}

TextureId Textures::add(TextureKind kind, SourceLocation where) {
    return context_.scene.add(Texture{std::move(kind), where});
}
TextureId Textures::constant(float value, SourceLocation where) {
    return add(ConstantFloatTexture{value}, where);
}
TextureId Textures::constant(Spd value, SpectrumRole role, SourceLocation where) {
    return add(ConstantSpectrumTexture{std::move(value), role}, where);
}

TextureId Textures::named_float(Param const& param) {
    return make(look_up(param, false), SpectrumRole::Albedo);
}

TextureId Textures::float_param(Params& params, std::string_view name, std::optional<float> otherwise) {
    auto const* p = params.find(name, {ParamType::Float, ParamType::Texture});
    if (!p) return otherwise ? constant(*otherwise, params.where()) : TextureId{};
    if (p->type == ParamType::Texture) return named_float(*p);
    return constant(params.number(name, 0), p->where);
}

TextureId Textures::spectrum_param(Params& params, std::string_view name, std::optional<Spd> otherwise,
                                   SpectrumRole role) {
    auto const* p = params.find(name, {ParamType::Rgb, ParamType::Spectrum, ParamType::Texture,
                                       ParamType::Blackbody, ParamType::Float});
    if (!p) return otherwise ? constant(std::move(*otherwise), role, params.where()) : TextureId{};
    if (p->type == ParamType::Texture) return make(look_up(*p, true), role);
    return constant(spd_of(context_, *p, role), role, p->where);
}

TextureId Textures::input(Definition const& d, Params& p, std::string_view name, float otherwise,
                          SpectrumRole role) {
    if (!d.spectrum) return float_param(p, name, otherwise);
    return spectrum_param(p, name, Spd{ConstantSpd{otherwise}}, role);
}

TextureId Textures::make(Definition& d, SpectrumRole role) {
    auto& made = d.made[d.spectrum ? static_cast<std::size_t>(role) : 0];
    if (made.valid()) return made;
    constexpr int kMaxDepth =
        512;  // making and evaluating a texture recurses; validate() would refuse it as well
    if (++depth_ > kMaxDepth) context_.fail(d.where, "textures are nested more than 512 deep");
    bool const first = !d.made[0].valid() && !d.made[1].valid() && !d.made[2].valid();
    Params p(context_, "Texture \"" + shown(d.name) + "\" \"" + shown(d.kind) + "\"", d.where, d.params,
             d.inherited);
    auto const outer = std::exchange(visible_, d.rank);
    auto kind = kind_of(d, p, role);
    visible_ = outer;
    --depth_;
    if (first) p.note_unused();
    return made = add(std::move(kind), d.where);
}

void Textures::check_unused() {
    auto& scene = context_.scene;
    auto const textures = scene.textures.size();
    auto const images = scene.images.size();
    // Newest first: what an unused texture names counts as made by then, and is dropped with it.
    for (auto d = definitions_.rbegin(); d != definitions_.rend(); ++d)
        if (!d->made[0].valid() && !d->made[1].valid() && !d->made[2].valid()) make(*d, SpectrumRole::Albedo);
    scene.textures.resize(textures);
    scene.images.resize(images);
}

}  // namespace nephroid
