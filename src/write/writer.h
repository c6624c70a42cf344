// Writes a Scene in pbrt-v4's language, in the order in which pbrt reads: settings, camera, textures,
// materials, objects, world.
#pragma once

#include "text.h"
#include "write/write.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace nephroid {

class Writer {
  public:
    /// With `portable`, the scene must have been made so by portable_scene().
    Writer(Scene const& scene, std::filesystem::path path, bool portable);

    SceneText write();

  private:
    [[noreturn]] void refuse(SourceLocation where, std::string const& what) const;

    // Settings and camera (settings.cpp, integrator.cpp, camera.cpp)
    void write_settings();
    void write_integrator();
    void write_camera();

    // Spectra (spectra.cpp)
    void spd(ParamText& p, std::string_view name, Spd const& spd, SpectrumRole role, SourceLocation where);
    /// An index of refraction: a number in pbrt, too.
    void index(ParamText& p, std::string_view name, Spd const& eta, SourceLocation where);
    void emission(ParamText& p, std::string_view name, Spd const& spd, SourceLocation where);
    /// `ColorSpace …` where an emission is a share of another white than usual, else "".
    [[nodiscard]] std::string color_space_of(Spd const& emission) const;

    // Textures (textures.cpp): parameters that are a value, or name a texture, which is then written first.
    void number(ParamText& p, std::string_view name, TextureId id, std::optional<float> otherwise,
                SourceLocation where);
    void spectrum(ParamText& p, std::string_view name, TextureId id, SpectrumRole role,
                  std::optional<float> otherwise, SourceLocation where);
    std::string const& texture(TextureId id, SpectrumRole role);
    void write_texture(std::string const& name, Texture const& texture, SpectrumRole role);
    bool is_spectrum(TextureId id) const;
    /// A parameter of a texture: of the texture's own type.
    void input(ParamText& p, std::string_view name, TextureId id, bool spectra, SpectrumRole role,
               float otherwise, SourceLocation where);
    /// The current transform whose inverse is `m`, for what is written next; adds "inverse" where it is
    /// needed.
    std::string inverse_transform(ParamText& p, Mat4 const& m, std::string const& name) const;
    void mapping(ParamText& p, TextureMapping const& m);

    // Materials (materials.cpp, coated.cpp)
    std::string const& material(MaterialId id);
    void write_material(std::string const& name, Material const& m);
    void roughness(ParamText& p, std::string const& prefix, Roughness const& r, SourceLocation where);
    void surface_of_facets(ParamText& p, std::string const& prefix, Roughness const& r);
    void interior(ParamText& p, Interior const& inside, SourceLocation where);
    void conductor(ParamText& p, std::string const& prefix, ConductorMaterial const& m, SourceLocation where);
    void coat(ParamText& p, std::string const& prefix, Coat const& c, SourceLocation where);
    void metallic_roughness(ParamText& p, MetallicRoughnessMaterial const& m, SourceLocation where);
    std::string const& medium(Spd const& absorption, SourceLocation where);

    // Lights (lights.cpp)
    void write_light(Light const& light);
    std::string area_light(AreaLight const& light);
    std::string lamp_file(IntensityTable const& table, SourceLocation where);

    // Shapes and groups (shapes.cpp, world.cpp)
    static bool has_face(Shape const& shape);
    std::string shape(Shape const& shape, std::string const& more, SourceLocation where);
    std::string ply_file(TriangleMesh const& mesh);
    std::string object(Object const& object);
    std::string content(Group const& group);
    std::string const& group(GroupId id);

    // Files (files.cpp)
    [[nodiscard]] std::string file_name(std::string const& path) const;
    std::string picture(ImageId id, std::string const& encoding, SourceLocation where) const;
    /// A file beside the scene, named by what it holds; its name in the scene.
    std::string part(std::string const& kind, std::string const& extension, std::string bytes);

    /// A name that nothing of its kind has: `wanted`, or with a number.
    static std::string unique(std::set<std::string>& taken, std::string const& wanted);

    Scene const& scene_;
    std::filesystem::path path_;
    bool portable_;
    std::string head_, textures_, media_, materials_, groups_, world_;
    std::map<std::pair<std::uint32_t, SpectrumRole>, std::string> texture_names_;
    std::map<std::uint32_t, std::string> material_names_, group_names_;
    std::map<std::string, std::string> medium_names_;  // by what they absorb, in words
    std::set<std::string> taken_textures_, taken_materials_, taken_groups_;
    std::map<std::string, SceneText::File> parts_;  // by their names
    std::vector<Note> notes_;
};

}  // namespace nephroid
