// Irradiance under area lights, seen as the radiance E / pi of a white floor.
#include "emitters.h"
#include "measure.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// A white floor, of which a square of this half side is seen from just above.
Scene bench(float half, Vec3 centre = {0, 0, 0}) {
    Scene s;
    add(s, floor_quad(50), diffuse(s, 1));
    look_parallel(s, centre + Vec3{0, 0, 0.01f}, {0, 0, -1}, half);
    return s;
}

/// The points of the floor that the pixels look at.
D3 floor_point(World const& world, Settings const& s, std::size_t i) {
    auto const x = static_cast<int>(i) % s.film.resolution.x;
    auto const y = static_cast<int>(i) / s.film.resolution.x;
    RenderJob const job(world, s);
    Ray const r =
        job.camera().ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {0.5f, 0.5f}).ray;
    return {r.o.x, r.o.y, 0};
}

template <class Irradiance>
void check_floor(World const& world, Settings const& s, Irradiance const& irradiance,
                 std::uint64_t passes = 64) {
    std::vector<Vec3> expected;
    for (int i = 0; i < s.film.resolution.x * s.film.resolution.y; ++i)
        expected.emplace_back(
            static_cast<float>(irradiance(floor_point(world, s, static_cast<std::size_t>(i))) / kPiD));
    check_pixels(world, s, passes, [&](std::size_t i) { return expected[i]; });
}

}  // namespace

TEST_CASE("sphere light: E = pi L (R/d)^2 cos") {
    Scene scene = bench(1.5f);
    Object& o = add(scene, Sphere{});
    o.to_group = translate(0, 0, 2);
    o.light = white(1);
    look_at_point(scene, {0.1f, 0, 0.2f}, {0, 0, 0});
    World const facing = compile(scene);
    for (Integrator const& i : one_bounce()) check_mean(facing, settings(i), 64, 0.785398 / kPiD);
    look_parallel(scene, {0, 0, 0.01f}, {0, 0, -1}, 1.5f);
    World const tilted = compile(scene);
    check_floor(tilted, point_settings(DirectIntegrator{1}, 4, 4), [](D3 p) {
        double const d2 = p[0] * p[0] + p[1] * p[1] + 4;
        return kPiD / d2 * 2 / std::sqrt(d2);
    });
}

TEST_CASE("disk light with a lateral offset") {
    // R = h = 1: a = 0 gives pi/2, a = 1 .868315.
    auto const expected = [](D3 p) {
        double const a2 = p[0] * p[0] + p[1] * p[1];
        double const q = a2 + 2;
        return kPiD / 2 * (1 - a2 / std::sqrt(q * q - 4 * a2));
    };
    CHECK(expected({0, 0, 0}) == doctest::Approx(1.570796));
    CHECK(expected({1, 0, 0}) == doctest::Approx(.868315));
    for (bool turned : {false, true}) {
        Scene scene = bench(2);
        Object& o = add(scene, Disk{});
        o.to_group = turned ? translate(0, 0, 1) * rotation(180, 1, 0, 0) : translate(0, 0, 1);
        o.reverse_orientation = !turned;
        o.light = white(1);
        World const world = compile(scene);
        check_floor(world, point_settings(DirectIntegrator{1}, 5, 5), expected);
        Scene centre = scene;
        look_at_point(centre, {0.1f, 0, 0.2f}, {0, 0, 0});
        World const below = compile(centre);
        look_at_point(centre, {1.1f, 0, 0.2f}, {1, 0, 0});
        World const beside = compile(centre);
        for (Integrator const& i : one_bounce()) {
            check_mean(below, settings(i), 64, 1.570796 / kPiD);
            check_mean(beside, settings(i), 64, .868315 / kPiD);
        }
    }
}

TEST_CASE("rectangle over a corner, of triangles, a quad and a bilinear patch") {
    // a = b = h = 1: .435210.
    Vec3 const p[4] = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};  // looks down
    BilinearMesh patch;
    patch.p = {p[0], p[1], p[3], p[2]};
    patch.patches = {{0, 1, 2, 3}};
    CHECK(polygon_irradiance({0, 0, 0}, {doubles(p[0]), doubles(p[1]), doubles(p[2]), doubles(p[3])}) ==
          doctest::Approx(.435210));
    for (Shape const& shape : {Shape{rectangle(p[0], p[1], p[2], p[3])},
                               Shape{Quad{p[0], p[1] - p[0], p[3] - p[0]}}, Shape{patch}}) {
        Scene scene = bench(1);
        add(scene, shape).light = white(1);
        look_at_point(scene, {-0.1f, 0, 0.2f}, {0, 0, 0});
        World const world = compile(scene);
        for (Integrator const& i : one_bounce()) check_mean(world, settings(i), 64, .435210 / kPiD);
    }
}

TEST_CASE("emission has one side or two") {
    for (auto const& e : emitting_shapes()) {
        if (!e.flat) continue;
        CAPTURE(e.name);
        for (auto const& where : placements())
            for (int nesting : {0, 1})
                for (bool two_sided : {false, true}) {
                    CAPTURE(where.name);
                    Scene scene = bench(0.8f);
                    place(scene, e, where, nesting, white(1, two_sided));
                    // The same light, turned over.
                    scene.groups.back().objects.back().reverse_orientation = true;
                    World const world = compile(scene);
                    check_floor(
                        world, point_settings(DirectIntegrator{1}, 2, 1),
                        [&](D3 p) { return two_sided ? e.irradiance(turned(e, where.all()), p) : 0.0; }, 16);
                }
    }
}

TEST_CASE("emitters under any transform, alone and in instances, are what they look like") {
    for (auto const& e : emitting_shapes()) {
        CAPTURE(e.name);
        for (auto const& where : placements()) {
            CAPTURE(where.name);
            for (int nesting : {0, 1, 2}) {
                CAPTURE(nesting);
                Scene scene = bench(0.8f);
                place(scene, e, where, nesting, white(1));
                World const world = compile(scene);
                auto const expected = [&](D3 p) { return e.irradiance(turned(e, where.all()), p); };
                check_floor(world, point_settings(DirectIntegrator{1}, 2, 1), expected);
                if (nesting == 2 && where.name == "all at once")
                    check_floor(world, point_settings(naive(path(1)), 1, 1), expected, 256);
            }
        }
    }
}

TEST_CASE("box light: the sum of its visible faces, also where one appears") {
    // 64 points along the floor, some of them just before and just after the plane of a face (x = 1/2, y = 1/2).
    Scene scene = bench(0.875f);
    Object& o = add(scene, Box{{-0.5f, -0.5f, 0.5f}, {0.5f, 0.5f, 1.5f}});
    o.light = white(1);
    World const world = compile(scene);
    auto const expected = [&](D3 p) {
        double sum = 0;
        for (auto const& f :
             std::vector<std::vector<D3>>{{{-.5, -.5, .5}, {-.5, .5, .5}, {.5, .5, .5}, {.5, -.5, .5}},
                                          {{.5, -.5, .5}, {.5, .5, .5}, {.5, .5, 1.5}, {.5, -.5, 1.5}},
                                          {{-.5, .5, .5}, {-.5, -.5, .5}, {-.5, -.5, 1.5}, {-.5, .5, 1.5}},
                                          {{.5, .5, .5}, {-.5, .5, .5}, {-.5, .5, 1.5}, {.5, .5, 1.5}},
                                          {{-.5, -.5, .5}, {.5, -.5, .5}, {.5, -.5, 1.5}, {-.5, -.5, 1.5}}})
            sum += std::max(0.0, polygon_irradiance(p, f));
        return sum;
    };
    check_floor(world, point_settings(DirectIntegrator{1}, 8, 8), expected);
    for (float x : {0.499f, 0.501f}) {
        Scene edge = scene;
        look_at_point(edge, {x, 0.1f, 0.2f}, {x, 0, 0});
        World const at_edge = compile(edge);
        check_mean(at_edge, settings(DirectIntegrator{1}), 64, expected({x, 0, 0}) / kPiD);
    }
}

TEST_CASE("form factors of the unit cube") {
    // The face that is seen reflects everything, one face emits, the others are black: L = F.
    auto const factor = [](Quad const& emitter) {
        Scene s;
        add(s, Quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, diffuse(s, 1));
        add(s, emitter).light = white(1);
        look_parallel(s, {0.5f, 0.5f, 1e-3f}, {0, 0, -1}, 0.5f);
        return compile(s);
    };
    World const opposite = factor(Quad{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
    World const adjacent[] = {
        factor(Quad{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}), factor(Quad{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}),
        factor(Quad{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}), factor(Quad{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}})};
    for (Integrator const& i :
         {Integrator{DirectIntegrator{1}}, Integrator{path(1)}, Integrator{naive(path(1))}}) {
        check_mean(opposite, settings(i, 4, 4), 16, .199825);
        for (World const& w : adjacent) check_mean(w, settings(i, 4, 4), 16, .200044);
    }
}

TEST_CASE("a lamp does not light its own back") {
    // A tilted triangle, which rounding lifts hits out of: half of them would see all of it, from next to nothing away.
    Scene scene;
    TriangleMesh mesh;
    mesh.p = {{-3.1f, -2.7f, 0}, {3.3f, -2.9f, 0}, {0.1f, 4.3f, 0}};
    mesh.triangles = {{0, 1, 2}};
    for (bool const two_sided : {false, true}) {
        Scene s = scene;
        Object& o = add(s, mesh, diffuse(s, 1));
        o.to_group = translate(-4, 0.3f, 6) * rotation(120, 0, 1, 0);
        o.light = white(10, two_sided);
        // From behind: the normal is (sin 120, 0, cos 120).
        look_at_point(s, {-8, 0.1f, 8.4f}, {-4, 0.3f, 6});
        World const world = compile(s);
        for (Integrator const& i : one_bounce()) check_mean(world, settings(i), 64, two_sided ? 10 : 0);
    }
}
