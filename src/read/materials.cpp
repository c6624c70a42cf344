#include "materials.h"
#include "shown.h"

#include <utility>

namespace nephroid {

MaterialId Materials::reserve() { return context_.scene.add(Material{}); }

MaterialId Materials::define(std::string type, ParamList params, SharedParams inherited,
                             SourceLocation where) {
    auto const id = reserve();
    pending_.push_back({id, std::move(type), std::move(params), std::move(inherited), where, {}, ++order_});
    return id;
}

MaterialId Materials::named(std::string const& name, SourceLocation where) {
    auto const [it, is_new] = names_.try_emplace(name);
    if (is_new) it->second.id = reserve(), it->second.first_use = where;
    return it->second.id;
}

void Materials::define_named(std::string name, ParamList params, SharedParams inherited,
                             SourceLocation where) {
    auto const id = named(name, where);
    auto& entry = names_.find(name)->second;
    if (entry.defined) context_.fail(where, "material \"" + shown(name) + "\" is already defined");
    entry.defined = true;
    entry.order = ++order_;
    pending_.push_back({id, {}, std::move(params), std::move(inherited), where, std::move(name), order_});
}

void Materials::use(MaterialId id) {
    if (used_.size() <= id.value) used_.resize(id.value + 1);
    used_[id.value] = true;
}

MaterialId Materials::standard() {
    if (!standard_.valid()) {
        auto const gray = textures_.constant(Spd{ConstantSpd{0.5f}}, SpectrumRole::Albedo, {});
        standard_ = reserve();
        context_.scene.materials[standard_.value].kind = DiffuseMaterial{gray};
    }
    return standard_;
}

void Materials::finish() {
    std::vector<std::string> defined;
    for (auto const& [name, entry] : names_)
        if (entry.defined) defined.push_back(name);
    for (auto const& [name, entry] : names_)
        if (!entry.defined) {
            auto const message =
                "no material \"" + shown(name) + "\" is defined" + did_you_mean(name, defined);
            if (entry.id.value < used_.size() && used_[entry.id.value])
                context_.fail(entry.first_use, message);
            context_.note(entry.first_use, message + ", but no shape uses it");
            context_.scene.materials[entry.id.value].kind = InterfaceMaterial{};
        }
    for (auto& pending : std::exchange(pending_, {})) make(pending);
}

void Materials::make(Pending& pending) {
    bool const is_named = !pending.name.empty();
    auto what = is_named ? "MakeNamedMaterial \"" + shown(pending.name) + "\""
                         : "Material \"" + shown(pending.type) + "\"";
    Params p(context_, std::move(what), pending.where, std::move(pending.params),
             std::move(pending.inherited));
    auto type = pending.type;
    if (is_named) {
        type = p.string("type", "");
        if (type.empty()) p.fail("needs a \"string type\"");
    }
    Material m{kind_of(type, p, pending), pending.name, pending.where, {}, {}};
    bool const has_surface =
        !std::holds_alternative<InterfaceMaterial>(m.kind) && !std::holds_alternative<MixMaterial>(m.kind);
    if (has_surface) perturb_normals(p, m);
    p.note_unused();
    context_.scene.materials[pending.id.value] = std::move(m);
}

}  // namespace nephroid
