#include "pbrt_reader.h"

#include <utility>

namespace nephroid {

namespace {

enum class Allowed : std::uint8_t { Anywhere, BeforeWorld, InWorld };

/// Directives that older versions had, and what to do about them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kOldDirectives{
    {{"SurfaceIntegrator", "is of pbrt-v2; in pbrt-v4 it is Integrator"},
     {"VolumeIntegrator", "is of pbrt-v2; in pbrt-v4 write Integrator \"volpath\""},
     {"Renderer", "is of pbrt-v2; in pbrt-v4 there is only Integrator"},
     {"Volume", "is of pbrt-v2; in pbrt-v4 write MakeNamedMedium and MediumInterface"},
     {"MakeMedium", "is not a directive; write MakeNamedMedium"},
     {"TransformTime", "is not a directive; write TransformTimes"}}};

}  // namespace

struct PbrtReader::Directive {
    void (PbrtReader::*run)(Tokenizer&, SourceLocation);
    Allowed where;
};

std::map<std::string_view, PbrtReader::Directive> const& PbrtReader::directives() {
    using enum Allowed;
    using R = PbrtReader;
    static std::map<std::string_view, Directive> const table{
        {"Accelerator", {&R::accelerator, BeforeWorld}},
        {"ActiveTransform", {&R::active_transform, Anywhere}},
        {"AreaLightSource", {&R::area_light_source, InWorld}},
        {"Attribute", {&R::attribute, Anywhere}},
        {"AttributeBegin", {&R::attribute_begin, InWorld}},
        {"AttributeEnd", {&R::attribute_end, InWorld}},
        {"Camera", {&R::camera, BeforeWorld}},
        {"ColorSpace", {&R::color_space, Anywhere}},
        {"ConcatTransform", {&R::concat_transform, Anywhere}},
        {"CoordSysTransform", {&R::coord_sys_transform, Anywhere}},
        {"CoordinateSystem", {&R::coordinate_system, Anywhere}},
        {"Film", {&R::film, BeforeWorld}},
        {"Identity", {&R::identity, Anywhere}},
        {"Import", {&R::import, InWorld}},
        {"Include", {&R::include, Anywhere}},
        {"Integrator", {&R::integrator, BeforeWorld}},
        {"LightSource", {&R::light_source, InWorld}},
        {"LookAt", {&R::look, Anywhere}},
        {"MakeNamedMaterial", {&R::make_named_material, InWorld}},
        {"MakeNamedMedium", {&R::make_named_medium, Anywhere}},
        {"Material", {&R::material, InWorld}},
        {"MediumInterface", {&R::medium_interface, Anywhere}},
        {"NamedMaterial", {&R::named_material, InWorld}},
        {"ObjectBegin", {&R::object_begin, InWorld}},
        {"ObjectEnd", {&R::object_end, InWorld}},
        {"ObjectInstance", {&R::object_instance, InWorld}},
        {"Option", {&R::option, Anywhere}},
        {"PixelFilter", {&R::pixel_filter, BeforeWorld}},
        {"ReverseOrientation", {&R::reverse_orientation, InWorld}},
        {"Rotate", {&R::rotate_by, Anywhere}},
        {"Sampler", {&R::sampler, BeforeWorld}},
        {"Scale", {&R::scale_by, Anywhere}},
        {"Shape", {&R::shape, InWorld}},
        {"Texture", {&R::texture, InWorld}},
        {"Transform", {&R::transform, Anywhere}},
        {"TransformBegin", {&R::transform_begin, InWorld}},
        {"TransformEnd", {&R::attribute_end, InWorld}},
        {"TransformTimes", {&R::transform_times, BeforeWorld}},
        {"Translate", {&R::translate_by, Anywhere}},
        {"WorldBegin", {&R::world_begin, BeforeWorld}},
        {"WorldEnd", {&R::world_end, InWorld}},
    };
    return table;
}

void PbrtReader::run(Tokenizer& tokens) {
    auto const& table = directives();
    while (auto const token = tokens.next()) {
        auto const it = token->kind == Token::Kind::Word ? table.find(token->text) : table.end();
        if (it == table.end()) unknown_directive(tokens, *token);
        auto const& [handler, allowed] = it->second;
        auto const where = tokens.at(*token);
        if (allowed == Allowed::BeforeWorld && in_world_)
            context_.fail(where, it->first == "WorldBegin"
                                     ? "a second WorldBegin; a scene has one"
                                     : std::string(it->first) + " must stand before WorldBegin");
        if (allowed == Allowed::InWorld && !in_world_)
            context_.fail(where, std::string(it->first) + " must stand after WorldBegin");
        (this->*handler)(tokens, where);
    }
}

void PbrtReader::unknown_directive(Tokenizer& tokens, Token const& token) {
    auto const word = shown(token.text, 40);
    auto const where = tokens.at(token);
    if (token.kind != Token::Kind::Word)
        context_.fail(where, "\"" + word + "\" stands where a directive such as Shape should be");
    for (auto const& [old, advice] : kOldDirectives)
        if (token.text == old) context_.fail(where, word + " " + std::string(advice));
    std::vector<std::string> names;
    for (auto const& [name, d] : directives()) names.emplace_back(name);
    context_.fail(where, "unknown directive " + word + did_you_mean(word, names));
}

Params PbrtReader::params(Tokenizer& tokens, char const* directive, std::string const& type,
                          SourceLocation where, SharedParams inherited) {
    auto own = parse_params(tokens, context_, state_.color_space);
    return {context_,
            std::string(directive) + " \"" + shown(type) + "\"",
            where,
            std::move(own),
            std::move(inherited),
            state_.color_space};
}

Scene PbrtReader::read(std::string_view text, std::string shown, std::filesystem::path const& folder,
                       std::filesystem::path const& path) {
    if (!path.empty()) {
        std::error_code ignored;
        open_files_.push_back(std::filesystem::weakly_canonical(path, ignored));
    }
    auto const file = context_.add_file(std::move(shown), folder);
    Tokenizer tokens(context_.scene, file, text);
    run(tokens);
    if (!in_world_)
        context_.fail({file, 0},
                      "the file ends before WorldBegin: a scene needs one, with the shapes after it");
    return finish();
}

Scene PbrtReader::finish() {
    if (!saved_.empty()) {
        auto const& open = saved_.back();
        context_.fail(open.where, open.kind == 'o' ? "ObjectBegin without an ObjectEnd"
                                                   : "AttributeBegin without an AttributeEnd");
    }
    materials_.finish();
    finish_objects();
    media_.finish();
    textures_.check_unused();
    auto& settings = context_.scene.settings;
    if (auto const seed = sampler_seed_ ? sampler_seed_ : integrator_seed_)
        settings.seed = static_cast<std::uint64_t>(*seed);
    if (!settings.color_given) settings.color = default_color(settings.integrator);
    context_.finish_notes();
    return std::move(context_.scene);
}

}  // namespace nephroid
