// Meshes, scenes and rays for the tests of the world.
#pragma once

#include "model/shape.h"
#include "scene/affine_rows.h"
#include "scene/scene.h"
#include "statistics.h"
#include "world/world.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace nephroid::test {

/// How often something is tried: ten times as often where NEPHROID_FULL is set.
/// `n` by default, `longer` times as many in a full run, a tenth under the address sanitizer.
inline std::uint64_t tries(std::uint64_t n, std::uint64_t longer = 10) {
#ifdef __SANITIZE_ADDRESS__
    n = n / 10 + 1;
#endif
    return full() ? longer * n : n;
}

/// Random rays.
class Rays : public Random {
  public:
    using Random::Random;
    float in(float lo, float hi) { return lo + (hi - lo) * unit(); }
    Vec3 direction() {
        float const z = in(-1, 1);
        float const phi = in(0, kTwoPi);
        float const r = safe_sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    /// Outwards of n; every other one grazes, down to an angle of about 1e-4.
    Vec3 outward(Vec3 n) {
        Vec3 const d = direction();
        Vec3 const tangent = d - dot(d, n) * n;
        float const cosine = bits() % 2 ? in(1e-4f, 1.0f) : std::exp(in(std::log(1e-4f), 0));
        return normalize(normalize(tangent) * safe_sqrt(1 - cosine * cosine) + n * cosine);
    }
};

/// An icosahedron, each face divided in four `levels` times, vertices shared and on the sphere.
inline TriangleMesh icosphere(int levels, float radius) {
    float const g = (1 + std::sqrt(5.0f)) / 2;
    TriangleMesh m;
    m.p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    m.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<int, int>, int> middle;
        auto const between = [&](int a, int b) {
            auto const [at, fresh] =
                middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(m.p.size()));
            if (fresh)
                m.p.push_back(normalize(m.p[static_cast<std::size_t>(a)] + m.p[static_cast<std::size_t>(b)]));
            return at->second;
        };
        std::vector<Vec3i> finer;
        for (Vec3i const t : m.triangles) {
            int const a = between(t.x, t.y);
            int const b = between(t.y, t.z);
            int const c = between(t.z, t.x);
            finer.insert(finer.end(), {{t.x, a, c}, {t.y, b, a}, {t.z, c, b}, {a, b, c}});
        }
        m.triangles = finer;
    }
    for (Vec3& p : m.p) p = normalize(p) * radius;
    return m;
}

inline TriangleMesh torus(int around, int across, float major, float minor) {
    TriangleMesh m;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            float const u = kTwoPi * static_cast<float>(i) / static_cast<float>(around);
            float const v = kTwoPi * static_cast<float>(j) / static_cast<float>(across);
            float const r = major + minor * std::cos(v);
            m.p.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
            int const i1 = (i + 1) % around;
            int const j1 = (j + 1) % across;
            int const a = i * across + j;
            int const b = i1 * across + j;
            int const c = i1 * across + j1;
            int const d = i * across + j1;
            m.triangles.push_back({a, b, c});
            m.triangles.push_back({a, c, d});
        }
    return m;
}

/// Eight vertices, twelve triangles, normals outwards.
inline TriangleMesh cube(float half) {
    TriangleMesh m;
    for (int i = 0; i < 8; ++i)
        m.p.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
    m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return m;
}

inline TriangleMesh moved(TriangleMesh m, Vec3 by) {
    for (Vec3& p : m.p) p += by;
    return m;
}

/// A square in the plane z = height, normal +z.
inline TriangleMesh square(float half, float height) {
    return {.p = {{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}},
            .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

inline MaterialId diffuse(Scene& s, Spd const& reflectance = ConstantSpd{0.5f}) {
    return s.add(Material{DiffuseMaterial{s.add(Texture{ConstantSpectrumTexture{reflectance}, {}})}, "", {}});
}

inline Object object(Shape shape, MaterialId material, Mat4 const& to_group = {}) {
    return {.shape = std::move(shape), .to_group = to_group, .material = material};
}

/// All of a hit that a picture is made of, as bits.
inline std::array<std::uint32_t, 10> bits(RawHit const& h) {
    if (!h.found) return {};
    auto const b = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    return {1,          b(h.t),      b(h.u),    b(h.v), b(h.local.x), b(h.local.y), b(h.local.z),
            h.geometry, h.primitive, h.instance};
}

inline AreaLight emission(float radiance) {
    return {.radiance = RgbIlluminantSpd{{1, 1, 1}}, .scale = radiance};
}

/// One object, alone in the world.
inline Scene alone(Shape shape, Mat4 const& to_group = {}) {
    Scene s;
    s.files = {"alone.pbrt"};
    s.world().objects.push_back(object(std::move(shape), diffuse(s), to_group));
    return s;
}
/// … as an instance of a group.
inline Scene alone_instanced(Shape shape, Mat4 const& to_group, Mat4 const& to_world) {
    Scene s;
    s.files = {"alone.pbrt"};
    GroupId const g = s.add(Group{.name = "g"});
    s.groups[g.value].objects.push_back(object(std::move(shape), diffuse(s), to_group));
    s.world().instances.push_back({.group = g, .to_parent = rows_of(to_world)});
    return s;
}

}  // namespace nephroid::test
