// Reads pbrt-v4 scenes: walks through directives, keeps the graphics state, and fills a Scene.
#pragma once

#include "context.h"
#include "lights.h"
#include "materials.h"
#include "media.h"
#include "options.h"
#include "param_parser.h"
#include "shapes.h"
#include "shown.h"
#include "textures.h"
#include "tokenizer.h"

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

namespace nephroid {

/// What `Attribute` may set parameters for; indexes GraphicsState::attributes.
enum class AttributeTarget : std::uint8_t { ForShape, ForLight, ForMaterial, ForMedium, ForTexture };

/// What AttributeBegin saves. The start transform is what is rendered; the end transform is kept to notice motion.
struct GraphicsState {
    Mat4 start, end;
    bool start_active = true, end_active = true;
    bool reverse_orientation = false;
    FileColorSpace color_space = FileColorSpace::Srgb;
    MaterialId material;  // none: pbrt's default
    std::string inside_medium;
    std::shared_ptr<AreaLight const> area_light;
    std::array<SharedParams, 5> attributes;
};

class PbrtReader {
  public:
    PbrtReader() : textures_(context_), materials_(context_, textures_), media_(context_) {}

    /// `path` is empty for text that is in no file.
    Scene read(std::string_view text, std::string shown, std::filesystem::path const& folder,
               std::filesystem::path const& path);

  private:
    struct Directive;
    struct Saved {
        GraphicsState state;
        char kind = 'a';  // attribute or object
        SourceLocation where;
    };
    struct ObjectName {
        GroupId group;
        bool defined = false;
        SourceLocation first_use;
    };
    struct PendingAlpha {
        GroupId group;
        std::size_t object;
        Param param;
    };

    static std::map<std::string_view, Directive> const& directives();
    void run(Tokenizer& tokens);
    [[noreturn]] void unknown_directive(Tokenizer& tokens, Token const& token);
    Scene finish();

    // Blocks (pbrt_blocks.cpp)
    void world_begin(Tokenizer&, SourceLocation);
    void world_end(Tokenizer&, SourceLocation);
    void attribute_begin(Tokenizer&, SourceLocation);
    void attribute_end(Tokenizer&, SourceLocation);
    void transform_begin(Tokenizer&, SourceLocation);
    void attribute(Tokenizer&, SourceLocation);
    void object_begin(Tokenizer&, SourceLocation);
    void object_end(Tokenizer&, SourceLocation);
    void object_instance(Tokenizer&, SourceLocation);
    void include(Tokenizer&, SourceLocation);
    void import(Tokenizer&, SourceLocation);
    void push(char kind, SourceLocation where);
    /// False, with a note, where nothing is open.
    bool pop(char kind, SourceLocation where);
    void run_file(Tokenizer& tokens, SourceLocation where, char const* what);

    // Transforms (pbrt_transforms.cpp)
    void identity(Tokenizer&, SourceLocation);
    void translate_by(Tokenizer&, SourceLocation);
    void scale_by(Tokenizer&, SourceLocation);
    void rotate_by(Tokenizer&, SourceLocation);
    void look(Tokenizer&, SourceLocation);
    void transform(Tokenizer&, SourceLocation);
    void concat_transform(Tokenizer&, SourceLocation);
    void coordinate_system(Tokenizer&, SourceLocation);
    void coord_sys_transform(Tokenizer&, SourceLocation);
    void active_transform(Tokenizer&, SourceLocation);
    void transform_times(Tokenizer&, SourceLocation);
    void concat(Mat4 const& m, SourceLocation where);
    Mat4 matrix(Tokenizer& tokens, char const* what);
    void note_motion(SourceLocation where);
    /// The inverse of the current transform; the exact one where "string inverse" names a coordinate system that is it.
    Mat4 inverse_transform(Params& p);

    // Options (pbrt_options.cpp)
    void camera(Tokenizer&, SourceLocation);
    void film(Tokenizer&, SourceLocation);
    void pixel_filter(Tokenizer&, SourceLocation);
    void sampler(Tokenizer&, SourceLocation);
    void integrator(Tokenizer&, SourceLocation);
    void accelerator(Tokenizer&, SourceLocation);
    void option(Tokenizer&, SourceLocation);
    void color_space(Tokenizer&, SourceLocation);

    // The world (pbrt_world.cpp)
    void shape(Tokenizer&, SourceLocation);
    void light_source(Tokenizer&, SourceLocation);
    void area_light_source(Tokenizer&, SourceLocation);
    void material(Tokenizer&, SourceLocation);
    void make_named_material(Tokenizer&, SourceLocation);
    void named_material(Tokenizer&, SourceLocation);
    void texture(Tokenizer&, SourceLocation);
    void make_named_medium(Tokenizer&, SourceLocation);
    void medium_interface(Tokenizer&, SourceLocation);
    void reverse_orientation(Tokenizer&, SourceLocation);
    bool read_alpha(Params& p, Object& object);
    void finish_objects();

    /// The directive's name in quotes, and its parameters, which stay valid as long as it runs.
    std::string type_of(Tokenizer& tokens, char const* directive) {
        return required_string(tokens, context_, directive);
    }
    Params params(Tokenizer& tokens, char const* directive, std::string const& type, SourceLocation where,
                  SharedParams inherited = {});
    SharedParams const& inherited(AttributeTarget t) const {
        return state_.attributes[static_cast<std::size_t>(t)];
    }

    Context context_;
    Textures textures_;
    Materials materials_;
    Media media_;

    GraphicsState state_;
    std::vector<Saved> saved_;
    std::size_t saved_floor_ = 0;  // an imported file may not close blocks that it did not open
    bool in_world_ = false;
    GroupId group_{0};
    std::map<std::string, std::pair<Mat4, Mat4>, std::less<>> coordinate_systems_;
    std::map<std::string, ObjectName, std::less<>> objects_;
    std::vector<PendingAlpha> alphas_;
    std::vector<std::filesystem::path> open_files_;
    std::size_t included_files_ = 0, included_bytes_ = 0;
    std::optional<int> sampler_seed_, integrator_seed_;  // pbrt-v4's sppm has one of its own
};

}  // namespace nephroid
