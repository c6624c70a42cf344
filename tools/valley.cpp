// The valley of scenes/gallery/valley.pbrt. Its heights are sums of lattice noise (Perlin 2002, the quintic), which is arithmetic
// alone: the same on every machine.
#include "valley.h"

#include <algorithm>

namespace meshes {

namespace {

/// A number in [0, 1) of a lattice point: multiply and xor (the finalizer of MurmurHash3).
double chance(int x, int y, std::uint32_t what) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(y) * 0xd8163841u ^ what * 0xcb1ab31fu;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return static_cast<double>(h ^ h >> 16) * 0x1p-32;
}

double mix(double a, double b, double t) { return a + (b - a) * t; }
double smooth(double from, double to, double x) {
    double const t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// In [-1, 1], features of size 1.
double noise(double x, double y, std::uint32_t what) {
    double const fx = std::floor(x), fy = std::floor(y), a = x - fx, b = y - fy;
    int const i = static_cast<int>(fx), j = static_cast<int>(fy);
    auto const quintic = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
    double const u = quintic(a), v = quintic(b);
    return 2 * mix(mix(chance(i, j, what), chance(i + 1, j, what), u),
                   mix(chance(i, j + 1, what), chance(i + 1, j + 1, what), u), v) -
           1;
}

double hills(double x, double y, int octaves, std::uint32_t what) {
    double sum = 0, share = 1;
    for (int i = 0; i < octaves; ++i, x *= 2.03, y *= 2.03, share *= 0.48)
        sum += share * noise(x, y, what + static_cast<std::uint32_t>(i));
    return sum;
}
/// Sharp crests: noise folded at 0 (Musgrave's ridges), the more of it the higher the ground already is.
double ridges(double x, double y, int octaves, std::uint32_t what) {
    double sum = 0, share = 0.62, before = 1;
    for (int i = 0; i < octaves; ++i, x *= 2.03, y *= 2.03, share *= 0.5) {
        double const fold = 1 - std::abs(noise(x, y, what + static_cast<std::uint32_t>(i)));
        before = fold * fold * before;
        sum += share * before;
    }
    return sum;
}

// The ground's extent, and the lake's middle and half axes.
constexpr double kLeft = -100, kRight = 100, kNear = -46, kFar = 150;
constexpr Vec2 kLake{1, -5};
constexpr Vec2 kHut{9.5, 11.6};  // where the hut stands: a meadow, flat

double height(double x, double y) {
    double const bay = 0.16 * hills(x / 9, y / 9, 3, 11);
    double const d = std::sqrt((x - kLake.x) * (x - kLake.x) / (24.0 * 24.0) +
                               (y - kLake.y) * (y - kLake.y) / (15.5 * 15.5)) -
                     1 + bay;
    double const shore = d < 0 ? 2.4 * d : 0.9 * smooth(0, 0.12, d) * 0.5 + 0.8 * d;
    double const rise = smooth(0.1, 2.2, d);
    double const side = smooth(22, 90, std::abs(x));  // the valley's flanks
    double h = shore + rise * (3.2 + 2.6 * hills(x / 21, y / 21, 4, 31) + 11 * side) * 0.8;
    double const back = smooth(30, 110, y);
    h += back * (10 + 34 * ridges(x / 52 + 0.35, y / 52, 6, 57) * (0.55 + 0.45 * side));
    h += 0.35 * rise * hills(x / 4, y / 4, 3, 91);
    double const meadow = 1 - smooth(1.6, 4.5, std::hypot(x - kHut.x, y - kHut.y));
    return mix(h, 0.5, meadow * smooth(-0.02, 0.05, d));
}

Vec2 slope(double x, double y, double step) {
    return {(height(x + step, y) - height(x - step, y)) / (2 * step),
            (height(x, y + step) - height(x, y - step)) / (2 * step)};
}

}  // namespace

Mesh valley_ground() {
    Mesh mesh;
    add_grid(mesh, 150, 150, [&](double s, double t) {
        // Rows are closer together near the camera.
        double const x = mix(kLeft, kRight, s), y = mix(kNear, kFar, 0.45 * t + 0.55 * t * t),
                     z = height(x, y);
        mesh.p.emplace_back(x, y, z);
        double const above = (z + 3.5 * hills(x / 7, y / 7, 3, 71) - 17) / 16;
        mesh.uv.emplace_back(0.5, std::clamp(above, 0.0, 1.0));
    });
    average_normals(mesh);
    return mesh;
}

std::string snow_line() {
    constexpr int width = 4, rows = 64;
    std::string out(18, '\0');
    out[2] = 2;
    out[12] = width, out[14] = rows;
    out[16] = 24;
    for (int y = 0; y < rows; ++y)
        out.append(3 * width, static_cast<char>(std::lround(255 * smooth(0.1, 0.5, (y + 0.5) / rows))));
    return out;
}

Mesh spruce() {
    Mesh mesh;
    constexpr int whorls = 17, branches = 9;
    for (int i = 0; i < whorls; ++i)
        for (int j = 0; j < branches; ++j) {
            double const up = (i + 0.25 * chance(i, j, 1)) / whorls;
            double const root = 0.10 + 0.87 * up;
            double const reach = 0.19 * std::pow(1 - up, 0.85) * (0.8 + 0.4 * chance(i, j, 2)) + 0.012;
            double const droop = 0.35 + 0.35 * (1 - up), wide = 0.22 * reach + 0.012;
            double const turn = 2 * kPi * (j + 0.5 * (i % 2) + 0.5 * chance(i, j, 3)) / branches;
            Vec3 const along{std::cos(turn), std::sin(turn), 0}, across{-along.y, along.x, 0};
            add_grid(mesh, 2, 3, [&](double s, double t) {
                double const narrow = 1 - 0.9 * std::abs(t - 0.4) / 0.6;  // a leaf's outline
                double const side = 2 * s - 1;
                mesh.p.push_back(
                    along * (reach * t) + across * (side * wide * narrow) +
                    Vec3(0, 0, root - droop * reach * t * t - 0.5 * wide * side * side * narrow));
                mesh.n.push_back(
                    glm::normalize(along * (1.2 * droop * t) + across * (0.8 * side) + Vec3(0, 0, 1)));
            });
        }
    return mesh;
}

namespace {

/// One line: an instance of `what` at (x, y), `size` times as large, turned, and sheared so that it follows the ground.
std::string planted(char const* what, double x, double y, double size, double turn, bool sheared) {
    double const c = size * std::cos(turn), s = size * std::sin(turn);
    Vec2 const g = sheared ? slope(x, y, 0.8) : Vec2(0, 0);
    std::array<char, 240> text{};
    std::snprintf(
        text.data(), text.size(),
        "AttributeBegin ConcatTransform [ %.3g %.3g %.3g 0 %.3g %.3g %.3g 0 0 0 %.3g 0 %.2f %.2f %.2f 1 ] "
        "ObjectInstance \"%s\" AttributeEnd\n",
        c, s, g.x * c + g.y * s, -s, c, g.y * c - g.x * s, size, x, y, height(x, y) - 0.06, what);
    return text.data();
}

bool grows(double x, double y) {
    double const h = height(x, y);
    Vec2 const g = slope(x, y, 0.8);
    double const clearing = hills(x / 13, y / 13, 3, 201);
    bool const view = y < -16 && std::abs(x - 1) < 5 + 0.75 * (-16 - y);  // what the camera looks through
    return h > 0.45 && h < 15 + 3 * clearing && glm::length(g) < 1.1 && clearing > -0.28 && !view &&
           std::hypot(x - kHut.x, y - kHut.y) > 3.2;
}

}  // namespace

std::string valley_woods() {
    std::string out =
        "# Where the spruces of gallery/valley.pbrt stand: made by tools/valley.cpp. Wants the object "
        "\"spruce\", 1 high (10 m).\n"
        "ObjectBegin \"grove\" # 2.4 x 2.4\n";
    constexpr int side = 4;
    constexpr double cell = 2.4;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            double const x = ((i + 0.15 + 0.7 * chance(i, j, 301)) / side - 0.5) * cell;
            double const y = ((j + 0.15 + 0.7 * chance(i, j, 302)) / side - 0.5) * cell;
            double const size = 1.05 + 0.95 * chance(i, j, 303);
            std::array<char, 160> text{};
            std::snprintf(
                text.data(), text.size(),
                "AttributeBegin Translate %.2f %.2f 0 Rotate %.0f 0 0 1 Scale %.2f %.2f %.2f ObjectInstance "
                "\"spruce\" AttributeEnd\n",
                x, y, 360 * chance(i, j, 304), size, size, size * (0.9 + 0.35 * chance(i, j, 305)));
            out += text.data();
        }
    out += "ObjectEnd\n";
    for (int j = 0; kNear + j * cell < 105; ++j)
        for (int i = -38; i <= 38; ++i) {
            double const x = (i + 0.3 * chance(i, j, 311)) * cell,
                         y = kNear + (j + 0.3 * chance(i, j, 312)) * cell;
            if (std::abs(x) > 28 + 0.62 * (y + 34)) continue;  // outside of the picture
            if (grows(x, y)) {
                double const turn = kPi / 2 * std::floor(4 * chance(i, j, 313));
                out += planted("grove", x, y, 0.85 + 0.35 * chance(i, j, 314), turn, true);
            } else if (double const px = x + 0.8 * chance(i, j, 315), py = y + 0.8 * chance(i, j, 316);
                       grows(px, py + 1) ||
                       (height(px, py) > 0.35 && height(px, py) < 12 && chance(i, j, 317) < 0.12)) {
                // edges are loose: single trees where no grove is
                bool const view = py < -16 && std::abs(px - 1) < 4 + 0.7 * (-16 - py);
                if (!view && height(px, py) > 0.3 && std::hypot(px - kHut.x, py - kHut.y) > 2)
                    out += planted("spruce", px, py, 1 + 1.1 * chance(i, j, 318), 6.28 * chance(i, j, 319),
                                   false);
            }
        }
    return out;
}

}  // namespace meshes
