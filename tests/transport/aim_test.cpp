// Aim: rays are as its densities say, photons as without it, and there are many more of them.
#include "image/write.h"
#include "photons.h"

#include "../../src/transport/aim.h"
#include "../../src/transport/caster_balls.h"

#include <unistd.h>
#include <filesystem>
#include <numeric>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// A picture with a dark half, a bright spot and a slope.
ImageId picture(Scene& s) {
    static std::string const path =
        (std::filesystem::temp_directory_path() / ("nephroid_aim_" + std::to_string(::getpid()) + ".pfm"))
            .string();
    static bool const written = [] {
        Image image(PixelFormat::Float, 16, 16, {"R", "G", "B"});
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                float const v = x < 5 ? 0.0f : x == 9 && y == 6 ? 40.0f : 0.1f * static_cast<float>(y + 1);
                for (int c = 0; c < 3; ++c) image.set(x, y, c, v);
            }
        write_pfm(path, image);
        return true;
    }();
    CHECK(written);
    return s.add(ImageFile{path, "", {}});
}

struct Kind {
    std::string name;
    std::function<void(Scene&)> add;
};
/// Lights over casters near (0, 0, 0); those with a surface shine down.
std::vector<Kind> kinds() {
    auto const surface = [](Shape shape, Mat4 where, AreaLight light) {
        return [=](Scene& s) {
            Object& o = test::add(s, shape);
            o.to_group = where;
            o.light = light;
        };
    };
    auto const plain = [](auto kind, Mat4 where = {}) {
        return [=](Scene& s) { s.add(Light{kind, where, {}}); };
    };
    auto const pictured = [](auto kind, Mat4 where = {}) {
        return [=](Scene& s) {
            auto k = kind;
            k.image = picture(s);
            s.add(Light{k, where, {}});
        };
    };
    Mat4 const down = rotation(180, 1, 0, 0);
    Mat4 const high = translate(0.3, 0.2, 3);
    std::vector<Kind> k;
    k.push_back({"point", [](Scene& s) { s.add(point_light({0.3f, 0.2f, 3}, 1)); }});
    k.push_back({"spot", [](Scene& s) { s.add(spot_light({0.3f, 0.2f, 3}, {0, 0, 0}, 1, 20, 12)); }});
    k.push_back({"rectangle", surface(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, high * down, white(1))});
    k.push_back({"two-sided", surface(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, high * rotation(70, 1, 0, 0),
                                      white(1, true))});
    k.push_back({"sphere", surface(Sphere{0.5f, -0.5f, 0.5f}, high, white(1))});
    k.push_back({"box", surface(Box{{-0.4f, -0.3f, -0.2f}, {0.4f, 0.3f, 0.2f}}, high, white(1))});
    k.push_back({"disk, tilted", surface(Disk{}, high * rotation(120, 1, 1, 0), white(1))});
    k.push_back({"cylinder", surface(Cylinder{0.3f, -1, 1}, high * rotation(80, 1, 0, 0), white(1))});
    k.push_back({"triangle",
                 surface(TriangleMesh{.p = {{-1, -1, 0}, {-1, 1, 0}, {1, 0, 0}}, .triangles = {{0, 1, 2}}},
                         high, white(1))});
    k.push_back({"picture on a rectangle", [](Scene& s) {
                     Object& o = test::add(s, Quad{{-1, -1, 3}, {0, 2, 0}, {2, 0, 0}});
                     o.light = white(1);
                     o.light->image = picture(s);
                 }});
    k.push_back({"cut-out rectangle", [](Scene& s) {
                     Object& o = test::add(s, Quad{{-1, -1, 3}, {0, 2, 0}, {2, 0, 0}});
                     o.light = white(1);
                     CheckerboardTexture t;
                     t.tex1 = s.add(Texture{ConstantFloatTexture{1}, {}});
                     t.tex2 = s.add(Texture{ConstantFloatTexture{0}, {}});
                     o.alpha = s.add(Texture{t, {}});
                 }});
    k.push_back({"goniometric", pictured(GoniometricLight{}, high)});
    k.push_back({"projection", pictured(ProjectionLight{}, high * down)});
    MeasuredLight lamp;
    lamp.table = {{0, 0.3f, 0.8f, 1.5f}, {0, 2, kTwoPi}, {5, 3, 1, 0, 2, 4, 2, 0, 5, 3, 1, 0}};
    k.push_back({"measured", plain(lamp, high)});
    k.push_back({"distant", [](Scene& s) { s.add(distant({0.3f, 0.2f, 1})); }});
    k.push_back({"infinite", [](Scene& s) { s.add(sky()); }});
    k.push_back({"infinite picture", pictured(InfiniteLight{}, rotation(70, 1, 0.5, 0))});
    SunSkyLight day;
    day.sun_direction = {0.4f, 0.1f, 1};
    k.push_back({"sun and sky", plain(day)});
    InfiniteLight through;
    through.portal = std::array{Vec3{-1, -1, 3}, Vec3{-1, 1, 3}, Vec3{1, 1, 3}, Vec3{1, -1, 3}};
    k.push_back({"portal", plain(through)});
    return k;
}

/// Casters of several kinds, two of which touch and two overlap.
void add_casters(Scene& s) {
    add_sphere(s, {0.5f, 0, 0}, 0.4f, glass(s));
    add_sphere(s, {-0.4f, 0.3f, 0.2f}, 0.5f, mirror(s, 0.9f));
    add_sphere(s, {-0.2f, -0.6f, 0}, 0.25f, glass(s));
    add(s, Quad{{-2, 1.2f, 0}, {0.8f, 0, 0.4f}, {0, 0.5f, 0}}, mirror(s, 0.9f));
}

struct Draw {
    Vec2 position, direction;
};
Draw draw(Random& random) { return {{random.unit(), random.unit()}, {random.unit(), random.unit()}}; }
std::uint32_t cell_of(Aim const& aim, Vec2 u) {
    auto const place = [&](float x) {
        return std::min(static_cast<std::uint32_t>(x * static_cast<float>(aim.side())), aim.side() - 1);
    };
    return place(u.x) + aim.side() * place(u.y);
}

}  // namespace

TEST_CASE("aim: rays are drawn by their density") {
    auto const all = kinds();
    double const alpha = sidak(static_cast<int>(all.size()));
    for (Kind const& kind : all) {
        CAPTURE(kind.name);
        Scene scene;
        add_casters(scene);
        kind.add(scene);
        World const world = compile(scene);
        REQUIRE(world.counts().lights == 1);
        Aim const aim(world);
        REQUIRE(aim.casts());
        bool const boundless = world.is_boundless(0);
        bool const surface = world.has_surface(0);
        auto const is_own = [&](Aim::Way const& way) { return way.ball == aim.balls().size(); };

        // Light at infinity: where the ray passes, across its direction. Others: where it goes.
        constexpr int kSide = 10;
        // Where nearly nothing goes, the sum of the densities may have found nothing.
        std::vector<double> observed(kSide * kSide), expected(kSide * kSide, 1e-3);
        BoundingSphere sphere = bounding_sphere(world.bounds());
        float const near = sphere.radius;
        if (kind.name == "portal") sphere.radius *= 3;  // it is not within the bounds
        auto const bin_of = [&](LightRay const& r) {
            Vec2 st{0, 0};
            if (boundless) {
                Vec3 const at = frame_from_z(-r.emission.ray.d).to_local(r.emission.ray.o - sphere.centre);
                st = {0.5f + 0.5f * at.x / sphere.radius, 0.5f + 0.5f * at.y / sphere.radius};
            } else {
                // Where it would meet the plane of the casters, from 3 above; what does not go down has a place beside it.
                Vec3 const d = r.emission.ray.d;
                if (d.z < -0.3f) st = {0.5f - 0.4f * d.x / d.z, 0.5f - 0.4f * d.y / d.z};
            }
            auto const cell = [](float x) {
                return static_cast<std::size_t>(std::clamp(static_cast<int>(x * kSide), 0, kSide - 1));
            };
            return cell(st.x) + kSide * cell(st.y);
        };
        int const n = samples(10000, 100000);
        Random random(5);
        bool finite = true;
        bool same = true;
        for (int i = 0; i < n; ++i) {
            Aim::Way const way = aim.choose(random.uniform());
            Draw const u = draw(random);
            auto const r = aim.sample(world, way, u.position, u.direction, Wavelengths::rgb());
            if (!r || r->power().is_black()) continue;
            finite = finite && r->power().is_finite();
            float const p = aim.density(world, *r, way.cell);
            float const has = boundless ? r->emission.pdf_position : r->emission.pdf_direction;
            same = same && std::abs(p - has) <= (is_own(way) ? 1e-4f : 2e-2f) * has;
            observed[bin_of(*r)] += 1;
        }
        CHECK(finite);
        CHECK(same);
        // The same integral by rays that are even: over directions, or over the disk.
        std::int64_t const points = 4 * static_cast<std::int64_t>(samples(400000, 8000000));
        int const per_origin = 4;
        for (std::int64_t i = 0; i < points / per_origin; ++i) {
            Draw const u = draw(random);
            auto const from = world.emit(0, nullptr, u.position, u.direction, Wavelengths::rgb());
            if (!from) continue;
            for (int j = 0; j < per_origin; ++j) {
                LightRay r = *from;
                Draw const w = draw(random);
                EmissionSample& e = r.emission;
                bool lit = true;
                double measure = 0;
                if (boundless) {
                    // Every second one through what casts, the others as the light sends them.
                    Vec2 const disk = square_to_disk(w.position) * near;
                    Vec3 const p =
                        j % 2 == 0 ? world.emit(0, nullptr, w.position, u.direction, Wavelengths::rgb())
                                         ->emission.ray.o
                                   : sphere.centre + frame_from_z(-e.ray.d).from_local({disk.x, disk.y, 0});
                    e.ray.o = p - dot(p - sphere.centre, e.ray.d) * e.ray.d - sphere.radius * e.ray.d;
                    Vec3 const across = cross(p - sphere.centre, e.ray.d);
                    double const own =
                        static_cast<double>(world.emission_density(LightId{0}, p, e.ray.d).position);
                    lit = own > 0;
                    measure = 2 / (own + (length_squared(across) <= near * near
                                              ? static_cast<double>(kInvPi / sqr(near))
                                              : 0));
                } else {
                    // Every second one downwards, where most goes.
                    constexpr float kCone = 0.4f;
                    e.ray.d = j % 2 == 0 ? square_to_uniform_sphere(w.direction)
                                         : -square_to_uniform_cone(w.direction, kCone);
                    measure =
                        1 / static_cast<double>(0.5f * kUniformSpherePdf +
                                                (e.ray.d.z < kCone - 1 ? 0.5f * uniform_cone_pdf(kCone) : 0));
                    if (surface) {
                        if (kind.name == "two-sided") e.n = face_forward(e.n, e.ray.d);
                        lit = dot(e.n, e.ray.d) > 0 && !e.radiance.is_black();
                    } else {
                        Receiver const there{e.ray.o + e.ray.d, {0, 0, 0}, true};
                        lit =
                            world.sample_light(there, {}, 0.5, {0.5f, 0.5f}, Wavelengths::rgb()).has_value();
                    }
                }
                if (!lit) continue;
                std::uint32_t const cell = surface ? cell_of(aim, u.position) : 0;
                expected[bin_of(r)] += static_cast<double>(aim.density(world, r, cell)) * measure * n /
                                       static_cast<double>(points);
            }
        }
        // Its own noise counts as well.
        auto const chi = chi_square(observed, expected, false, 200);
        CHECK_MESSAGE(chi.p > alpha, kind.name, ": ", chi, " drawn ",
                      std::accumulate(observed.begin(), observed.end(), 0.0), " of ", n, ", expected ",
                      std::accumulate(expected.begin(), expected.end(), 0.0));
    }
}

TEST_CASE("aim: caustics have the same power with and without it, whatever the light") {
    auto const all = kinds();
    double const alpha = sidak(2 * static_cast<int>(all.size()));
    auto const floor = [](Photon const& p) { return p.p().z < -0.9f; };
    auto const middle = [&](Photon const& p) {
        return floor(p) && std::abs(p.p().x - 0.3f) < 0.6f && std::abs(p.p().y) < 0.6f;
    };
    for (Kind const& kind : all) {
        CAPTURE(kind.name);
        Scene scene;
        add_casters(scene);
        add(scene, floor_quad(4, -1), diffuse(scene, 0));
        kind.add(scene);
        World const world = compile(scene);
        for (auto const& which : {Which(floor), Which(middle)}) {
            Mean const aimed =
                batches_of(world, shot_settings(samples(2000, 20000)), ShotKind::Caustic, which);
            Mean const plain = batches_of(world, shot_settings(samples(8000, 80000), ColorMode::Rgb, false),
                                          ShotKind::Caustic, which);
            double const error = std::hypot(aimed.standard_error(), plain.standard_error());
            CHECK(plain.mean() > 0);
            CHECK(error < 0.1 * kSanitizerRoom * plain.mean());
            double const p = student_p((aimed.mean() - plain.mean()) / error, 40);
            CHECK_MESSAGE(p > alpha, kind.name, ": ", aimed.mean(), " aimed, ", plain.mean(), " +- ", error,
                          ", p = ", p);
        }
    }
}

TEST_CASE("aim: a light inside of what casts, lights of many kinds, many casters") {
    auto const test = [](Scene const& scene, double alpha) {
        World const world = compile(scene);
        auto const floor = [](Photon const& p) { return p.p().z < -0.9f && length(p.p()) < 3.0f; };
        Mean const aimed = batches_of(world, shot_settings(samples(4000, 40000)), ShotKind::Caustic, floor);
        Mean const plain = batches_of(world, shot_settings(samples(10000, 100000), ColorMode::Rgb, false),
                                      ShotKind::Caustic, floor);
        double const error = std::hypot(aimed.standard_error(), plain.standard_error());
        CHECK(plain.mean() > 0);
        CHECK(error < 0.05 * kSanitizerRoom * plain.mean());
        CHECK_MESSAGE(student_p((aimed.mean() - plain.mean()) / error, 40) > alpha, aimed.mean(), " aimed, ",
                      plain.mean(), " +- ", error);
    };
    double const alpha = sidak(4);
    Scene inside;
    add_casters(inside);
    add(inside, floor_quad(4, -1), diffuse(inside, 0));
    inside.add(point_light({0.5f, 0.1f, 0}, 1));
    test(inside, alpha);
    Scene lamp = inside;
    lamp.lights.clear();
    add_sphere(lamp, {0.5f, 0, 0}, 0.1f).light = white(1);
    test(lamp, alpha);
    Scene both;
    add_casters(both);
    add(both, floor_quad(4, -1), diffuse(both, 0));
    for (std::size_t const k : {0u, 2u, 4u, 14u, 15u}) kinds()[k].add(both);
    test(both, alpha);
    Scene beads;
    add(beads, floor_quad(4, -1), diffuse(beads, 0));
    for (int i = 0; i < 200; ++i)
        add_sphere(beads,
                   {0.3f * static_cast<float>(i % 20) - 3, 0.5f * static_cast<float>(i / 20) - 2.5f, 0},
                   0.12f, glass(beads));
    beads.add(point_light({1, 0, 0.5f}, 1));
    add_sphere(beads, {-2, 0, 1}, 0.2f).light = white(1);
    test(beads, alpha);
}

TEST_CASE("aim: a small ball in a corner of a big room") {
    Scene s;
    add(s, box_mesh({-10, -10, 0}, {10, 10, 6}, true), diffuse(s, 0.7f));
    add_sphere(s, {9, 9, 0.5f}, 0.3f, glass(s));
    SUBCASE("under a point light") { s.add(point_light({0, 0, 5.5f}, 100)); }
    SUBCASE("under a lamp of some size") {
        add(s, Quad{{-1, -1, 5.9f}, {0, 2, 0}, {2, 0, 0}}).light = white(10);
    }
    SUBCASE("under a shining ceiling") {
        add(s, Quad{{-9.9f, -9.9f, 5.9f}, {0, 19.8f, 0}, {19.8f, 0, 0}}).light = white(1);
    }
    World const world = compile(s);
    int const n = 50000;
    Shot const aimed = shot_of(world, shot_settings(n), ShotKind::Caustic);
    Shot const plain = shot_of(world, shot_settings(n, ColorMode::Rgb, false), ShotKind::Caustic);
    double const more = static_cast<double>(aimed.photons.size()) /
                        static_cast<double>(std::max<std::size_t>(1, plain.photons.size()));
    double sum = 0, squares = 0;
    for (Photon const& p : aimed.photons) sum += carried(p, 1), squares += carried(p, 1) * carried(p, 1);
    double const even = sum * sum / (squares * static_cast<double>(aimed.photons.size()));
    MESSAGE("of ", n, " paths, caustic photons: ", aimed.photons.size(), " aimed, ", plain.photons.size(),
            " without: ", more, " times as many; worth ", even, " of as many that weigh the same");
    CHECK(more > 20);
    CHECK(even > 0.6);
}

TEST_CASE("aim: what casts, and the balls around it") {
    Scene s;
    MaterialId const rough = [&] {
        DielectricMaterial m;
        m.roughness.u = s.add(Texture{ConstantFloatTexture{0.3f}, {}});
        return material(s, m);
    }();
    MaterialId const sharp = [&] {
        ConductorMaterial m;
        m.reflectance = spectrum(s, ConstantSpd{0.5f});
        m.roughness.u = s.add(Texture{ConstantFloatTexture{0.05f}, {}});
        m.roughness.remap = false;
        return material(s, m);
    }();
    MaterialId const varnish = material(s, CoatedDiffuseMaterial{spectrum(s, ConstantSpd{0.5f}), {}});
    MaterialId const mixed =
        material(s, MixMaterial{diffuse(s, 0.5f), sharp, s.add(Texture{ConstantFloatTexture{0.5f}, {}})});
    s.add(point_light({0, 0, 10}, 1));
    auto const casts = [&](MaterialId m) {
        Scene own = s;
        add_sphere(own, {0, 0, 0}, 1, m);
        return Aim(compile(own)).casts();
    };
    CHECK(!casts(diffuse(s, 0.5f)));
    CHECK(!casts(rough));
    CHECK(casts(sharp));
    CHECK(casts(varnish));
    CHECK(casts(mixed));
    CHECK(casts(glass(s)));
    CHECK(casts(mirror(s, 1)));
    CHECK(!casts(MaterialId{}));
    // Nothing shines on it.
    Scene dark = s;
    dark.lights.clear();
    dark.add(spot_light({0, 0, 10}, {0, 0, 20}, 1, 20, 5));
    add_sphere(dark, {0, 0, 0}, 1, glass(dark));
    CHECK(!Aim(compile(dark)).casts());

    // Balls hold all points of all casters, stretched and placed twice.
    Scene placed;
    Group group;
    MaterialId const m = glass(placed);
    add(group, Sphere{0.5f, -0.5f, 0.5f}, m).to_group = translate(1, 0, 0) * scale(1, 3, 0.2);
    add(group, Cylinder{0.2f, 0, 2}, m).to_group = rotation(30, 1, 0, 0) * shear(0.7);
    add(group, Disk{0.5f, 1}, m).to_group = translate(0, 3, 0);
    add(group, box_mesh({2, 2, 2}, {3, 4, 2.5f}, false), m);
    add(group, Quad{}, m);
    GroupId const id = placed.add(group);
    placed.world().instances.push_back({id, rows_of(scale(2, 1, 1) * rotation(50, 1, 1, 0)), {}});
    placed.world().instances.push_back({id, rows_of(translate(20, 0, 0)), {}});
    placed.add(point_light({0, 0, 30}, 1));
    World const world = compile(placed);
    for (std::size_t const most : {std::size_t{1}, std::size_t{4}, std::size_t{32}}) {
        auto const balls = caster_balls(world.casters(), most);
        CHECK(balls.size() <= most);
        if (most == 4) CHECK(balls.size() > 1);
        Random random(3);
        RayStats stats;
        SurfaceHit hit;
        int hits = 0, outside = 0;
        for (int i = 0; i < 200000; ++i) {
            Vec3 const o =
                world.bounds().centre() + 40.0f * square_to_uniform_sphere({random.unit(), random.unit()});
            Bounds3 const& b = world.bounds();
            Vec3 const to{lerp(random.unit(), b.lo.x, b.hi.x), lerp(random.unit(), b.lo.y, b.hi.y),
                          lerp(random.unit(), b.lo.z, b.hi.z)};
            if (!world.intersect({o, normalize(to - o)}, kInfinity, RayKind::Bounce, stats, hit)) continue;
            ++hits;
            bool in = false;
            for (BoundingSphere const& ball : balls) in = in || distance(hit.s.p, ball.centre) <= ball.radius;
            outside += in ? 0 : 1;
        }
        CHECK(hits > 10000);
        CHECK(outside == 0);
    }
}
