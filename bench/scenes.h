// Scenes that the benchmarks share.
#pragma once

#include "image/write.h"
#include "read/read.h"
#include "sampling/hash.h"

#include <cmath>
#include <filesystem>

namespace nephroid::bench {

inline std::filesystem::path scene_file(char const* name) {
    return std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes" / name;
}

/// Smooth value noise in [-1, 1] on an integer lattice.
inline float noise(Vec3 p) {
    Vec3 const cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    Vec3 const f = p - cell;
    Vec3 const s = f * f * (Vec3{3.0f} - 2.0f * f);
    auto const corner = [&](int i) {
        auto const key = [](float x) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(x)); };
        std::uint64_t const h =
            hash_keys(key(cell.x) + (i & 1), key(cell.y) + (i >> 1 & 1), key(cell.z) + (i >> 2));
        return 2.0f * to_unit_float(static_cast<std::uint32_t>(h)) - 1.0f;
    };
    auto const row = [&](int i) { return lerp(s.x, corner(i), corner(i + 1)); };
    return lerp(s.z, lerp(s.y, row(0), row(2)), lerp(s.y, row(4), row(6)));
}

/// A ball with bumps of six octaves, `n` by 2n cells: 4 n^2 triangles.
inline TriangleMesh bumpy_ball(int n) {
    TriangleMesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= 2 * n; ++j) {
            float const theta = kPi * static_cast<float>(i) / static_cast<float>(n);
            float const phi = kPi * static_cast<float>(j % (2 * n)) / static_cast<float>(n);
            Vec3 const w{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
            float r = 1;
            for (int octave = 0; octave < 6; ++octave) {
                float const scale = static_cast<float>(2 << octave);
                r += 0.35f / scale * noise(w * scale + Vec3{17.0f * static_cast<float>(octave)});
            }
            mesh.p.push_back(r * w);
        }
    auto const at = [n](int i, int j) { return i * (2 * n + 1) + j; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) {
            if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            if (i < n - 1) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        }
    return mesh;
}

/// Blue above, brown below, and a sun.
inline void write_sky(std::filesystem::path const& path) {
    int const h = 128;
    Image sky(PixelFormat::Float, 2 * h, h, {"R", "G", "B"});
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < 2 * h; ++x) {
            float const up = 1.0f - 2.0f * static_cast<float>(y) / static_cast<float>(h);
            bool const sun = std::abs(x - 60) < 4 && std::abs(y - 30) < 3;
            Vec3 const c = sun ? Vec3{300, 270, 200}
                               : (up > 0 ? Vec3{0.5f, 0.7f, 1.0f} * (0.4f + up) : Vec3{0.2f, 0.15f, 0.1f});
            for (int k = 0; k < 3; ++k) sky.set(x, y, k, c[k]);
        }
    write_image(path, sky);
}

/// 4 n^2 triangles on a floor, under a picture of a sky.
inline Scene bumpy_ball_under_sky(int n) {
    auto const sky = std::filesystem::temp_directory_path() / "nephroid-bench-sky.exr";
    write_sky(sky);
    Scene scene = read_pbrt_string(
        "Film \"rgb\" \"integer xresolution\" 512 \"integer yresolution\" 512\n"
        "Integrator \"path\" \"integer maxdepth\" 12\n"
        "LookAt 0 -3.6 1.6  0 0 -0.1  0 0 1 Camera \"perspective\" \"float fov\" 40\n"
        "WorldBegin\n"
        "Rotate 90 1 0 0 LightSource \"infinite\" \"string mapping\" \"latlong\" \"string filename\" \"" +
            sky.string() +
            "\"\nIdentity Material \"diffuse\" \"rgb reflectance\" [ 0.6 0.5 0.4 ]\n"
            "Shape \"quad\" \"point3 origin\" [ -9 -9 -1.1 ] \"vector3 u\" [ 18 0 0 ] \"vector3 v\" [ 0 18 0 "
            "]\n",
        "bumpy ball", ".");
    Object ball;
    ball.shape = bumpy_ball(n);
    ball.material = scene.world().objects.front().material;
    scene.world().objects.push_back(std::move(ball));
    return scene;
}

}  // namespace nephroid::bench
