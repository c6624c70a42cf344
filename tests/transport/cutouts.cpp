// Alpha: surfaces that are only partly there.
#include "measure.h"
#include "scenes.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

TextureId number(Scene& s, float value) { return s.add(Texture{ConstantFloatTexture{value}, {}}); }
/// 1 where u < 1/2, else 0, with whatever the shape's u is.
TextureId left_half(Scene& s) {
    CheckerboardTexture t;
    t.mapping = UvMapping{2, 1e-6f, 0, 0.5f};
    t.tex1 = number(s, 1);
    t.tex2 = number(s, 0);
    return s.add(Texture{t, {}});
}
Shape mesh() {
    TriangleMesh m = rectangle({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    m.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return m;
}
std::vector<Shape> screens() { return {mesh(), Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}}; }

/// A screen before an emitter of radiance 1.
Scene before_light(Shape const& shape, TextureId (*alpha)(Scene&), bool instanced) {
    Scene s;
    MaterialId const black = diffuse(s, 0.0f);
    TextureId const a = alpha(s);
    if (instanced) {
        Group g;
        add(g, shape, black).alpha = a;
        s.groups.push_back(g);
        Instance i;
        i.group = GroupId{static_cast<std::uint32_t>(s.groups.size() - 1)};
        i.to_parent = rows_of(translate(0, 0, 0.5));
        s.world().instances.push_back(i);
    } else {
        add(s, shape, black).alpha = a;
    }
    add(s, floor_quad(60, -2)).light = white(1, true);
    look_parallel(s, {0, 0, 5}, {0, 0, -1}, 0.9f);
    return s;
}

}  // namespace

TEST_CASE("a picture of alpha cuts a shape, also in instances") {
    for (Shape const& shape : screens())
        for (bool const instanced : {false, true}) {
            World const w = compile(before_light(shape, left_half, instanced));
            Settings s = settings(path(1), 2, 1);
            // Which half it is depends on how the camera's x lies; together they are one half.
            auto const means = measure(w, s, 4, true);
            CHECK(means[0][1].mean() + means[1][1].mean() == 1);
            CHECK(std::min(means[0][1].mean(), means[1][1].mean()) == 0);
        }
}

TEST_CASE("between 0 and 1 alpha is a chance: what is seen through k screens is (1 - alpha)^k") {
    auto const third = [](Scene& s) { return number(s, 0.3f); };
    for (Shape const& shape : screens()) {
        Scene one = before_light(shape, third, false);
        check_mean(compile(one), settings(path(1)), 256, 0.7);
        Object second = one.world().objects[0];
        second.to_group = translate(0, 0, 1);
        one.world().objects.push_back(second);
        check_mean(compile(one), settings(path(1)), 256, 0.49);
        check_mean(compile(before_light(shape, third, true)), settings(path(1)), 256, 0.7);
    }
}

TEST_CASE("parallel rays tell the places of a triangle apart, whatever its texture coordinates") {
    TriangleMesh m = rectangle({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    m.uv.assign(4, Vec2{0, 0});
    auto const third = [](Scene& s) { return number(s, 0.3f); };
    check_mean(compile(before_light(m, third, false)), settings(path(1)), 256, 0.7);
}

TEST_CASE("a sphere whose front is cut away shows its back") {
    Scene s;
    auto& ball = add(s, Sphere{1.0f}, diffuse(s, 0.0f));
    ball.alpha = number(s, 0.5f);
    add(s, floor_quad(60, -2)).light = white(1, true);
    look_parallel(s, {0, 0, 5}, {0, 0, -1}, 0.5f);
    check_mean(compile(std::move(s)), settings(path(1)), 256, 0.25);
}

TEST_CASE(
    "an emitter with alpha shines by as much, found by light sampling or by chance; shadows of alpha are as "
    "light") {
    Scene s;
    add(s, floor_quad(1), diffuse(s, 0.5f));
    auto& lamp = add(s, Quad{{-2, -2, 1}, {0, 4, 0}, {4, 0, 0}});
    lamp.light = white(1);
    lamp.alpha = left_half(s);
    auto& screen = add(s, Quad{{-2, -2, 0.5f}, {4, 0, 0}, {0, 4, 0}}, diffuse(s, 0.0f));
    screen.alpha = number(s, 0.4f);
    look_parallel(s, {0, 0, 0.4f}, {0, 0, -1}, 0.5f);
    World const w = compile(std::move(s));
    check_same({{"lights and MIS", &w, settings(path(1)), 256},
                {"by chance", &w, settings(naive(path(1))), 512},
                {"lights alone", &w, settings(without_mis(path(1))), 256}});
}

TEST_CASE("an area light of alpha 0 is not seen and shines all the same (pbrt)") {
    for (bool const unseen : {false, true}) {
        Scene s;
        add(s, floor_quad(1), diffuse(s, 1.0f));
        auto& lamp = add(s, Quad{{-0.5f, -0.5f, 1}, {0, 1, 0}, {1, 0, 0}});
        lamp.light = white(1);
        if (unseen) lamp.alpha = number(s, 0);
        look_at_point(s, {0, 0, 3}, {0, 0, 0});
        if (!unseen) look_at_point(s, {0.9f, 0, 0.5f}, {0, 0, 0});
        // Four corners of a rectangle over the point: E = 4 (1/2) [...] with a = b = 1/2, h = 1; radiance E / pi.
        double const a = 0.5, b = std::sqrt(1.25);
        double const irradiance = 4 * 0.5 * 2 * (a / b * std::atan(a / b));
        check_mean(compile(std::move(s)), point_settings(path(1)), 256, irradiance / 3.14159265358979);
    }
}

TEST_CASE("what a ray finds at a cut surface depends on nothing but the ray") {
    auto const half = [](Scene& s) { return number(s, 0.5f); };
    World const w = compile(before_light(screens()[0], half, true));
    Random r(7);
    RayStats stats;
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        Ray const ray{{static_cast<float>(r.uniform(-0.9, 0.9)), static_cast<float>(r.uniform(-0.9, 0.9)), 3},
                      {0, 0, -1}};
        SurfaceHit a, b;
        REQUIRE(w.intersect(ray, kInfinity, RayKind::Camera, stats, a));
        REQUIRE(w.intersect(ray, kInfinity, RayKind::Bounce, stats, b));
        REQUIRE(a.t == b.t);
        hits += a.t < 3;
    }
    CHECK(hits > 420);
    CHECK(hits < 580);
}
