// The directives before WorldBegin.
#include "pbrt_reader.h"

#include "number.h"
#include "scene/match.h"

#include <algorithm>
#include <cctype>

namespace nephroid {

void PbrtReader::camera(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "Camera");
    auto p = params(tokens, "Camera", type, where);
    context_.scene.camera = make_camera(type, p, inverse_transform(p));
    p.note_unused();
    note_motion(where);
    auto const end = inverse(state_.end);
    coordinate_systems_["camera"] = {context_.scene.camera.to_world,
                                     end.value_or(context_.scene.camera.to_world)};
}

void PbrtReader::film(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "Film");
    auto p = params(tokens, "Film", type, where);
    context_.scene.settings.film = make_film(type, p);
    if (state_.color_space != FileColorSpace::Srgb && state_.color_space != FileColorSpace::SrgbAcesD60)
        context_.note(where,
                      "the ColorSpace at Film would be that of pbrt's picture: here pictures are in sRGB");
    p.note_unused();
}

void PbrtReader::pixel_filter(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "PixelFilter");
    auto p = params(tokens, "PixelFilter", type, where);
    context_.scene.settings.filter = make_filter(type, p);
    context_.scene.settings.filter_where = where;
    p.note_unused();
}

void PbrtReader::sampler(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "Sampler");
    auto p = params(tokens, "Sampler", type, where);
    auto const made = make_sampler(type, p);
    context_.scene.settings.sampler = made.sampler;
    context_.scene.settings.spp = made.spp;
    context_.scene.settings.sampler_where = where;
    sampler_seed_ = made.seed;
    p.note_unused();
}

void PbrtReader::integrator(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "Integrator");
    auto p = params(tokens, "Integrator", type, where);
    auto& settings = context_.scene.settings;
    settings.integrator = make_integrator(type, p);
    settings.integrator_where = where;
    bool const shoots = match(settings.integrator, [](auto const& i) {
        return requires { i.shooting; }
        || requires { i.paths; };
    });
    integrator_seed_.reset();
    if (shoots && p.find("seed")) integrator_seed_ = p.integer("seed", 0);
    p.note_unused();
}

void PbrtReader::accelerator(Tokenizer& tokens, SourceLocation /*where*/) {
    // Which structure finds the hits changes no picture.
    type_of(tokens, "Accelerator");
    parse_params(tokens, context_, state_.color_space);
}

void PbrtReader::color_space(Tokenizer& tokens, SourceLocation where) {
    auto const name = type_of(tokens, "ColorSpace");
    auto const space = file_color_space(name);
    if (!space)
        context_.fail(where, "unknown color space \"" + shown(name) + "\"" +
                                 did_you_mean(name, {"srgb", "dci-p3", "rec2020", "aces2065-1"}) +
                                 "; use srgb, dci-p3, rec2020 or aces2065-1");
    state_.color_space = *space;
}

/// `Option "name" value`, or with a type before the name as in parameter lists.
void PbrtReader::option(Tokenizer& tokens, SourceLocation where) {
    auto const declared = type_of(tokens, "Option");
    auto const blank = declared.find_last_of(" \t");
    std::string name;
    for (char const c : blank == std::string::npos ? declared : declared.substr(blank + 1))
        if (c != '-' && c != '_')
            name.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));

    auto token = tokens.next();
    bool const bracketed = token && token->kind == Token::Kind::Open;
    if (bracketed) token = tokens.next();
    if (!token || token->kind == Token::Kind::Open || token->kind == Token::Kind::Close)
        context_.fail(where, "Option \"" + shown(declared) + "\" has no value");
    std::string const value =
        token->kind == Token::Kind::String ? tokens.decode(*token) : std::string(token->text);
    if (bracketed) {
        auto const close = tokens.next();
        if (!close || close->kind != Token::Kind::Close)
            context_.fail(where, "Option \"" + shown(declared) + "\" must have one value");
    }

    auto const fail = [&](char const* wanted) {
        context_.fail(where,
                      "Option \"" + shown(declared) + "\": \"" + shown(value, 40) + "\" is not " + wanted);
    };
    auto& settings = context_.scene.settings;
    if (name == "seed") {
        auto const seed = parse_int(value);
        if (!seed) fail("an integer");
        settings.seed = static_cast<std::uint64_t>(*seed);
    } else if (name == "color") {
        if (value != "rgb" && value != "spectral") fail("\"rgb\" or \"spectral\"");
        settings.color = value == "rgb" ? ColorMode::Rgb : ColorMode::Spectral;
        settings.color_given = true;
    } else {
        static std::vector<std::string> const kPbrt{"disablepixeljitter",
                                                    "disabletexturefiltering",
                                                    "disablewavelengthjitter",
                                                    "displacementedgescale",
                                                    "forcediffuse",
                                                    "msereferenceimage",
                                                    "msereferenceout",
                                                    "pixelstats",
                                                    "rendercoordsys",
                                                    "wavefront",
                                                    "interactive",
                                                    "seed",
                                                    "color"};
        bool const known = std::find(kPbrt.begin(), kPbrt.end(), name) != kPbrt.end();
        context_.note(
            where, "Option \"" + shown(declared) + "\" " +
                       (known ? "has no effect here" : "is unknown and ignored" + did_you_mean(name, kPbrt)));
    }
}

}  // namespace nephroid
