// What the checks of validate() share: where we are, and how to say what is wrong there.
#pragma once

#include "scene/fields.h"
#include "scene/scene.h"

#include <cmath>
#include <string>

namespace nephroid {

/// A scene and the place being checked.
struct Check {
    Scene const& scene;
    SourceLocation where;

    [[nodiscard]] Check at(SourceLocation place) const { return {scene, place}; }
    void require(bool good, char const* message) const {
        if (!good) scene.fail(where, message);
    }
    [[noreturn]] void limit(std::string const& message) const {
        throw Error(ErrorKind::Limit, scene.locate(where) + ": " + message);
    }
};

/// No NaN and no infinity in any float anywhere in x.
template <class T>
void check_finite(Check const& c, T const& x, char const* what) {
    for_each_leaf(x, [&](auto const& leaf) {
        if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(leaf)>>)
            if (!std::isfinite(leaf))
                c.scene.fail(c.where, std::string(what) +
                                          " holds a number that is not finite: replace the NaN or infinity");
    });
}

/// Every id anywhere in x is none or names something.
template <class T>
void check_ids(Check const& c, T const& x, char const* what) {
    auto const check = [&](auto id, std::size_t count, char const* kind) {
        if (id.valid() && id.value >= count)
            c.scene.fail(c.where, std::string(what) + " names " + kind + " " + std::to_string(id.value) +
                                      ", but there are only " + std::to_string(count) + ": add it first");
    };
    for_each_leaf(x, [&](auto const& leaf) {
        using Leaf = std::remove_cvref_t<decltype(leaf)>;
        if constexpr (std::same_as<Leaf, TextureId>)
            check(leaf, c.scene.textures.size(), "texture");
        else if constexpr (std::same_as<Leaf, MaterialId>)
            check(leaf, c.scene.materials.size(), "material");
        else if constexpr (std::same_as<Leaf, ImageId>)
            check(leaf, c.scene.images.size(), "image");
        else if constexpr (std::same_as<Leaf, GroupId>)
            check(leaf, c.scene.groups.size(), "group");
        else if constexpr (std::same_as<Leaf, LightId>)
            check(leaf, c.scene.lights.size(), "light");
    });
}

/// Numbers beyond single precision, in the matrix or in its inverse.
bool overflows(Mat4 const& m);
/// Finite, affine and invertible, in double and in float.
void check_matrix(Check const& c, Mat4 const& m, char const* what);
void check_spd(Check const& c, Spd const& spd, char const* what);
void check_shape(Check const& c, Shape const& shape);
void check_texture(Check const& c, Texture const& texture);
void check_material(Check const& c, Material const& material);
void check_light(Check const& c, Light const& light);
void check_area_light(Check const& c, AreaLight const& light);
void check_camera(Check const& c, Camera const& camera);
void check_settings(Check const& c, Settings const& settings);
/// Textures of numbers where numbers are needed, of spectra where spectra are: the other kind would read as black.
/// `children_first` lists all textures, each after those that it is made of.
void check_texture_types(Scene const& scene, std::vector<std::uint32_t> const& children_first);
/// No cycles and no endless chains among textures, materials and groups; counts within their limits. After the ids.
void check_graphs(Scene const& scene);

}  // namespace nephroid
