// Spectra as parameters.
#include "writer.h"

#include "scene/match.h"
#include "spectrum/named.h"

#include <cmath>

namespace nephroid {

namespace {

bool within(Vec3 rgb, float most) {
    return rgb.x >= 0 && rgb.y >= 0 && rgb.z >= 0 && rgb.x <= most && rgb.y <= most && rgb.z <= most;
}

/// As pbrt-v4 takes it: the same at both ends of what can be seen.
TabulatedSpd level(float value) { return {{360, 830}, {value, value}}; }

}  // namespace

void Writer::spd(ParamText& p, std::string_view name, Spd const& spd, SpectrumRole role,
                 SourceLocation where) {
    auto const rgb = [&](Vec3 v, SpectrumRole its_role, float most) {
        if (role != its_role) refuse(where, "an rgb of another role in \"" + std::string(name) + "\"");
        if (!within(v, most)) refuse(where, "an rgb beyond its range in \"" + std::string(name) + "\"");
        p.rgb(name, v);
    };
    match(
        spd,
        [&](ConstantSpd const& s) {
            if (portable_)
                p.spectrum(name, level(s.value));
            else
                p.number(name, s.value);
        },
        [&](TabulatedSpd const& s) { p.spectrum(name, s); },
        [&](BlackbodySpd const& s) { p.blackbody(name, s.kelvin); },
        [&](NamedSpd const& s) {
            if (!is_named_spectrum(s.name))
                refuse(where, "a spectrum of the unknown name \"" + s.name + "\"");
            p.spectrum(name, s.name);
        },
        [&](RgbAlbedoSpd const& s) { rgb(s.rgb, SpectrumRole::Albedo, 1); },
        [&](RgbUnboundedSpd const& s) { rgb(s.rgb, SpectrumRole::Unbounded, kInfinity); },
        [&](RgbIlluminantSpd const& s) { rgb(s.rgb, SpectrumRole::Illuminant, kInfinity); });
}

void Writer::index(ParamText& p, std::string_view name, Spd const& eta, SourceLocation where) {
    if (auto const* constant = std::get_if<ConstantSpd>(&eta))
        p.number(name, constant->value, 1.5f);
    else
        spd(p, name, eta, SpectrumRole::Unbounded, where);
}

void Writer::emission(ParamText& p, std::string_view name, Spd const& spectrum, SourceLocation where) {
    auto const* rgb = std::get_if<RgbIlluminantSpd>(&spectrum);
    if (rgb && rgb->rgb == Vec3{1, 1, 1}) return;  // the white of the colour space
    spd(p, name, spectrum, SpectrumRole::Illuminant, where);
}

std::string Writer::color_space_of(Spd const& emission) const {
    auto const* rgb = std::get_if<RgbIlluminantSpd>(&emission);
    if (!rgb || rgb->white == RgbWhite::D65) return {};
    // That space's numbers are not sRGB's; its white alone is no number.
    return rgb->rgb == Vec3{1, 1, 1} ? "  ColorSpace \"aces2065-1\"\n" : "  ColorSpace \"srgb-acesd60\"\n";
}

}  // namespace nephroid
