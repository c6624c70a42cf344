#include "spectra.h"

#include "number.h"
#include "shown.h"

#include "spectrum/named.h"

#include <algorithm>

namespace nephroid {

namespace {

[[noreturn]] void fail_line(std::string const& name, std::uint32_t line, std::string const& message) {
    throw Error(ErrorKind::Input, name + ":" + std::to_string(line) + ": " + message);
}

Spd rgb_spd(Context& context, Param const& p, SpectrumRole role) {
    Vec3 const given{p.floats[0], p.floats[1], p.floats[2]};
    auto const declared_as = "parameter \"rgb " + shown(p.name) + "\"";
    if (role != SpectrumRole::Albedo && (given.x < 0 || given.y < 0 || given.z < 0))
        context.fail(p.where, declared_as + " has a negative component");
    Vec3 const linear = to_srgb(given, p.color_space);
    Vec3 rgb = max(linear, Vec3{0, 0, 0});
    if (role == SpectrumRole::Albedo) rgb = min(rgb, Vec3{1, 1, 1});
    if (rgb != linear)
        context.note(p.where,
                     declared_as + " is outside " +
                         (role == SpectrumRole::Albedo ? "[0,1] in linear sRGB" : "the gamut of sRGB") +
                         " and was clipped");
    switch (role) {
        case SpectrumRole::Albedo:
            return RgbAlbedoSpd{rgb};
        case SpectrumRole::Unbounded:
            return RgbUnboundedSpd{rgb};
        case SpectrumRole::Illuminant:
            break;
    }
    return RgbIlluminantSpd{rgb, white_of(p.color_space)};
}

Spd pairs_spd(Context& context, Param const& p) {
    TabulatedSpd t;
    for (std::size_t i = 0; i + 1 < p.floats.size(); i += 2) {
        if (i > 0 && p.floats[i] <= t.lambda.back())
            context.fail(p.where, "parameter \"spectrum " + shown(p.name) +
                                      "\": wavelengths must increase, but " + std::to_string(p.floats[i]) +
                                      " follows " + std::to_string(t.lambda.back()));
        t.lambda.push_back(p.floats[i]);
        t.value.push_back(p.floats[i + 1]);
    }
    return t;
}

}  // namespace

Spd spd_of(Context& context, Param const& p, SpectrumRole role) {
    auto const count = [&](std::size_t n, std::size_t wanted) {
        if (n != wanted)
            context.fail(p.where, "parameter \"" + std::string(type_name(p.type)) + " " + shown(p.name) +
                                      "\" needs " + std::to_string(wanted) + " values, not " +
                                      std::to_string(n));
    };
    if (p.type == ParamType::Rgb) {
        count(p.floats.size(), 3);
        return rgb_spd(context, p, role);
    }
    if (p.type == ParamType::Float) {
        count(p.floats.size(), 1);
        return ConstantSpd{p.floats[0]};
    }
    if (p.type == ParamType::Blackbody) {
        count(p.floats.size(), 1);
        if (!(p.floats[0] > 0))
            context.fail(p.where, "parameter \"blackbody " + shown(p.name) + "\" must be above 0 K");
        return BlackbodySpd{p.floats[0]};
    }
    if (p.strings.empty()) return pairs_spd(context, p);
    count(p.strings.size(), 1);
    auto const& name = p.strings[0];
    if (is_named_spectrum(name)) return NamedSpd{name};
    auto const path = context.resolve(p.where, name);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        auto const& names = named_spectrum_names();
        context.fail(p.where, "parameter \"spectrum " + shown(p.name) + "\": \"" + shown(name) +
                                  "\" is neither a named spectrum nor a file" +
                                  did_you_mean(name, {names.begin(), names.end()}));
    }
    return parse_spd(context.read_named(p.where, "spectrum", path), path.string());
}

Spd emission(Params& params, std::string_view name) {
    auto const* p =
        params.find(name, {ParamType::Rgb, ParamType::Spectrum, ParamType::Blackbody, ParamType::Float});
    if (p) return spd_of(params.context(), *p, SpectrumRole::Illuminant);
    return RgbIlluminantSpd{{1, 1, 1}, white_of(params.color_space())};
}

TabulatedSpd parse_spd(std::string_view text, std::string const& name) {
    TabulatedSpd t;
    std::uint32_t line_number = 0;
    bool expects_value = false;
    while (!text.empty()) {
        ++line_number;
        auto line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        line = line.substr(0, line.find('#'));
        while (true) {
            constexpr std::string_view kBlanks = " \t\r\v\f";
            line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
            if (line.empty()) break;
            auto const word = line.substr(0, line.find_first_of(kBlanks));
            line.remove_prefix(word.size());
            auto const v = parse_float(word);
            if (!v)
                fail_line(name, line_number,
                          "\"" + shown(word, 40) + "\" is not a finite number; lines are `wavelength value`");
            if (expects_value) {
                t.value.push_back(*v);
            } else {
                if (!t.lambda.empty() && *v <= t.lambda.back())
                    fail_line(name, line_number, "wavelengths must increase");
                t.lambda.push_back(*v);
            }
            expects_value = !expects_value;
        }
    }
    if (expects_value) fail_line(name, line_number, "the last wavelength has no value");
    if (t.lambda.empty()) throw Error(ErrorKind::Input, name + ": no samples; lines are `wavelength value`");
    return t;
}

}  // namespace nephroid
