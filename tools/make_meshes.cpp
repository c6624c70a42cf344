// Makes the meshes and textures of our scenes: make_meshes DIR writes DIR/meshes/*.ply, DIR/textures/* and DIR/include/valley/*.
// What it writes is checked in; a test makes it again and compares byte by byte. So that the last bit of somebody else's
// sin() does not matter, every number is rounded to a multiple of 2^-16, which a float holds exactly below 256 (and to the nearest float above).
// Lengths: centimetres for the cup, metres for the water, millimetres for that in the Cornell box, free for the rest. z is up but there.

#include "creature.h"
#include "mesh.h"
#include "valley.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace meshes;

namespace {

/// A point (r, z) of a profile, and the outward normal there in the same plane.
struct ProfilePoint {
    Vec2 p, n;
};

// The profile, turned around the z axis. It runs so that outside lies to its right: upwards for an outer wall.
void add_lathe(Mesh& mesh, int columns, int rows, std::function<ProfilePoint(double)> const& profile) {
    add_grid(mesh, columns, rows, [&](double s, double t) {
        ProfilePoint const q = profile(t);
        // The last column lies on the first one, exactly.
        double const phi = s == 1 ? 0 : 2 * kPi * s, c = std::cos(phi), d = std::sin(phi);
        mesh.p.emplace_back(q.p.x * c, q.p.x * d, q.p.y);
        mesh.n.push_back(glm::normalize(Vec3(q.n.x * c, q.n.x * d, q.n.y)));
    });
}

// Water: a tile of 2.5 m x 2.5 m around the origin that continues itself on all four sides. Sines with whole numbers of
// periods on the tile, most of them running towards +x. Each bends the surface about as much (amplitude ~ 1 / k^2): long
// waves are high, short ones sharpen the light. With a curvature of about 3/m in all, crests focus between 1 and 2 m below.
Mesh waves() {
    constexpr double size = 2.5, bend = 1.0;
    constexpr std::array<std::array<int, 2>, 12> periods{{{2, 1},
                                                          {1, -2},
                                                          {3, 1},
                                                          {2, -3},
                                                          {3, 2},
                                                          {1, 4},
                                                          {4, -2},
                                                          {5, 1},
                                                          {3, 5},
                                                          {-2, 5},
                                                          {6, -3},
                                                          {5, 5}}};
    Mesh mesh;
    add_grid(mesh, 72, 72, [&](double s, double t) {
        double h = 0, dx = 0, dy = 0;
        for (std::size_t i = 0; i < periods.size(); ++i) {
            double const kx = 2 * kPi / size * periods[i][0], ky = 2 * kPi / size * periods[i][1];
            double const amplitude = bend / (kx * kx + ky * ky);
            // s, t = 1 has to give the very numbers of 0; phases by the golden ratio, which lines nothing up
            double const phase = 2 * kPi * std::fmod(0.6180339887 * double(i + 1) * double(i + 2), 1.0);
            double const angle =
                2 * kPi * (periods[i][0] * std::fmod(s, 1.0) + periods[i][1] * std::fmod(t, 1.0)) + phase;
            h += amplitude * std::sin(angle);
            dx += amplitude * kx * std::cos(angle);
            dy += amplitude * ky * std::cos(angle);
        }
        mesh.p.emplace_back((s - 0.5) * size, (t - 0.5) * size, h);
        mesh.n.push_back(glm::normalize(Vec3(-dx, -dy, 1)));
    });
    return mesh;
}

// Water in the Cornell box, up to about 180 mm deep (y is up): waves that lie flat where they meet a pane at z = 1, and grow over
// 120 mm from there on. It reaches a little into the walls, so that there is no film of air between.
Mesh box_water() {
    constexpr double x0 = -6, x1 = 562, z0 = 1, z1 = 564, level = 170;
    struct Wave {
        double x, z, phase, height;  // radians per mm, radians, mm
    };
    constexpr std::array<Wave, 3> all{
        {{0.037, 0.011, 0.3, 7}, {-0.014, 0.041, 1.9, 6}, {0.027, -0.045, 4.1, 3}}};
    Mesh mesh;
    add_grid(mesh, 72, 72, [&](double s, double t) {  // rows along x: triangles look up
        double const x = x0 + (x1 - x0) * t, z = z0 + (z1 - z0) * s;
        double const u = std::clamp((z - z0) / 120, 0.0, 1.0);
        double const grown = u * u * (3 - 2 * u), growing = 6 * u * (1 - u) / 120;
        double y = level, dx = 0, dz = 0;
        for (Wave const& w : all) {
            double const angle = w.x * x + w.z * z + w.phase;
            y += grown * w.height * std::sin(angle);
            dx += grown * w.height * w.x * std::cos(angle);
            dz += w.height * (grown * w.z * std::cos(angle) + growing * std::sin(angle));
        }
        mesh.p.emplace_back(x, y, z);
        mesh.n.push_back(glm::normalize(Vec3(-dx, 1, -dz)));
    });
    return mesh;
}

// The cup's outer wall: a rounded foot of radius 3 that swells to the wall of radius 4.3, up to the lip at z = 9.
Mesh cup_body() {
    Mesh mesh;
    add_lathe(mesh, 144, 12, [](double t) {
        double const a = kPi / 2 * t;
        return ProfilePoint{{3 + 1.3 * std::sin(a), 1.8 * (1 - std::cos(a))},
                            glm::normalize(Vec2(std::sin(a) * 1.8, -std::cos(a) * 1.3))};
    });
    add_lathe(mesh, 144, 1, [](double t) { return ProfilePoint{{4.3, 1.8 + t * (9 - 1.8)}, {1, 0}}; });
    return mesh;
}

// The lip: half a torus between the outer wall (radius 4.3) and the inner one (radius 4).
Mesh cup_lip() {
    Mesh mesh;
    add_lathe(mesh, 144, 12, [](double t) {
        double const a = kPi * t;
        Vec2 const n{std::cos(a), std::sin(a)};
        return ProfilePoint{Vec2(4.15, 9) + 0.15 * n, n};
    });
    return mesh;
}

// The handle: an elliptic tube along half an ellipse in the plane y = 0, on the side of +x; its ends are inside the wall.
Mesh cup_handle() {
    Mesh mesh;
    add_grid(mesh, 24, 40, [&](double s, double t) {
        double const a = kPi * (t - 0.5), b = s == 1 ? 0 : 2 * kPi * s;
        Vec3 const centre{4.2 + 2.4 * std::cos(a), 0, 5.1 + 2.5 * std::sin(a)};
        Vec3 const out = glm::normalize(Vec3(std::cos(a) / 2.4, 0, std::sin(a) / 2.5)), side{0, 1, 0};
        double const wide = 0.5, thick = 0.28;
        mesh.p.push_back(centre + out * (thick * std::cos(b)) + side * (wide * std::sin(b)));
        mesh.n.push_back(glm::normalize(out * (std::cos(b) / thick) + side * (std::sin(b) / wide)));
    });
    return mesh;
}

// The tumbler's inner radius at height z, above its bottom.
double tumbler_radius(double z) { return 2.6 + 0.6 * (z - 1) / 9; }

// A tumbler, closed: foot, outer wall that widens upwards, rounded lip, inner wall, and a bottom 1 thick. Its walls are 0.3 thick.
Mesh tumbler() {
    constexpr double low = 1, high = 10, lip = 0.3 / 2;
    Vec2 const slope = glm::normalize(Vec2(0.6, high - low));  // up the wall
    Vec2 const out{slope.y, -slope.x};
    Mesh mesh;
    Vec2 const middle{tumbler_radius(high) + lip, high};  // of the lip
    constexpr double round = 0.5;  // radius of the foot's edge and of the inner bottom's
    Vec2 const foot_end = middle + lip * out - slope * ((high - round) / slope.y);
    Vec2 const foot_centre = foot_end - round * out;
    Vec2 const inner_end = middle - lip * out - slope * ((high - low - round) / slope.y);
    Vec2 const inner_centre = inner_end - round * out;
    double const turn = std::atan2(out.y, out.x);
    auto const straight = [&](int rows, Vec2 a, Vec2 b, Vec2 n) {
        add_lathe(mesh, 128, rows, [=](double t) { return ProfilePoint{a + t * (b - a), n}; });
    };
    auto const arc = [&](int rows, Vec2 centre, double radius, double from, double to, double side) {
        add_lathe(mesh, 128, rows, [=](double t) {
            double const a = from + t * (to - from);
            Vec2 const n{std::cos(a), std::sin(a)};
            return ProfilePoint{centre + radius * n, side * n};
        });
    };
    Vec2 const down{0, -1}, up{0, 1};
    straight(1, {0.01, foot_centre.y - round}, {foot_centre.x, foot_centre.y - round}, down);
    arc(8, foot_centre, round, -kPi / 2, turn, 1);
    straight(1, foot_end, middle + lip * out, out);
    arc(12, middle, lip, turn, turn + kPi, 1);
    straight(1, middle - lip * out, inner_end, -out);
    arc(8, inner_centre, round, turn, -kPi / 2, -1);
    straight(1, {inner_centre.x, inner_centre.y - round}, {0.01, inner_centre.y - round}, up);
    return mesh;
}

// What is drunk from the tumbler, up to z = 7.6: it reaches 0.15 into the glass, lest there be a film of air between them.
Mesh juice() {
    constexpr double low = 0.9, high = 7.6, into = 0.15;
    double const bottom = tumbler_radius(low) + into, top = tumbler_radius(high) + into;
    Mesh mesh;
    auto const straight = [&](Vec2 a, Vec2 b) {
        Vec2 const along = glm::normalize(b - a), n{along.y, -along.x};
        add_lathe(mesh, 128, 1, [=](double t) { return ProfilePoint{a + t * (b - a), n}; });
    };
    straight({0.01, low}, {bottom, low});
    straight({bottom, low}, {top, high});
    straight({top, high}, {0.01, high});
    return mesh;
}

// A curve through points, as smooth as Catmull and Rom's, turned around the z axis; it begins and ends along its first and last chord.
void add_turned_curve(Mesh& mesh, std::vector<Vec2> const& points, int rows_each) {
    auto const tangent = [&](std::size_t i) {
        std::size_t const before = i == 0 ? 0 : i - 1, after = std::min(i + 1, points.size() - 1);
        return (points[after] - points[before]) / double(after - before);
    };
    int const spans = int(points.size()) - 1;
    add_lathe(mesh, 128, spans * rows_each, [&](double t) {
        double const x = t * spans;
        auto const i = std::min(std::size_t(x), points.size() - 2);
        double const u = x - double(i), u2 = u * u, u3 = u2 * u;
        Vec2 const a = points[i], b = points[i + 1], da = tangent(i), db = tangent(i + 1);
        Vec2 const p =
            (2 * u3 - 3 * u2 + 1) * a + (u3 - 2 * u2 + u) * da + (3 * u2 - 2 * u3) * b + (u3 - u2) * db;
        Vec2 const along =
            glm::normalize(6 * (u2 - u) * (a - b) + (3 * u2 - 4 * u + 1) * da + (3 * u2 - 2 * u) * db);
        return ProfilePoint{p, {along.y, -along.x}};
    });
}

// The goblet's inside, from the rim's height down to the bottom of the bowl.
std::vector<Vec2> const kBowl{{2.55, 14}, {2.95, 12}, {3.12, 10}, {2.85, 8.2},
                              {2, 6.9},   {1, 6.35},  {0.01, 6.2}};

// A wine glass, closed: foot, stem, a bowl that narrows again upwards, and its inside.
Mesh goblet() {
    Mesh mesh;
    add_turned_curve(
        mesh, {{0.01, 0},   {1.2, 0},   {2.4, 0},   {3.2, 0.05}, {3.3, 0.16},    {3.1, 0.26},  {2, 0.42},
               {1, 0.72},   {0.5, 1.4}, {0.4, 2.5}, {0.4, 3.8},  {0.5, 5},       {0.95, 5.75}, {2.15, 6.65},
               {3.05, 8.1}, {3.3, 10},  {3.12, 12}, {2.72, 14},  {2.635, 14.09}, kBowl[0],     kBowl[1],
               kBowl[2],    kBowl[3],   kBowl[4],   kBowl[5],    kBowl[6]},
        5);
    return mesh;
}

// What is in it, up to z = 9.2: it reaches 0.08 into the glass.
Mesh wine() {
    constexpr double into = 0.08;
    Mesh mesh;
    add_turned_curve(
        mesh,
        {{0.01, 6.2 - into}, {1.02, 6.35 - into}, {2.06, 6.9 - into}, {2.85 + into, 8.2}, {3.03 + into, 9.2}},
        5);
    add_lathe(mesh, 128, 1, [](double t) {
        return ProfilePoint{{(3.03 + into) * (1 - t) + 0.01 * t, 9.2}, {0, 1}};
    });
    return mesh;
}

// A fir: three cones, one over the other, 1 high and 0.6 wide; the trunk is the scene's own.
Mesh fir() {
    Mesh mesh;
    struct Tier {
        double low, high, radius;
    };
    for (Tier const tier : {Tier{0.15, 0.60, 0.30}, Tier{0.38, 0.80, 0.23}, Tier{0.60, 1.0, 0.16}}) {
        double const height = tier.high - tier.low;
        add_lathe(mesh, 14, 1, [&](double t) {  // from below the skirt to its edge
            return ProfilePoint{{tier.radius * (0.2 + 0.8 * t), tier.low + 0.04 * (1 - t)}, {0, -1}};
        });
        add_lathe(mesh, 14, 1,
                  [&](double t) {  // up to the tip, which is a small circle: no triangle is degenerate
                      return ProfilePoint{{tier.radius * (1 - 0.98 * t), tier.low + height * t},
                                          {height, tier.radius}};
                  });
    }
    return mesh;
}

// A trefoil knot on a torus of radius 2, as a tube of radius 0.45, with (u, v) along and around.
Mesh knot() {
    Mesh mesh;
    add_grid(mesh, 14, 180, [&](double s, double t) {
        double const a = t == 1 ? 0 : 2 * kPi * t, b = s == 1 ? 0 : 2 * kPi * s;
        double const r = 2 + std::cos(3 * a), c = std::cos(2 * a), d = std::sin(2 * a);
        Vec3 const centre{r * c, r * d, std::sin(3 * a)};
        Vec3 const tangent = glm::normalize(Vec3(-3 * std::sin(3 * a) * c - 2 * r * d,
                                                 -3 * std::sin(3 * a) * d + 2 * r * c, 3 * std::cos(3 * a)));
        Vec3 const from_core{std::cos(3 * a) * c, std::cos(3 * a) * d, std::sin(3 * a)};
        Vec3 const side = glm::normalize(glm::cross(tangent, from_core)), out = glm::cross(side, tangent);
        Vec3 const n = out * std::cos(b) + side * std::sin(b);
        mesh.p.push_back(centre + 0.45 * n);
        mesh.n.push_back(n);
        mesh.uv.emplace_back(t, s);
    });
    return mesh;
}

// A chart for the eye to find (u, v) on: red grows with u, green with v, lines every eighth, a frame, and one white corner
// at (0, 0). 64 x 64 pixels, TGA without compression, lowest row first.
std::string chart() {
    constexpr int size = 64;
    std::string out(18, '\0');
    out[2] = 2;
    out[12] = out[14] = size;
    out[16] = 24;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            std::array<int, 3> rgb{48 + 3 * x, 48 + 3 * y, 96};
            if (x % 8 == 0 || y % 8 == 0) rgb = {32, 32, 40};
            if (x == size - 1 || y == size - 1) rgb = {32, 32, 40};
            if (x > 0 && x < 8 && y > 0 && y < 8) rgb = {250, 250, 250};
            for (int k : {2, 1, 0}) out += static_cast<char>(rgb[static_cast<std::size_t>(k)]);
        }
    return out;
}

void write(std::filesystem::path const& path, std::string const& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::fputs(
            "usage: make_meshes DIR   writes DIR/meshes/*.ply, DIR/textures/*.tga, "
            "DIR/include/valley/*.pbrt\n",
            stderr);
        return 2;
    }
    std::filesystem::path const dir = argv[1];
    write(dir / "meshes/waves.ply", ply(waves(), Format::Binary));
    write(dir / "meshes/box-water.ply", ply(box_water(), Format::Binary));
    write(dir / "meshes/cup-body.ply", ply(cup_body(), Format::Binary));
    write(dir / "meshes/cup-lip.ply", ply(cup_lip(), Format::Binary));
    write(dir / "meshes/cup-handle.ply", ply(cup_handle(), Format::Binary));
    write(dir / "meshes/knot.ply", ply(knot(), Format::Binary));
    write(dir / "meshes/tumbler.ply", ply(tumbler(), Format::Binary));
    write(dir / "meshes/juice.ply", ply(juice(), Format::Binary));
    write(dir / "meshes/goblet.ply", ply(goblet(), Format::Binary));
    write(dir / "meshes/wine.ply", ply(wine(), Format::Binary));
    write(dir / "meshes/creature.ply", ply(creature(), Format::Binary));
    write(dir / "meshes/fir.ply", ply(fir(), Format::Ascii));
    write(dir / "textures/chart.tga", chart());
    write(dir / "meshes/spruce.ply", ply(spruce(), Format::Binary));
    write(dir / "meshes/valley.ply", ply(valley_ground(), Format::Binary));
    write(dir / "textures/snow-line.tga", snow_line());
    write(dir / "include/valley/woods.pbrt", valley_woods());
    return 0;
} catch (std::exception const& error) {
    std::fprintf(stderr, "make_meshes: %s\n", error.what());
    return 4;
}
