// What the programs that make scenes/ share: meshes over grids, and their PLY files. So that the last bit of somebody else's
// sin() does not matter, every number is rounded to a multiple of 2^-16, which a float holds exactly below 256.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace meshes {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
inline constexpr double kPi = std::numbers::pi;

struct Mesh {
    std::vector<Vec3> p, n;
    std::vector<Vec2> uv;  // empty, or one per point
    std::vector<std::array<std::int32_t, 3>> triangles;
};

// A surface over a grid of (columns + 1) * (rows + 1) points. `at(s, t)` adds the point of s, t in [0, 1].
// Triangles run counter-clockwise as seen from the side where dp/ds x dp/dt points.
inline void add_grid(Mesh& mesh, int columns, int rows, std::function<void(double, double)> const& at) {
    auto const first = static_cast<std::int32_t>(mesh.p.size());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) at(double(i) / columns, double(j) / rows);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            std::int32_t const a = first + j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
}

// Normals of points by their triangles, weighed by area. Where a mesh is coarser than what it shows, they fit the triangles better
// than the surface's own: a normal that faces away from who looks at its triangle is rendered black.
inline void average_normals(Mesh& mesh) {
    mesh.n.assign(mesh.p.size(), Vec3(0));
    for (auto const& t : mesh.triangles) {
        auto const at = [&](int k) { return static_cast<std::size_t>(t[static_cast<std::size_t>(k)]); };
        Vec3 const face = glm::cross(mesh.p[at(1)] - mesh.p[at(0)], mesh.p[at(2)] - mesh.p[at(0)]);
        for (int k = 0; k < 3; ++k) mesh.n[at(k)] += face;
    }
    for (Vec3& n : mesh.n) n = glm::normalize(n);
}

inline float rounded(double x) { return static_cast<float>(std::round(x * 65536) / 65536) + 0.0f; }

inline void little_endian(std::string& out, std::uint32_t bits) {
    for (int i = 0; i < 4; ++i) out += static_cast<char>(bits >> (8 * i) & 0xFF);
}

enum class Format { Ascii, Binary };

inline std::string ply(Mesh const& mesh, Format format) {
    bool const binary = format == Format::Binary, uv = !mesh.uv.empty();
    std::string out = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") + " 1.0\n";
    out += "comment made by tools/make_meshes.cpp\nelement vertex " + std::to_string(mesh.p.size()) + "\n";
    for (char const* name : {"x", "y", "z", "nx", "ny", "nz"})
        out += std::string("property float ") + name + "\n";
    if (uv) out += "property float u\nproperty float v\n";
    out += "element face " + std::to_string(mesh.triangles.size()) + "\n";
    out += "property list uchar int vertex_indices\nend_header\n";

    auto number = [&](double x) {
        if (binary) {
            little_endian(out, std::bit_cast<std::uint32_t>(rounded(x)));
        } else {
            std::array<char, 40> text{};
            std::snprintf(text.data(), text.size(), "%.9g ", static_cast<double>(rounded(x)));
            out += text.data();
        }
    };
    for (std::size_t i = 0; i < mesh.p.size(); ++i) {
        for (int k = 0; k < 3; ++k) number(mesh.p[i][k]);
        for (int k = 0; k < 3; ++k) number(mesh.n[i][k]);
        if (uv) number(mesh.uv[i].x), number(mesh.uv[i].y);
        if (!binary) out.back() = '\n';
    }
    for (auto const& [a, b, c] : mesh.triangles) {
        if (binary) {
            out += '\3';
            for (std::int32_t index : {a, b, c}) little_endian(out, static_cast<std::uint32_t>(index));
        } else {
            out += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
        }
    }
    return out;
}

}  // namespace meshes
