#include "scenes.h"

#include "sampling/hash.h"

#include <fmt/format.h>

#include <algorithm>

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace nephroid::experiment::scenes {

namespace {

std::string head(int width, int height, Pixels pixels) {
    // 0.001 is the smallest radius that there is.
    float const radius = pixels == Pixels::Whole ? 0.5f : 0.001f;
    return fmt::format(
        "Option \"string color\" \"rgb\"\n"
        "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
        "PixelFilter \"box\" \"float xradius\" {} \"float yradius\" {}\n"
        "Scale -1 1 1\n",
        width, height, radius, radius);
}

std::string point(Vec3 p) { return fmt::format("{} {} {}", p.x, p.y, p.z); }

std::string mesh(std::vector<Vec3> const& points, std::vector<std::array<int, 3>> const& triangles) {
    std::string s = "Shape \"trianglemesh\" \"point3 P\" [";
    for (Vec3 const p : points) s += " " + point(p);
    s += " ] \"integer indices\" [";
    for (auto const& t : triangles) s += fmt::format(" {} {} {}", t[0], t[1], t[2]);
    return s + " ]\n";
}

}  // namespace

std::string view(int width, int height, Pixels pixels, Vec3 eye, Vec3 target, float fov) {
    return head(width, height, pixels) +
           fmt::format("LookAt {}  {}  0 0 1\nCamera \"perspective\" \"float fov\" {}\nWorldBegin\n",
                       point(eye), point(target), fov);
}

std::string floor_view(int width, int height, Pixels pixels, float x0, float x1, float y0, float y1) {
    return head(width, height, pixels) +
           fmt::format(
               "LookAt 0 0 0.4  0 0 0  0 1 0\n"
               "Camera \"orthographic\" \"float screenwindow\" [ {} {} {} {} ]\nWorldBegin\n",
               x0, x1, y0, y1);
}

std::string matte(float reflectance) {
    return fmt::format("Material \"diffuse\" \"rgb reflectance\" [ {0} {0} {0} ]\n", reflectance);
}

std::string floor() {
    return "Shape \"quad\" \"point3 origin\" [ -40 -40 0 ] \"vector3 u\" [ 80 0 0 ] \"vector3 v\" [ 0 80 0 "
           "]\n";
}

std::string light(float radiance, std::string const& shape) {
    return fmt::format(
        "AttributeBegin\n{}AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ] \"float scale\" "
        "{}\n{}AttributeEnd\n",
        matte(0), radiance, shape);
}

std::string square_light(float radiance, float side, float height) {
    return light(radiance,
                 fmt::format("Shape \"quad\" \"point3 origin\" [ {0} {0} {1} ] \"vector3 u\" [ 0 {2} 0 ] "
                             "\"vector3 v\" [ {2} 0 0 ]\n",
                             -side / 2, height, side));
}

std::string icosphere() {
    // An icosahedron, each triangle cut in four, twice.
    float const g = (1 + std::sqrt(5.0f)) / 2;
    std::vector<Vec3> p{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                        {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    std::vector<std::array<int, 3>> t{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < 2; ++level) {
        std::map<std::pair<int, int>, int> halves;
        auto const half = [&](int a, int b) {
            auto const [at, is_new] = halves.try_emplace(std::minmax(a, b), static_cast<int>(p.size()));
            if (is_new) p.push_back((p[static_cast<std::size_t>(a)] + p[static_cast<std::size_t>(b)]) * 0.5f);
            return at->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (auto const& [a, b, c] : t) {
            int const ab = half(a, b);
            int const bc = half(b, c);
            int const ca = half(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        t = std::move(finer);
        for (Vec3& q : p) q = normalize(q);
    }
    for (Vec3& q : p) q *= 0.5f;
    return mesh(p, t);
}

std::string scattered_lights(int count) {
    std::string s = "AttributeBegin\n" + matte(0);
    for (int i = 0; i < count; ++i) {
        std::uint64_t key = mix64(0x11947 + static_cast<std::uint64_t>(i));
        auto const next = [&] { return to_unit_float(static_cast<std::uint32_t>(key = mix64(key + 1))); };
        Vec3 const centre{-4.9f + 9.8f * next(), -3.9f + 7.8f * next(), 0.1f + 3.8f * next()};
        float const size = 0.01f * std::pow(10.0f, next());
        // Two orders of magnitude between the strongest and the weakest.
        float const radiance = 10 * std::pow(100.0f, next());
        std::vector<Vec3> corners;
        for (int k = 0; k < 3; ++k) {
            Vec3 const q{next() - 0.5f, next() - 0.5f, next() - 0.5f};
            corners.push_back(centre + size * normalize(q));
        }
        s += fmt::format("AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ] \"float scale\" {}\n", radiance) +
             mesh(corners, {{0, 1, 2}});
    }
    return s + "AttributeEnd\n";
}

std::string room(Vec3 lo, Vec3 hi) {
    // Only the inside is seen; a diffuse surface scatters on both sides.
    return fmt::format("Shape \"box\" \"point3 lo\" [ {} ] \"point3 hi\" [ {} ]\n", point(lo), point(hi));
}

}  // namespace nephroid::experiment::scenes
