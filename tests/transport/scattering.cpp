// Mixtures, interfaces, shading normals, and paths that must count once however they are found.
#include "measure.h"
#include "scenes.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

std::vector<PathIntegrator> all_ways(int depth) {
    return {path(depth), naive(path(depth)), without_mis(path(depth)), uniform_hemisphere(path(depth)),
            path(depth, RouletteKind::Throughput)};
}

/// A room with a light in its ceiling, open to the sky on one side, with mirror and glass.
Scene lit_room(bool smooth) {
    Scene s;
    MaterialId const gray = diffuse(s, 0.6f);
    MaterialId const red = diffuse(s, Vec3{0.7f, 0.2f, 0.1f});
    add(s, floor_quad(1), gray);
    add(s, rectangle({-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}), gray);
    add(s, rectangle({-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2}), red);
    add(s, rectangle({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}), gray);
    add(s, Sphere{0.35f, -0.35f, 0.35f}, smooth ? mirror(s, 0.9f) : gray).to_group =
        translate(-0.4, 0.3, 0.35);
    add(s, Sphere{0.35f, -0.35f, 0.35f}, smooth ? glass(s) : red).to_group = translate(0.4, -0.1, 0.8);
    add(s, Quad{{-0.6f, 0.6f, 1.99f}, {1.2f, 0, 0}, {0, -1.2f, 0}}, gray).light = white(2);
    s.add(sky(0.5f));
    PerspectiveCamera c;
    c.fov = radians(50);
    s.camera.kind = c;
    look(s, {1.5f, -2.5f, 1.2f}, {0, 0, 0.9f});
    return s;
}

}  // namespace

TEST_CASE("nothing counts twice: light sampling, chance and both agree") {
    for (bool smooth : {false, true}) {
        CAPTURE(smooth);
        World const world = compile(lit_room(smooth));
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
            std::vector<Variant> variants;
            for (auto const& p : all_ways(4)) {
                Settings s = settings(p, 8, 8);
                s.color = color;
                variants.push_back({"path " + std::to_string(variants.size()), &world, s, 32});
                if (color == ColorMode::Spectral && variants.size() == 2) break;
            }
            check_same(variants);
        }
    }
}

TEST_CASE("direct light: the direct integrator, Whitted's and a path of one bounce are one") {
    World const world = compile(lit_room(false));
    std::vector<Variant> variants;
    for (auto const& i : {Integrator{DirectIntegrator{1}}, Integrator{WhittedIntegrator{1}},
                          Integrator{path(1)}, Integrator{naive(path(1))}})
        variants.push_back({"variant " + std::to_string(variants.size()), &world, settings(i, 8, 8), 32});
    check_same(variants);
}

TEST_CASE("Whitted's tree sees in mirrors and glass what chance sees") {
    // Mirror and glass balls over an emitter that does not scatter: the tree is then complete.
    Scene s;
    add(s, Sphere{0.4f, -0.4f, 0.4f}, mirror(s, 0.9f)).to_group = translate(-0.5, 0, 0.5);
    add(s, Sphere{0.4f, -0.4f, 0.4f}, glass(s)).to_group = translate(0.5, 0, 0.5);
    add(s, floor_quad(1)).light = white(1);
    s.add(sky(0.25f));
    look_parallel(s, {0, -3, 1}, {0, 1, -0.2f}, 1);
    World const world = compile(s);
    check_same({{"path", &world, settings(path(8), 8, 8), 64},
                {"direct", &world, settings(DirectIntegrator{8}, 8, 8), 64},
                {"whitted", &world, settings(WhittedIntegrator{8}, 8, 8), 8}});
}

TEST_CASE("Whitted's tree sees in coats what chance sees") {
    // Black under the coat: what it mirrors is all there is.
    for (int const kind : {0, 1, 2}) {
        Scene s;
        PlasticMaterial plastic;
        plastic.reflectance = spectrum(s, ConstantSpd{0});
        CoatedDiffuseMaterial walks{plastic.reflectance, {}};
        walks.coat.model = CoatModel::Stochastic;
        CoatedConductorMaterial metal;
        metal.conductor.reflectance = spectrum(s, ConstantSpd{0.7f});
        MaterialId const m = kind == 0   ? material(s, plastic)
                             : kind == 1 ? material(s, walks)
                                         : material(s, metal);
        add(s, Sphere{0.4f, -0.4f, 0.4f}, m);
        s.add(sky());
        look_parallel(s, {0, -3, 0}, {0, 1, 0}, 0.5f);
        World const world = compile(s);
        CAPTURE(kind);
        check_same({{"path", &world, settings(path(8), 8, 8), 64},
                    {"whitted", &world, settings(WhittedIntegrator{8}, 8, 8), 8}});
    }
}

TEST_CASE("a mixture is the mean of what it mixes") {
    for (float amount : {0.0f, 0.3f, 1.0f}) {
        Scene s;
        MaterialId const a = diffuse(s, Vec3{0.2f, 0.5f, 0.4f});
        MaterialId const b = diffuse(s, Vec3{0.8f, 0.1f, 0.4f});
        TextureId const t = s.add(Texture{ConstantFloatTexture{amount}, {}});
        // A mixture within a mixture: the number that chose is used again.
        MaterialId const inner = material(s, MixMaterial{a, b, t});
        MaterialId const outer = material(s, MixMaterial{inner, inner, t});
        for (MaterialId const m : {inner, outer}) {
            Scene scene = s;
            add(scene, floor_quad(10), m);
            scene.add(sky());
            look_at_point(scene, {0.1f, 0, 1}, {0, 0, 0});
            World const world = compile(scene);
            Vec3 const expected{0.2f + 0.6f * amount, 0.5f - 0.4f * amount, 0.4f};
            for (Integrator const& i :
                 {Integrator{path(1)}, Integrator{DirectIntegrator{1}}, Integrator{WhittedIntegrator{1}}})
                check_mean(world, settings(i), 256, expected);
        }
    }
}

TEST_CASE("an interface is not there, except for what it emits") {
    for (bool emits : {false, true}) {
        CAPTURE(emits);
        Scene s;
        add(s, floor_quad(50), diffuse(s, 0.5f));
        s.add(sky());
        Object& o = add(s, Sphere{0.5f, -0.5f, 0.5f}, material(s, InterfaceMaterial{}));
        o.to_group = translate(0, 0, 2);
        if (emits) o.light = white(1);
        // Seen through the ball: its front emits 1, its back (from inside) nothing, the floor behind reflects the sky, and the
        // ball's own light: E = pi (R/d)^2 = pi/16 below it.
        look_at_point(s, {0, 0, 5}, {0, 0, 0});
        World const world = compile(s);
        double const expected = emits ? 1 + 0.5 + 0.5 / 16 : 0.5;
        for (auto const& p : all_ways(1)) check_mean(world, settings(p), 64, expected);
        check_mean(world, settings(DirectIntegrator{1}), 64, expected);
        check_mean(world, settings(WhittedIntegrator{1}), 64, expected);
        // From below, sky and ball: the ball hides nothing.
        Scene below = s;
        look_at_point(below, {0, 0.2f, 0.5f}, {0, 0, 0});
        World const floor = compile(below);
        for (auto const& p : all_ways(1)) check_mean(floor, settings(p), 64, emits ? 0.5 + 0.5 / 16 : 0.5);
    }
}

TEST_CASE("a mixture with an interface lets its share of light through, for eyes and for shadows") {
    for (float const share : {0.0f, 0.25f, 1.0f}) {
        CAPTURE(share);
        Scene s;
        MaterialId const white = diffuse(s, 1.0f);
        MaterialId const none = material(s, InterfaceMaterial{});
        TextureId const t = s.add(Texture{ConstantFloatTexture{share}, {}});
        MaterialId const veil = material(s, MixMaterial{white, none, t});
        // Under a white sky a white veil cannot be seen, nor can two of them.
        Scene furnace = s;
        add(furnace, Sphere{}, veil);
        add(furnace, Sphere{2, -2, 2}, veil);
        furnace.add(sky());
        look_parallel(furnace, {0, -5, 0}, {0, 1, 0}, 0.9f);
        World const bright = compile(furnace);
        check_mean(bright, settings(path(100)), 64, 1);
        check_mean(bright, settings(naive(path(100))), 64, 1);
        // Two black veils between a lamp and a floor: E = share^2 I / h^2, whichever way a path finds it.
        MaterialId const soot = material(s, MixMaterial{diffuse(s, 0.0f), none, t});
        add(s, floor_quad(50), diffuse(s, 0.5f));
        add(s, floor_quad(50, 1), soot).to_group = shear(0.3);
        add(s, rectangle({-9, -9, 1.5f}, {9, -9, 1.5f}, {9, 9, 1.5f}, {-9, 9, 1.5f}), soot);
        Scene delta = s;
        delta.add(point_light({0, 0, 2}, kPi));
        look_at_point(delta, {0.1f, 0, 0.5f}, {0, 0, 0});
        double const through = static_cast<double>(share) * static_cast<double>(share);
        World const below = compile(delta);
        check_mean(below, settings(path(1)), 64, through * 0.5 / 4);
        check_mean(below, settings(WhittedIntegrator{1}), 64, through * 0.5 / 4);
        // A disk of radius 2 at height 2: E = pi / 2.
        Object& disk = add(s, Disk{2, 2});
        disk.reverse_orientation = true;
        disk.light = test::white(1);
        look_at_point(s, {0.1f, 0, 0.5f}, {0, 0, 0});
        World const area = compile(s);
        for (auto const& p : all_ways(1)) check_mean(area, settings(p), 64, through * 0.25);
        // Seen from between the veils, the disk shines through the upper one.
        Scene up = s;
        look_at_point(up, {0.1f, 0, 1.2f}, {0, 0, 2});
        check_mean(compile(up), settings(path(0)), 64, static_cast<double>(share));
    }
}

TEST_CASE("a light behind an interface that emits is found in two ways, and counts once") {
    // Disks of radius 1 at height 1 and of radius 2 at height 2: E = pi R^2 / (R^2 + h^2) = pi/2 each, L = rho E / pi.
    Scene s;
    add(s, floor_quad(50), diffuse(s, 0.5f));
    Object& near = add(s, Disk{1, 1}, material(s, InterfaceMaterial{}));
    near.reverse_orientation = true;
    near.light = white(1);
    Object& far = add(s, Disk{2, 2});
    far.reverse_orientation = true;
    far.light = white(1);
    look_at_point(s, {0.1f, 0, 0.5f}, {0, 0, 0});
    World const world = compile(s);
    for (auto const& p : all_ways(1)) check_mean(world, settings(p), 64, 0.5);
    check_mean(world, settings(DirectIntegrator{1}), 64, 0.5);
    check_mean(world, settings(WhittedIntegrator{1}), 64, 0.5);
}

TEST_CASE("shading normals: light from above on a surface that pretends to lean by 30 degrees") {
    Scene s;
    TriangleMesh m = rectangle({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0});
    m.n.assign(4, Vec3{std::sin(radians(30)), 0, std::cos(radians(30))});
    add(s, m, diffuse(s, 0.5f));
    DistantLight l;
    l.from = {0, 0, 1};
    l.to = {0, 0, 0};
    l.scale = 3;
    s.add(Light{l, {}, {}});
    look_at_point(s, {0, 0.2f, 1}, {0, 0, 0});
    World const world = compile(s);
    double const expected = 0.5 * 3 / static_cast<double>(kPi) * std::sqrt(3.0) / 2;
    for (Integrator const& i :
         {Integrator{path(3)}, Integrator{DirectIntegrator{1}}, Integrator{WhittedIntegrator{1}}})
        check_mean(world, settings(i), 4, expected);
}

TEST_CASE("gray scenes look the same in both colour modes") {
    Scene s = lit_room(true);
    for (Texture& t : s.textures)
        if (auto* c = std::get_if<ConstantSpectrumTexture>(&t.kind))
            if (std::holds_alternative<RgbAlbedoSpd>(c->value)) c->value = RgbAlbedoSpd{{0.4f, 0.4f, 0.4f}};
    World const world = compile(s);
    Settings rgb = settings(path(4), 8, 8);
    Settings spectral = rgb;
    spectral.color = ColorMode::Spectral;
    check_same({{"rgb", &world, rgb, 64}, {"spectral", &world, spectral, 128}});
}

TEST_CASE("what lies beside the beauty: the first hit's albedo, normals, depth, place and material") {
    Scene s;
    MaterialId const tinted = diffuse(s, Vec3{0.2f, 0.5f, 0.8f});
    MaterialId const other = diffuse(s, 0.3f);
    TriangleMesh m = rectangle({-5, -5, 1}, {0, -5, 1}, {0, 5, 1}, {-5, 5, 1});
    Vec3 const leaning{0.6f, 0, 0.8f};
    m.n.assign(4, leaning);
    add(s, m, other);
    add(s, rectangle({0, -5, 0}, {3, -5, 0}, {3, 5, 0}, {0, 5, 0}), tinted);
    s.add(sky());
    look_parallel(s, {0, 0, 4}, {0, 0, -1}, 4);
    World const world = compile(s);
    for (Integrator const& i :
         {Integrator{path(2)}, Integrator{DirectIntegrator{1}}, Integrator{WhittedIntegrator{1}}}) {
        Settings settings = point_settings(i, 8, 8);
        settings.film.aovs = true;
        RenderJob const job(world, settings);
        Film film = job.make_film();
        RayStats stats;
        for (std::uint64_t pass = 0; pass < 8; ++pass) render_pass(job, pass, film, stats);
        CHECK(film.passes().count() == 8);
        CHECK(film.dropped() == 0);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                Ray const r =
                    job.camera()
                        .ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {0.5f, 0.5f})
                        .ray;
                bool const left = r.o.x < 0;
                bool const nothing = r.o.x > 3;
                AovSums const& a = film.aov(x, y);
                double const w = film.pixel(x, y).weight;
                CHECK(w == 8);
                CHECK(a.hits == (nothing ? 0 : 8));
                if (nothing) {
                    CHECK(a.albedo[1] == 0);
                    CHECK(a.material == 0xFFFFFFFFu);
                    continue;
                }
                CHECK(a.depth / w == doctest::Approx(left ? 3 : 4));
                CHECK(a.albedo[0] / w == doctest::Approx(left ? 0.3 : 0.2));
                CHECK(a.albedo[2] / w == doctest::Approx(left ? 0.3 : 0.8));
                CHECK(a.shading_normal[0] / w == doctest::Approx(left ? 0.6 : 0));
                CHECK(a.shading_normal[2] / w == doctest::Approx(left ? 0.8 : 1));
                CHECK(a.geometric_normal[2] / w == doctest::Approx(1));
                CHECK(a.position[0] / w == doctest::Approx(static_cast<double>(r.o.x)).epsilon(1e-3));
                CHECK(std::abs(a.position[2] / w - (left ? 1 : 0)) < 1e-6);
                CHECK(a.material == (left ? other.value : tinted.value));
            }
    }
}

TEST_CASE("samples that are not numbers are dropped and counted") {
    // The largest scale that is a number: two bounces of it overflow, and the film must say so.
    Scene s;
    Object& o = add(s, Sphere{}, diffuse(s, 0.9f));
    o.reverse_orientation = true;
    o.light = white(3e38f);
    look_around(s, {0, 0, 0});
    World const world = compile(s);
    Settings settings = test::settings(naive(path(20)));
    RenderJob const job(world, settings);
    Film film = job.make_film();
    RayStats stats;
    render_pass(job, 0, film, stats);
    CHECK(film.dropped() == 4);
    for (int i = 0; i < 4; ++i) CHECK(film.pixel(i % 2, i / 2).rgb[0] == 0);
    CHECK_FALSE(film.add(0, 0, {std::nanf(""), 0, 0}, 1));
    CHECK_FALSE(film.add(0, 0, {0, kInfinity, 0}, 1));
}
