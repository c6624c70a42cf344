#include "media.h"

#include "scene/match.h"
#include "shown.h"
#include "spectra.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace nephroid {

namespace {

/// The same, `scale` times as much.
Spd scaled(Spd spd, float scale) {
    match(
        spd, [&](ConstantSpd& s) { s.value *= scale; },
        [&](TabulatedSpd& s) {
            for (float& v : s.value) v *= scale;
        },
        [&](RgbUnboundedSpd& s) { s.rgb *= scale; }, [](auto&) {});
    return spd;
}

/// pbrt's names for what only a scattering or emitting medium has.
constexpr std::array<char const*, 18> kIgnored{"preset",
                                               "g",
                                               "Le",
                                               "Lescale",
                                               "LeScale",
                                               "density",
                                               "temperature",
                                               "temperatureoffset",
                                               "temperaturecutoff",
                                               "temperaturescale",
                                               "nx",
                                               "ny",
                                               "nz",
                                               "p0",
                                               "p1",
                                               "wispiness",
                                               "frequency",
                                               "filename"};

}  // namespace

void Media::define(std::string const& name, Params& p) {
    auto const type = p.string("type", "");
    if (type.empty()) p.fail("needs a \"string type\"");
    Medium medium;
    medium.where = p.where();
    auto const* absorption = p.find("sigma_a", {ParamType::Rgb, ParamType::Spectrum});
    auto const* scattering = p.find("sigma_s", {ParamType::Rgb, ParamType::Spectrum});
    float const scale = p.number("scale", 1);
    bool const preset = p.find("preset") != nullptr;
    for (char const* ignored : kIgnored) p.find(ignored);
    if (type == "homogeneous" && !preset && scale >= 0) {
        // pbrt's default, of a liquid like milk, in 1 / mm.
        medium.absorption = absorption ? spd_of(context_, *absorption, SpectrumRole::Unbounded)
                                       : Spd{RgbUnboundedSpd{{0.0011f, 0.0024f, 0.014f}}};
        medium.absorption = scaled(std::move(*medium.absorption), scale);
        auto const black = [](Param const& q) {
            return q.type == ParamType::Rgb && q.floats == std::vector<float>{0, 0, 0};
        };
        if (!scattering || !black(*scattering))
            p.note("its scattering is not rendered yet, only what it absorbs inside dielectrics");
    } else {
        p.note("is not rendered yet: empty space stands in");
    }
    p.note_unused();
    if (!media_.emplace(name, std::move(medium)).second)
        context_.fail(p.where(), "medium \"" + shown(name) + "\" is already defined");
}

void Media::use(std::string const& name, SourceLocation where) { used_.try_emplace(name, where); }

void Media::surround(std::string const& name, SourceLocation where) { outside_.try_emplace(name, where); }

void Media::fill(GroupId group, std::string const& medium) {
    filled_.push_back({group, context_.scene.groups[group.value].objects.size(), medium});
}

void Media::finish() {
    std::vector<std::string> names;
    for (auto const& [name, medium] : media_) names.push_back(name);
    for (auto const& [name, where] : used_)
        if (!media_.contains(name))
            context_.note(where, "no medium \"" + shown(name) + "\" is defined" + did_you_mean(name, names));
    // Where it is inside of something else, that brings it along.
    for (auto const& [name, where] : outside_) {
        auto const medium = media_.find(name);
        if (medium == media_.end() || !medium->second.absorption) continue;
        if (std::none_of(filled_.begin(), filled_.end(),
                         [&name = name](Filled const& f) { return f.medium == name; }))
            context_.note(where,
                          "what medium \"" + shown(name) +
                              "\" absorbs outside of surfaces is not rendered, as nothing has it inside");
    }
    auto& scene = context_.scene;
    std::map<std::pair<std::uint32_t, std::string>, MaterialId> made;  // one material for each pair
    std::set<std::string> noted;
    for (Filled const& f : filled_) {
        auto const it = media_.find(f.medium);
        if (it == media_.end() || !it->second.absorption) continue;
        Object& object = scene.groups[f.group.value].objects[f.object];
        auto const* glass = std::get_if<DielectricMaterial>(&scene[object.material].kind);
        if (!glass) {
            if (noted.insert(f.medium).second)
                context_.note(object.where, "what medium \"" + shown(f.medium) +
                                                "\" absorbs is rendered inside dielectrics alone");
            continue;
        }
        MaterialId& id = made[{object.material.value, f.medium}];
        if (!id.valid()) {
            Material filled = scene[object.material];
            std::get<DielectricMaterial>(filled.kind).interior.absorption = *it->second.absorption;
            id = scene.add(std::move(filled));
        }
        object.material = id;
    }
}

}  // namespace nephroid
