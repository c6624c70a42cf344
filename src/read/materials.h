// Materials. They are made at the end of the file: as in pbrt, they may name textures and materials that come later.
#pragma once

#include "params.h"
#include "textures.h"

#include <map>

namespace nephroid {

class Materials {
  public:
    Materials(Context& context, Textures& textures) : context_(context), textures_(textures) {}

    MaterialId define(std::string type, ParamList params, SharedParams inherited, SourceLocation where);
    void define_named(std::string name, ParamList params, SharedParams inherited, SourceLocation where);
    /// The material of that name, which must be defined by the end of the file if a shape uses it.
    MaterialId named(std::string const& name, SourceLocation where);
    /// A shape is made of it: from now on its name has to be defined.
    void use(MaterialId id);
    /// pbrt's default: diffuse 0.5.
    MaterialId standard();

    void finish();

  private:
    struct Pending {
        MaterialId id;
        std::string type;  // empty for a named one: its parameters say
        ParamList params;
        SharedParams inherited;
        SourceLocation where;
        std::string name;
        std::size_t order = 0;
    };
    struct Name {
        MaterialId id;
        bool defined = false;
        SourceLocation first_use;
        std::size_t order = 0;
    };

    MaterialId reserve();
    void make(Pending& pending);
    MaterialKind kind_of(std::string const& type, Params& p, Pending const& pending);
    MaterialKind mix(Params& p, Pending const& pending);
    MaterialKind approximated(std::string const& type, Params& p);
    TextureId albedo(Params& p, std::string_view name, std::optional<float> otherwise);
    Spd index(Params& p, std::string const& name);
    Roughness roughness(Params& p, std::string const& prefix);
    Interior interior(Params& p);
    ConductorMaterial conductor(Params& p, std::string const& prefix);
    Coat coat(Params& p, std::string const& prefix);
    PlasticMaterial plastic(Params& p);
    MetallicRoughnessMaterial metallic_roughness(Params& p);
    void perturb_normals(Params& p, Material& m);

    Context& context_;
    Textures& textures_;
    std::vector<Pending> pending_;
    std::map<std::string, Name, std::less<>> names_;
    std::vector<bool> used_;  // by shapes; parallel to the first of the scene's materials
    std::size_t order_ = 0;
    MaterialId standard_;
};

}  // namespace nephroid
