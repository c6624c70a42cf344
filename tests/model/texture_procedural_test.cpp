// Patterns by formula against what they are by definition.
#include "model/noise.h"
#include "model/texture.h"

#include "support.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

TexturePoint at(Vec2 uv, Vec2 dx = {0, 0}, Vec2 dy = {0, 0}) {
    TexturePoint p;
    p.uv = uv, p.duv_dx = dx, p.duv_dy = dy;
    return p;
}
Vec3 random_point(Random& r, double size) {
    Vec3 p;
    for (int i = 0; i < 3; ++i) p[i] = static_cast<float>(r.uniform(-size, size));
    return p;
}
Mat4 some_matrix() { return translate(1, -2, 0.5) * rotate(40, 1, 2, 3).value() * scale(0.5, 2, 1.5); }

/// The average of (-1)^floor(x) around x under a triangle that reaches r to either side, by brute force.
double stripes(double x, double r) {
    constexpr int kSteps = 20000;
    double sum = 0, weights = 0;
    for (int i = 0; i < kSteps; ++i) {
        double const offset = 2 * (i + 0.5) / kSteps - 1;
        double const w = 1 - std::abs(offset);
        double const parity = std::floor(x + r * offset);
        sum += w * (parity - 2 * std::floor(parity / 2) == 0 ? 1 : -1);
        weights += w;
    }
    return sum / weights;
}

struct Board {
    explicit Board(int dimension) {
        CheckerboardTexture t;
        t.tex1 = add_number(scene, 2), t.tex2 = add_number(scene, 5);
        t.dimension = dimension;
        t.world_to_texture = some_matrix();
        id = scene.add(Texture{t, {}});
        assets.emplace(scene);
    }
    /// The share of the second texture.
    [[nodiscard]] double second(TexturePoint const& p) const {
        return (static_cast<double>(evaluate_float(*assets, id, p)) - 2) / 3;
    }
    Scene scene;
    TextureId id;
    std::optional<Assets> assets;
};

}  // namespace

TEST_CASE("checkerboards are averaged over the footprint: in two dimensions") {
    Board const board(2);
    Random r(1);
    for (int i = 0; i < 150; ++i) {
        double const size = std::pow(10.0, r.uniform(-4, 1));
        auto const random = [&](double s) {
            float const x = static_cast<float>(r.uniform(-s, s));
            return Vec2{x, static_cast<float>(r.uniform(-s, s))};
        };
        Vec2 uv = random(4);
        if (i % 3 == 0) uv.x = std::round(uv.x) + static_cast<float>(0.3 * size);  // by an edge
        Vec2 const dx = random(size), dy = random(size);
        double product = 1;
        for (int k = 0; k < 2; ++k)
            product *= stripes(static_cast<double>(uv[k]),
                               1.5 * static_cast<double>(std::max(std::abs(dx[k]), std::abs(dy[k]))));
        CAPTURE(size);
        CHECK(std::abs(board.second(at(uv, dx, dy)) - (0.5 - 0.5 * product)) < 2e-4);
    }
    // Far from the origin and nearly a point: differences of differences must not cancel to noise.
    for (float const u : {1000.0f, 4096.0f, -65536.0f})
        CHECK(board.second(at({u, 0.5f}, {1e-4f, 0}, {0, 1e-4f})) == doctest::Approx(0.5).epsilon(1e-3));
    for (float const wide : {50.0f, 1e6f, 1e30f, kInfinity})
        CHECK(std::abs(board.second(at({0.3f, 0.4f}, {wide, 0}, {0, wide})) - 0.5) < 1e-3);
    CHECK(std::isfinite(board.second(at({std::nanf(""), kInfinity}, {1, 0}, {0, 1}))));
}

TEST_CASE("checkerboards are averaged over the footprint: in three dimensions") {
    Board const board(3);
    Transform const t = make_transform(some_matrix()).value();
    Random r(2);
    for (int i = 0; i < 100; ++i) {
        Vec3 const p = random_point(r, 3), dx = random_point(r, 0.5), dy = random_point(r, 0.5);
        Vec3 const q = t.point(p), qx = t.vector(dx), qy = t.vector(dy);
        double product = 1;
        for (int k = 0; k < 3; ++k)
            product *= stripes(static_cast<double>(q[k]),
                               1.5 * static_cast<double>(std::max(std::abs(qx[k]), std::abs(qy[k]))));
        CHECK(std::abs(board.second(at_point(p, dx, dy)) - (0.5 - 0.5 * product)) < 2e-4);
    }
}

TEST_CASE("dots: none or one in a unit cell, of radius 0.35, within it") {
    Scene s;
    DotsTexture dots;
    dots.inside = add_number(s, 1), dots.outside = add_number(s, 0);
    auto const id = s.add(Texture{dots, {}});
    Assets const a(s);
    int with_dot = 0;
    constexpr int kCells = 16, kGrid = 64;
    for (int cy = 0; cy < kCells; ++cy)
        for (int cx = 0; cx < kCells; ++cx) {
            // Cells have their middles at whole numbers.
            Vec2 const corner{static_cast<float>(cx - 8) - 0.5f, static_cast<float>(cy - 8) - 0.5f};
            std::vector<Vec2> inside;
            Vec2 center{0, 0};
            for (int y = 0; y < kGrid; ++y)
                for (int x = 0; x < kGrid; ++x) {
                    Vec2 const st =
                        corner + Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} /
                                     static_cast<float>(kGrid);
                    if (evaluate_float(a, id, at(st)) == 0) continue;
                    inside.push_back(st);
                    center += st;
                }
            if (inside.empty()) continue;
            ++with_dot;
            double const area = static_cast<double>(inside.size()) / (kGrid * kGrid);
            CHECK(area == doctest::Approx(kPiD * 0.35 * 0.35).epsilon(0.02));
            center /= static_cast<float>(inside.size());
            for (Vec2 const st : inside) CHECK(glm::length(st - center) < 0.36f);
            for (int k = 0; k < 2; ++k) CHECK(std::abs(center[k] - corner[k] - 0.5f) < 0.15f + 0.01f);
        }
    CHECK(with_dot > kCells * kCells / 4);
    CHECK(with_dot < kCells * kCells * 3 / 4);
}

TEST_CASE("bilerp: its corners, a plane between them, and on beyond") {
    Scene s;
    BilerpTexture numbers;
    numbers.v00 = add_number(s, 1), numbers.v01 = add_number(s, 2);
    numbers.v10 = add_number(s, 4), numbers.v11 = add_number(s, 8);
    auto const n = s.add(Texture{numbers, {}});
    BilerpTexture colors;
    colors.v00 = add_color(s, {0.1f, 0, 0}), colors.v01 = add_color(s, {0, 0.5f, 0});
    colors.v10 = add_color(s, {0, 0, 0.9f}), colors.v11 = add_color(s, {0.3f, 0.3f, 0.3f});
    colors.mapping = UvMapping{2, 1, 0, 0};
    auto const c = s.add(Texture{colors, {}});
    Assets const a(s);
    CHECK(evaluate_float(a, n, at({0, 0})) == 1);
    CHECK(evaluate_float(a, n, at({0, 1})) == 2);
    CHECK(evaluate_float(a, n, at({1, 0})) == 4);
    CHECK(evaluate_float(a, n, at({1, 1})) == 8);
    CHECK(evaluate_float(a, n, at({0.25f, 0.5f})) == doctest::Approx(0.75 * 1.5 + 0.25 * 6));
    CHECK(evaluate_float(a, n, at({2, 0})) == 7);
    Spectrum const v = evaluate_spectrum(a, c, at({0.25f, 0.5f}), Wavelengths::rgb());
    CHECK(v[0] == doctest::Approx(0.25 * (0.1 + 0.3)));
    CHECK(v[1] == doctest::Approx(0.25 * (0.5 + 0.3)));
    CHECK(v[2] == doctest::Approx(0.25 * (0.9 + 0.3)));
}

TEST_CASE(
    "directionmix weighs by the cosine between the normal and its direction, whichever way either points") {
    Scene s;
    auto const two = add_number(s, 2), five = add_number(s, 5);
    auto const id = s.add(Texture{DirectionMixTexture{two, five, {0, 3, 0}}, {}});
    Assets const a(s);
    auto const seen = [&](Vec3 n) {
        TexturePoint p;
        p.n = n;
        return evaluate_float(a, id, p);
    };
    CHECK(seen({0, 1, 0}) == 2);
    CHECK(seen({0, -1, 0}) == 2);
    CHECK(seen({1, 0, 0}) == 5);
    CHECK(seen({0.6f, 0.8f, 0}) == doctest::Approx(0.8 * 2 + 0.2 * 5));
    CHECK(seen({0, -0.6f, 0.8f}) == doctest::Approx(0.6 * 2 + 0.4 * 5));
    CHECK(seen({0, 1.0001f, 0}) == 2);  // rounding does not extrapolate
}

TEST_CASE("fbm, wrinkled and windy are noise in texture space, filtered by the footprint there") {
    Scene s;
    auto const id = [&](TextureKind kind) { return s.add(Texture{std::move(kind), {}}); };
    auto const brown = id(FbmTexture{some_matrix(), 5, 0.6f}),
               wrinkled = id(WrinkledTexture{some_matrix(), 3, 0.4f}),
               windy = id(WindyTexture{some_matrix()});
    Assets const a(s);
    Transform const t = make_transform(some_matrix()).value();
    Random r(3);
    for (int i = 0; i < 300; ++i) {
        double const size = std::pow(10.0, r.uniform(-3, -1));
        TexturePoint const p = at_point(random_point(r, 5), random_point(r, size), random_point(r, size));
        Octaves o{t.point(p.p), t.vector(p.dpdx), t.vector(p.dpdy), 0.6f, 5};
        CHECK(evaluate_float(a, brown, p) == fbm(o));
        o.roughness = 0.4f, o.count = 3;
        CHECK(evaluate_float(a, wrinkled, p) == turbulence(o));
        o.roughness = 0.5f, o.count = 6;
        Octaves const tenth{0.1f * o.p, 0.1f * o.dpdx, 0.1f * o.dpdy, 0.5f, 3};
        CHECK(evaluate_float(a, windy, p) == doctest::Approx(std::abs(fbm(tenth)) * fbm(o)));
    }
    // As a spectrum, should a hand-made scene ask for it: gray.
    Spectrum const gray = evaluate_spectrum(a, brown, at_point({1, 2, 3}), Wavelengths::spectral(0.3f));
    CHECK(gray[2] == evaluate_float(a, brown, at_point({1, 2, 3})));
}

TEST_CASE("marble: layers of Bézier colours along y, bent by noise") {
    Scene s;
    auto const straight = s.add(Texture{MarbleTexture{Mat4{}, 4, 0.5f, 2, 0}, {}});
    auto const bent = s.add(Texture{MarbleTexture{some_matrix(), 4, 0.5f, 2, 0.7f}, {}});
    Assets const a(s);
    auto const rgb = Wavelengths::rgb();
    double const colors[9][3] = {{.58, .58, .6}, {.58, .58, .6}, {.58, .58, .6},
                                 {.5, .5, .5},   {.6, .59, .58}, {.58, .58, .6},
                                 {.58, .58, .6}, {.2, .2, .33},  {.58, .58, .6}};
    // De Casteljau's construction.
    auto const expected = [&](double layer, int channel) {
        double const t = 6 * (0.5 + 0.5 * std::sin(layer));
        int const first = std::min(5, static_cast<int>(t));
        double c[4];
        for (int i = 0; i < 4; ++i) c[i] = colors[first + i][channel];
        for (int n = 3; n > 0; --n)
            for (int i = 0; i < n; ++i) c[i] += (t - first) * (c[i + 1] - c[i]);
        return 1.5 * c[0];
    };
    Transform const t = make_transform(some_matrix()).value();
    Random r(4);
    int compared = 0;
    for (int i = 0; i < 500; ++i) {
        TexturePoint const p = at_point(random_point(r, 3));
        Vec3 const q = 2.0f * t.point(p.p);
        double const layers[2] = {
            2 * static_cast<double>(p.p.y),
            static_cast<double>(q.y) + 0.7 * static_cast<double>(fbm({q, {}, {}, 0.5f, 4}))};
        for (int k = 0; k < 2; ++k) {
            double const along = 6 * (0.5 + 0.5 * std::sin(layers[k]));
            if (std::abs(along - std::round(along)) < 1e-4)
                continue;  // segments do not join: rounding decides there
            ++compared;
            Spectrum const v = evaluate_spectrum(a, k ? bent : straight, p, rgb);
            for (int c = 0; c < 3; ++c)
                CHECK(std::abs(static_cast<double>(v[c]) - expected(layers[k], c)) < 1e-3);
        }
    }
    CHECK(compared > 900);
    TexturePoint const lost = at_point({kInfinity, std::nanf(""), 0});
    CHECK(std::isfinite(evaluate_spectrum(a, bent, lost, rgb)[0]));
}
