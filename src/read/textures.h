// Named textures, and parameters that are either a value or a texture's name.
#pragma once

#include "params.h"
#include "scene/texture.h"

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <utility>

namespace nephroid {

/// Textures are made when something asks for them, once for each role that a spectrum texture is used in: as in pbrt, the
/// same rgb means something else as a reflectance and as an index of refraction.
class Textures {
  public:
    explicit Textures(Context& context) : context_(context) {}

    /// Where a texture is; its inverse is computed where it is not given.
    struct Place {
        Mat4 to_world;
        std::optional<Mat4> from_world;
    };
    void define(std::string name, std::string const& type, std::string kind, ParamList params,
                SharedParams inherited, Place place, SourceLocation where);

    /// The texture or constant in parameter `name`; `otherwise` where it is not there (none: no texture).
    TextureId float_param(Params& params, std::string_view name, std::optional<float> otherwise);
    TextureId spectrum_param(Params& params, std::string_view name, std::optional<Spd> otherwise,
                             SpectrumRole role);
    /// The float texture that a "texture" parameter names.
    TextureId named_float(Param const& param);
    TextureId constant(float value, SourceLocation where);
    TextureId constant(Spd value, SpectrumRole role, SourceLocation where);

    /// Makes, for their errors and notes alone, the textures that nothing asked for.
    void check_unused();

  private:
    /// pbrt's order of making: pictures, then float textures, then spectra, each as they stand in the file.
    using Rank = std::pair<int, std::size_t>;
    struct Definition {
        std::string name, kind;
        bool spectrum = false;
        ParamList params;
        SharedParams inherited;
        Place place;
        SourceLocation where;
        Rank rank;
        std::array<TextureId, 3> made;  // by role; a float texture uses the first
    };
    using Names = std::map<std::string, Definition*, std::less<>>;

    Definition& look_up(Param const& param, bool spectrum);
    TextureId make(Definition& d, SpectrumRole role);
    TextureKind kind_of(Definition const& d, Params& p, SpectrumRole role);
    TextureKind image(Definition const& d, Params& p, SpectrumRole role);
    TextureKind of_others(Definition const& d, Params& p, SpectrumRole role);
    TextureKind of_noise(Definition const& d, Params& p);
    /// A parameter of a texture: of the same type as the texture itself.
    TextureId input(Definition const& d, Params& p, std::string_view name, float otherwise,
                    SpectrumRole role);
    TextureId add(TextureKind kind, SourceLocation where);

    Context& context_;
    std::deque<Definition> definitions_;  // in file order, addresses stay
    Names float_names_, spectrum_names_;
    int depth_ = 0;  // of textures being made
    // Textures may name only what is made before them: while one is made, later ones do not exist.
    static constexpr Rank kAll{3, 0};
    Rank visible_ = kAll;
};

}  // namespace nephroid
