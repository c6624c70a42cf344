// The description of a scene, free of any file format: plain structs with ids, units and source locations.
// Readers fill it, compile() turns it into a World. Lengths are in the scene's unit.
#pragma once

#include "math/error.h"
#include "scene/camera.h"
#include "scene/id.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/settings.h"
#include "scene/shape.h"
#include "scene/texture.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nephroid {

/// A surface: a shape, where it is in its group's space, and what it is made of.
struct Object {
    Shape shape;
    Mat4 to_group;
    MaterialId material;
    std::optional<AreaLight> light;
    TextureId alpha;  // float; none = opaque
    bool reverse_orientation = false;
    SourceLocation where;
};

/// An affine 3x4 matrix, rows: all that an instance costs.
using AffineRows = std::array<std::array<float, 4>, 3>;

/// One more appearance of a group, in the space of the group that holds it.
struct Instance {
    GroupId group;
    AffineRows to_parent{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    SourceLocation where;
};

/// Objects and instances of other groups. Groups must not contain themselves.
struct Group {
    std::string name;
    std::vector<Object> objects;
    std::vector<Instance> instances;
    SourceLocation where;
};

/// Something that was read but is approximated or ignored; shown by `info`.
struct Note {
    SourceLocation where;
    std::string text;
};

struct Scene {
    std::vector<std::string> files;  // what SourceLocation::file indexes
    std::vector<Note> notes;

    Camera camera;
    Settings settings;

    std::vector<ImageFile> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Light> lights;
    std::vector<Group> groups{1};  // groups[0] is the world itself

    /// Where add() put each picture, by path and encoding. A hint, looked up again in `images`, which anybody may change.
    std::map<std::pair<std::string, std::string>, ImageId> image_ids;

    // Adding returns the id of what was added.
    TextureId add(Texture t) { return textures.push_back(std::move(t)), TextureId{last(textures)}; }
    MaterialId add(Material m) { return materials.push_back(std::move(m)), MaterialId{last(materials)}; }
    LightId add(Light l) { return lights.push_back(std::move(l)), LightId{last(lights)}; }
    GroupId add(Group g) { return groups.push_back(std::move(g)), GroupId{last(groups)}; }
    /// One entry per (path, encoding), however often it is named.
    ImageId add(ImageFile const& image);

    Texture const& operator[](TextureId id) const { return textures[id.value]; }
    Material const& operator[](MaterialId id) const { return materials[id.value]; }
    Light const& operator[](LightId id) const { return lights[id.value]; }
    Group const& operator[](GroupId id) const { return groups[id.value]; }
    ImageFile const& operator[](ImageId id) const { return images[id.value]; }
    Group& world() { return groups[0]; }
    [[nodiscard]] Group const& world() const { return groups[0]; }

    void note(SourceLocation where, std::string text) { notes.push_back({where, std::move(text)}); }
    /// "file:line", or "file" without a line, or "scene".
    [[nodiscard]] std::string locate(SourceLocation where) const;
    /// Error(Input) with "file:line: message".
    [[noreturn]] void fail(SourceLocation where, std::string const& message) const;

  private:
    template <class T>
    static std::uint32_t last(std::vector<T> const& v) {
        return static_cast<std::uint32_t>(v.size() - 1);
    }
};

/// Checks what the types cannot say: ids in range, no cycles among textures, materials and groups, finite numbers,
/// indices within their meshes, radii and angles in their ranges, flattened instance and triangle counts within 2^31.
/// Throws Error(Input), or Error(Limit) for the counts, with file:line.
void validate(Scene const& scene);

/// Removes objects and instances that validate() would refuse only because nothing of them can be seen (no area, or a
/// transform that flattens them), with a note for each. To be called before validate(); it needs nothing to be valid.
void drop_degenerate(Scene& scene);

/// 128 bits over everything that shapes a picture, except `settings`: locations, notes and names of files do not enter
/// (the bytes of the image files do). Two scenes with the same hash compile to the same World.
std::string hash(Scene const& scene);
/// The same over what shapes a pass in Settings (not spp and file names).
std::string hash(Settings const& settings);

}  // namespace nephroid
