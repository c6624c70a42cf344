// The directives after WorldBegin that put something into the scene.
#include "pbrt_reader.h"

#include "scene/match.h"

#include <algorithm>
#include <utility>

namespace nephroid {

namespace {
/// More than one primitive.
bool is_many(Shape const& shape) {
    return match(
        shape, [](TriangleMesh const& m) { return m.triangles.size() > 1; },
        [](BilinearMesh const& m) { return m.patches.size() > 1; },
        [](LoopSubdivision const& m) { return m.triangles.size() > 1 || m.levels > 0; },
        [](auto const&) { return false; });
}
}  // namespace

void PbrtReader::shape(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "Shape");
    auto p = params(tokens, "Shape", type, where, inherited(AttributeTarget::ForShape));
    Object object;
    object.where = where;
    if (state_.area_light) object.light = *state_.area_light;
    auto made = make_shape(type, p);
    bool const visible = made && read_alpha(p, object);
    p.note_unused();
    if (!visible) return;
    object.shape = std::move(*made);
    object.to_group = state_.start;
    note_motion(where);
    object.material = state_.material.valid() ? state_.material : materials_.standard();
    materials_.use(object.material);
    if (object.light && object.light->power >= 0 && is_many(object.shape))
        context_.note(where,
                      "the light's \"power\" is that of the whole mesh (pbrt gives it to each of its faces)");
    object.reverse_orientation = state_.reverse_orientation;
    if (object.light && group_ != GroupId{0})
        context_.note(where,
                      "an area light inside an object: each instance emits (pbrt would ignore the emission)");
    if (!state_.inside_medium.empty()) media_.fill(group_, state_.inside_medium);
    context_.scene.groups[group_.value].objects.push_back(std::move(object));
}

/// False when the object is invisible and dark, so that it can be left out.
bool PbrtReader::read_alpha(Params& p, Object& object) {
    auto const* alpha = p.find("alpha", {ParamType::Float, ParamType::Texture});
    if (!alpha) return true;
    if (alpha->type == ParamType::Texture) {
        // Textures may be defined later in the file: looked up at its end.
        alphas_.push_back({group_, context_.scene.groups[group_.value].objects.size(), *alpha});
        return true;
    }
    float const value = p.number("alpha", 1);
    if (value >= 1) return true;
    if (value <= 0 && !object.light) return false;
    object.alpha = textures_.constant(value, alpha->where);
    return true;
}

void PbrtReader::light_source(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "LightSource");
    auto p = params(tokens, "LightSource", type, where, inherited(AttributeTarget::ForLight));
    auto kind = make_light(type, p);
    p.note_unused();
    note_motion(where);
    context_.scene.add(Light{std::move(kind), state_.start, where});
}

void PbrtReader::area_light_source(Tokenizer& tokens, SourceLocation where) {
    auto const type = type_of(tokens, "AreaLightSource");
    auto p = params(tokens, "AreaLightSource", type, where, inherited(AttributeTarget::ForLight));
    state_.area_light = std::make_shared<AreaLight const>(make_area_light(type, p, textures_));
    p.note_unused();
}

void PbrtReader::material(Tokenizer& tokens, SourceLocation where) {
    auto type = type_of(tokens, "Material");
    auto list = parse_params(tokens, context_, state_.color_space);
    state_.material =
        materials_.define(std::move(type), std::move(list), inherited(AttributeTarget::ForMaterial), where);
}

void PbrtReader::make_named_material(Tokenizer& tokens, SourceLocation where) {
    auto name = type_of(tokens, "MakeNamedMaterial");
    auto list = parse_params(tokens, context_, state_.color_space);
    materials_.define_named(std::move(name), std::move(list), inherited(AttributeTarget::ForMaterial), where);
}

void PbrtReader::named_material(Tokenizer& tokens, SourceLocation where) {
    state_.material = materials_.named(type_of(tokens, "NamedMaterial"), where);
}

void PbrtReader::texture(Tokenizer& tokens, SourceLocation where) {
    auto name = type_of(tokens, "Texture");
    auto const type = required_string(tokens, context_, "Texture: type");
    auto kind = required_string(tokens, context_, "Texture: kind");
    auto list = parse_params(tokens, context_, state_.color_space);
    note_motion(where);
    // Only where it is named: a texture without a place in space does not mind a transform that has no inverse.
    std::optional<Mat4> exact_inverse;
    if (std::any_of(list.begin(), list.end(), [](Param const& p) { return p.name == "inverse"; })) {
        Params p(context_, "Texture \"" + shown(name) + "\"", where, list);
        exact_inverse = inverse_transform(p);
    }
    textures_.define(std::move(name), type, std::move(kind), std::move(list),
                     inherited(AttributeTarget::ForTexture), {state_.start, exact_inverse}, where);
}

void PbrtReader::make_named_medium(Tokenizer& tokens, SourceLocation where) {
    auto const name = type_of(tokens, "MakeNamedMedium");
    auto p = params(tokens, "MakeNamedMedium", name, where, inherited(AttributeTarget::ForMedium));
    media_.define(name, p);
}

void PbrtReader::medium_interface(Tokenizer& tokens, SourceLocation where) {
    state_.inside_medium = type_of(tokens, "MediumInterface");
    auto outside = state_.inside_medium;
    if (auto const token = tokens.next()) {
        if (token->kind == Token::Kind::String)
            outside = tokens.decode(*token);
        else
            tokens.unget(*token);
    }
    for (auto const& name : {state_.inside_medium, outside})
        if (!name.empty()) media_.use(name, where);
    if (!outside.empty() && outside != state_.inside_medium) media_.surround(outside, where);
}

void PbrtReader::reverse_orientation(Tokenizer& /*tokens*/, SourceLocation /*where*/) {
    state_.reverse_orientation = !state_.reverse_orientation;
}

void PbrtReader::finish_objects() {
    auto& scene = context_.scene;
    std::vector<std::string> defined;
    for (auto const& [name, object] : objects_)
        if (object.defined) defined.push_back(name);
    for (auto const& [name, object] : objects_)
        if (!object.defined)
            context_.fail(object.first_use,
                          "no object \"" + shown(name) + "\" is defined" + did_you_mean(name, defined));
    for (auto const& [group, index, param] : alphas_)
        scene.groups[group.value].objects[index].alpha = textures_.named_float(param);
    // Only now is it known which materials are interfaces.
    for (auto& group : scene.groups)
        for (auto& object : group.objects)
            if (object.light && std::holds_alternative<InterfaceMaterial>(scene[object.material].kind)) {
                context_.note(object.where,
                              "a surface of \"interface\" does not emit: its AreaLightSource is ignored");
                object.light.reset();
            }
}

}  // namespace nephroid
