#include "ray_shapes.h"

#include <algorithm>

namespace nephroid {

namespace {
constexpr std::size_t kMaxCones = 20'000;  // a few bytes in a file are a thousand triangles each
}

std::vector<std::string> const& RayShapes::names() {
    static std::vector<std::string> const all{"sphere", "box",      "square", "cylinder",
                                              "cone",   "polymesh", "trimesh"};
    return all;
}

RayAttribute RayShapes::material(SharedPhong& phong) {
    return {
        "material", {}, [this, &phong, parent = phong] {  // given again, it does not begin as the one before
            in_.need('=');
            phong = materials_.read(in_, parent);
        }};
}

RayAttribute RayShapes::name_attribute() {
    return {"name", {}, [this] { in_.value([this] { return in_.text(); }); }};
}

std::vector<RayPiece> RayShapes::cylinder(SharedPhong phong) {
    bool capped = true;
    in_.block("cylinder", {material(phong),
                           name_attribute(),
                           {"capped", {}, [&] { capped = in_.value([&] { return in_.boolean(); }); }}});
    std::vector<RayPiece> pieces{{Cylinder{1, 0, 1}, phong, !capped}};
    if (capped) {
        pieces.push_back({Disk{1}, phong});
        pieces.push_back({Disk{0}, phong, false, true});
    }
    return pieces;
}

std::vector<RayPiece> RayShapes::cone(SharedPhong phong, SourceLocation where) {
    bool capped = true;
    float height = 1, bottom = 1, top = 0;
    auto const real = [&](float& x) { return [this, &x] { x = in_.value([this] { return in_.real(); }); }; };
    in_.block("cone", {material(phong),
                       name_attribute(),
                       {"capped", {}, [&] { capped = in_.value([&] { return in_.boolean(); }); }},
                       {"height", {}, real(height)},
                       {"bottom_radius", {}, real(bottom)},
                       {"top_radius", {}, real(top)}});
    if (bottom < 0 || top < 0) in_.context().fail(where, "the radii of a cone must not be negative");
    if (++cones_ > kMaxCones)
        throw Error(ErrorKind::Limit, in_.context().scene.locate(where) +
                                          ": more than 20000 cones; each is a mesh of a thousand triangles");
    in_.context().note(where,
                       "a cone is a mesh of 256 facets around, with the cone's normals: exact to 1/13000 of "
                       "its radius");
    return {{cone_mesh(height, bottom, top, capped), phong, !capped}};
}

std::vector<RayPiece> RayShapes::read(std::string_view name, SharedPhong const& parent) {
    auto const where = in_.here();
    if (name == "cylinder") return cylinder(parent);
    if (name == "cone") return cone(parent, where);
    if (name == "polymesh" || name == "trimesh") return mesh(name, parent, where);
    auto phong = parent;
    in_.block(name, {material(phong), name_attribute()});
    if (name == "sphere") return {{Sphere{}, phong}};
    constexpr float h = 0.5f;
    if (name == "box") return {{Box{{-h, -h, -h}, {h, h, h}}, phong}};
    return {{Quad{{-h, -h, 0}, {1, 0, 0}, {0, 1, 0}}, phong, true}};
}

}  // namespace nephroid
