// Objects, groups, and the whole.
#include "writer.h"

#include "scene/affine_rows.h"

#include <utility>

namespace nephroid {

Writer::Writer(Scene const& scene, std::filesystem::path path, bool portable)
    : scene_(scene), path_(std::move(path)), portable_(portable) {}

void Writer::refuse(SourceLocation where, std::string const& what) const {
    scene_.fail(where, what + " has no form in pbrt's language; change that, and convert again");
}

std::string Writer::object(Object const& o) {
    // compile() leaves it out as well, before it makes the scene's hash.
    if (!has_face(o.shape)) return notes_.push_back({o.where, "a mesh without a face is left out"}), "";
    std::string out = "AttributeBegin\n";
    if (!is_identity(o.to_group)) out += "  Transform" + matrix_text(o.to_group) + '\n';
    if (!o.material.valid()) refuse(o.where, "an object without a material");
    if (o.light && std::holds_alternative<InterfaceMaterial>(scene_[o.material].kind))
        refuse(o.where, "a surface of \"interface\" that emits");
    out += "  NamedMaterial " + in_quotes(material(o.material)) + '\n';
    if (portable_)
        if (auto const* glass = std::get_if<DielectricMaterial>(&scene_[o.material].kind)) {
            auto const* none = std::get_if<ConstantSpd>(&glass->interior.absorption);
            if (!none || none->value != 0)
                out +=
                    "  MediumInterface " + in_quotes(medium(glass->interior.absorption, o.where)) + " \"\"\n";
        }
    if (o.light) out += area_light(*o.light);
    if (o.reverse_orientation) out += "  ReverseOrientation\n";
    ParamText p;
    if (o.alpha.valid()) {
        // As a value it would be taken for solid at 1, and leave dark objects out at 0.
        auto const* constant = std::get_if<ConstantFloatTexture>(&scene_[o.alpha].kind);
        bool const as_value = constant && constant->value < 1 && (constant->value > 0 || o.light);
        if (as_value)
            p.number("alpha", constant->value);
        else
            p.texture("alpha", texture(o.alpha, SpectrumRole::Albedo));
    }
    return out + shape(o.shape, p.text(), o.where) + "AttributeEnd\n";
}

std::string Writer::content(Group const& g) {
    std::string out;
    for (Object const& o : g.objects) out += object(o);
    for (Instance const& i : g.instances) {
        Mat4 const m = matrix_of(i.to_parent);
        std::string const instance = "ObjectInstance " + in_quotes(group(i.group)) + '\n';
        if (is_identity(m))
            out += instance;
        else
            out += "AttributeBegin\n  Transform" + matrix_text(m) + "\n  " + instance + "AttributeEnd\n";
    }
    return out;
}

std::string const& Writer::group(GroupId id) {
    auto const found = group_names_.find(id.value);
    if (found != group_names_.end()) return found->second;
    Group const& g = scene_[id];
    std::string const name =
        unique(taken_groups_, g.name.empty() ? "object " + std::to_string(taken_groups_.size() + 1) : g.name);
    // First what it is made of.
    std::string const inside = content(g);
    groups_ += "ObjectBegin " + in_quotes(name) + '\n' + inside + "ObjectEnd\n";
    return group_names_[id.value] = name;
}

SceneText Writer::write() {
    // In the scene's order, those that nothing uses as well: materials keep their numbers, which a film's layer tells.
    if (!portable_)
        for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) material(MaterialId{i});
    for (Light const& light : scene_.lights) write_light(light);
    world_ += content(scene_.world());
    write_settings();
    write_camera();
    SceneText out;
    out.scene = {path_, "# Written by nephroid convert.\n" + head_ + "\nWorldBegin\n" + textures_ + media_ +
                            materials_ + groups_ + world_};
    for (auto& [name, part] : parts_) out.parts.push_back(std::move(part));
    out.notes = std::move(notes_);
    return out;
}

}  // namespace nephroid
