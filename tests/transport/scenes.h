// Scenes with known answers, built from the structs themselves.
#pragma once

#include "math/frame.h"
#include "scene/affine_rows.h"
#include "scene/scene.h"

#include <cmath>
#include <utility>

namespace nephroid::test {

inline TextureId spectrum(Scene& s, Spd value, SpectrumRole role = SpectrumRole::Albedo) {
    return s.add(Texture{ConstantSpectrumTexture{std::move(value), role}, {}});
}
inline MaterialId material(Scene& s, MaterialKind kind) { return s.add(Material{std::move(kind), "", {}}); }
inline MaterialId diffuse(Scene& s, float reflectance) {
    return material(s, DiffuseMaterial{spectrum(s, ConstantSpd{reflectance})});
}
inline MaterialId diffuse(Scene& s, Vec3 rgb) {
    return material(s, DiffuseMaterial{spectrum(s, RgbAlbedoSpd{rgb})});
}
inline MaterialId mirror(Scene& s, float reflectance) {
    ConductorMaterial m;
    m.reflectance = spectrum(s, ConstantSpd{reflectance});
    return material(s, m);
}
inline MaterialId metal(Scene& s, Spd eta, Spd k) {
    ConductorMaterial m;
    m.eta = spectrum(s, std::move(eta), SpectrumRole::Unbounded);
    m.k = spectrum(s, std::move(k), SpectrumRole::Unbounded);
    return material(s, m);
}
inline MaterialId glass(Scene& s, Spd eta = ConstantSpd{1.5f}) {
    return material(s, DielectricMaterial{std::move(eta)});
}

/// White of this luminance.
inline AreaLight white(float radiance, bool two_sided = false) {
    AreaLight l;
    l.scale = radiance;
    l.two_sided = two_sided;
    return l;
}
inline Light sky(float radiance = 1) {
    InfiniteLight l;
    l.scale = radiance;
    return Light{l, {}, {}};
}
inline Light point_light(Vec3 from, float intensity) {
    PointLight l;
    l.from = from;
    l.scale = intensity;
    return Light{l, {}, {}};
}

inline Object& add(Group& g, Shape shape, MaterialId m = {}) {
    Object o;
    o.shape = std::move(shape);
    o.material = m;
    g.objects.push_back(std::move(o));
    return g.objects.back();
}
inline Object& add(Scene& s, Shape shape, MaterialId m = {}) { return add(s.world(), std::move(shape), m); }

inline Mat4 rotation(double degrees, double x, double y, double z) { return *rotate(degrees, x, y, z); }
/// x grows by `k` times y.
inline Mat4 shear(double k) {
    Mat4 m;
    m.m[0][1] = k;
    return m;
}

/// Two triangles, p0 p1 p2 p3 in order around; the normal is (p1 - p0) x (p2 - p0).
inline TriangleMesh rectangle(Vec3 p0, Vec3 p1, Vec3 p2, Vec3 p3) {
    TriangleMesh m;
    m.p = {p0, p1, p2, p3};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    return m;
}
/// A closed box of twelve triangles, normals inwards or outwards.
inline TriangleMesh box_mesh(Vec3 lo, Vec3 hi, bool inwards) {
    TriangleMesh m;
    for (int i = 0; i < 8; ++i)
        m.p.emplace_back((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
    int const face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (auto const& f : face) {
        m.triangles.push_back(inwards ? Vec3i{f[0], f[2], f[1]} : Vec3i{f[0], f[1], f[2]});
        m.triangles.push_back(inwards ? Vec3i{f[0], f[3], f[2]} : Vec3i{f[0], f[2], f[3]});
    }
    return m;
}
/// A horizontal square of this half side, seen from above.
inline Quad floor_quad(float half, float z = 0) {
    return Quad{{-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}};
}

inline std::array<double, 3> doubles(Vec3 v) { return {v.x, v.y, v.z}; }
inline void look(Scene& s, Vec3 eye, Vec3 target) {
    Vec3 const d = normalize(target - eye);
    Vec3 const up = std::abs(d.z) > 0.9f ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    s.camera.to_world = *inverse(*look_at(doubles(eye), doubles(target), doubles(up)));
}
/// Sees every direction.
inline void look_around(Scene& s, Vec3 eye) {
    s.camera.kind = SphericalCamera{};
    s.camera.to_world = translate(eye.x, eye.y, eye.z);
}
/// Sees one point along one direction (nearly: half an arc second).
inline void look_at_point(Scene& s, Vec3 eye, Vec3 target) {
    PerspectiveCamera c;
    c.fov = 2e-6f;
    s.camera.kind = c;
    look(s, eye, target);
}
/// Parallel rays against `direction`, from a square of this half side around `eye`.
inline void look_parallel(Scene& s, Vec3 eye, Vec3 direction, float half) {
    s.camera.kind = OrthographicCamera{};
    s.camera.screen_window = std::array<float, 4>{-half, half, -half, half};
    look(s, eye, eye + direction);
}

}  // namespace nephroid::test
