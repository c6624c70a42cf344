// A small good scene with one of nearly everything, for tests to spoil.
#pragma once

#include "scene/scene.h"

namespace nephroid {

inline Scene sample_scene() {
    Scene s;
    s.files = {"scene.pbrt"};
    auto const at = [](std::uint32_t line) { return SourceLocation{0, line}; };
    s.camera.kind = PerspectiveCamera{.fov = 1, .lens_radius = 0.1f, .focal_distance = 3};
    s.camera.where = at(1);
    s.settings.film.resolution = {64, 48};
    s.settings.film.crop = std::array<int, 4>{0, 32, 0, 48};
    ImageId const image = s.add(ImageFile{"no-such-picture.png", "sRGB", at(2)});
    TextureId const grey = s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.5f}}, at(3)});
    TextureId const half = s.add(Texture{ConstantFloatTexture{0.5f}, at(4)});
    TextureId const picture = s.add(Texture{ImageTexture{.image = image, .mapping = PlanarMapping{}}, at(5)});
    TextureId const mix = s.add(Texture{MixTexture{grey, picture, half}, at(6)});
    MaterialId const diffuse = s.add(Material{DiffuseMaterial{mix}, "wall", at(7)});
    MaterialId const glass =
        s.add(Material{DielectricMaterial{TabulatedSpd{{400, 500, 600}, {1.6f, 1.5f, 1.4f}}}, "", at(8)});
    MaterialId const both = s.add(Material{MixMaterial{diffuse, glass, half}, "", at(9)});
    s.add(Light{SpotLight{}, Mat4{}, at(10)});
    s.add(Light{InfiniteLight{.image = image}, Mat4{}, at(11)});
    GroupId const part = s.add(Group{.name = "part", .where = at(12)});
    TriangleMesh const mesh{.p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}};
    s.groups[part.value].objects.push_back({.shape = mesh, .material = both, .where = at(13)});
    s.world().objects.push_back({.shape = Sphere{},
                                 .material = diffuse,
                                 .light = AreaLight{.where = at(15)},
                                 .alpha = half,
                                 .where = at(14)});
    s.world().instances.push_back({.group = part, .where = at(16)});
    return s;
}

}  // namespace nephroid
