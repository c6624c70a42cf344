#include "ray_materials.h"

#include "params.h"
#include "shown.h"

#include <algorithm>

namespace nephroid {

RayColour RayMaterials::colour(RayInput& in, std::string_view what) {
    in.need('=');
    if (!in.peek().is("map")) return {in.colour(what), {}};
    in.take();
    in.need('(');
    auto const where = in.here();
    auto name = in.text();
    in.need(')');
    std::replace(name.begin(), name.end(), '\\', '/');  // many of these files are from Windows
    auto& context = in.context();
    return {{}, context.scene.add(ImageFile{context.resolve(where, name).string(), "", where})};
}

float RayMaterials::scalar(RayInput& in, std::string_view what, float otherwise) {
    in.need('=');
    if (!in.peek().is("map")) return in.real();
    in.context().note(in.here(), std::string(what) + " cannot vary over a surface: its map is not used");
    in.take();
    in.skip_nest();
    return otherwise;
}

void RayMaterials::define(RayInput const& in, SharedPhong const& phong) {
    auto const [it, is_new] = names_.try_emplace(phong->name, phong);
    auto const& context = in.context();
    if (!is_new)
        context.fail(phong->where, "material \"" + shown(phong->name) + "\" is already defined at " +
                                       context.scene.locate(it->second->where) + "; give it another name");
}

SharedPhong RayMaterials::read(RayInput& in, SharedPhong const& parent) {
    auto const where = in.here();
    if (in.peek().kind == RayToken::Kind::Name || in.peek().kind == RayToken::Kind::String) {
        auto const name = in.peek().text;
        auto const it = names_.find(name);
        if (it == names_.end()) {
            std::vector<std::string> known;
            for (auto const& [other, phong] : names_) known.push_back(other);
            in.fail("no material \"" + shown(name) + "\" is defined before" + did_you_mean(name, known));
        }
        in.take();
        return it->second;
    }
    Phong m = *parent;
    m.name.clear();
    m.where = where;
    bool own_reflective = false;
    in.block("the material",
             {{"emissive", {}, [&] { m.emissive = colour(in, "emissive"); }},
              {"ambient", {}, [&] { m.ambient = colour(in, "ambient"); }},
              {"diffuse", {}, [&] { m.diffuse = colour(in, "diffuse"); }},
              {"specular",
               {},
               [&] {
                   m.specular = colour(in, "specular");
                   if (!own_reflective)
                       m.reflective = m.specular;  // so they said: what shines mirrors as much
               }},
              {"reflective", {}, [&] { m.reflective = colour(in, "reflective"), own_reflective = true; }},
              {"transmissive", {}, [&] { m.transmissive = colour(in, "transmissive"); }},
              {"shininess",
               {},
               [&] {
                   auto const at = in.here();
                   m.shininess = scalar(in, "shininess", m.shininess);
                   if (m.shininess < 0) in.context().fail(at, "the shininess must not be negative");
               }},
              {"index",
               {},
               [&] {
                   auto const at = in.here();
                   m.index = scalar(in, "index", m.index);
                   if (!(m.index >= 1e-3f && m.index <= 1e3f))
                       in.context().fail(at, "the index must be between 0.001 and 1000 (glass: 1.5)");
               }},
              {"name", {}, [&] {
                   in.take_if('=');  // there are files without it
                   m.name = in.text();
               }}});
    auto const phong = std::make_shared<Phong const>(std::move(m));
    if (!phong->name.empty()) define(in, phong);
    return phong;
}

}  // namespace nephroid
