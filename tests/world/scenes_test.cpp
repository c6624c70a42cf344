// What compile() makes of scenes: every shape, nested groups, invisible interfaces, things without area, nothing at all.
#include "scenes.h"

#include "film/film.h"
#include "transport/render_pass.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include <unistd.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

bool same_bits(Vec3 a, Vec3 b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// The sums of some passes, seen from z = 6 down the z axis.
Film picture(Scene scene, std::uint64_t passes = 4) {
    scene.camera.kind = PerspectiveCamera{.fov = 0.8f};
    scene.camera.to_world = *inverse(*look_at({1, 2, 6}, {0, 0, 0}, {0, 1, 0}));
    scene.settings.film.resolution = {24, 24};
    World const world = compile(std::move(scene));
    RenderJob const job(world, world.scene().settings);
    Film film = job.make_film();
    RayStats stats;
    for (std::uint64_t i = 0; i < passes; ++i) render_pass(job, i, film, stats);
    CHECK(stats.rejected == 0);
    CHECK(film.dropped() == 0);
    return film;
}
bool same_picture(Film const& a, Film const& b) {
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            if (std::memcmp(&a.pixel(x, y), &b.pixel(x, y), sizeof(PixelSums)) != 0) return false;
    return true;
}
double brightness(Film const& f) {
    double sum = 0;
    for (int y = 0; y < f.height(); ++y)
        for (int x = 0; x < f.width(); ++x) sum += f.pixel(x, y).rgb[1];
    return sum;
}

Scene lit_floor() {
    Scene s;
    s.files = {"floor.pbrt"};
    MaterialId const grey = diffuse(s);
    s.world().objects.push_back(object(square(3, -1), grey));
    s.world().objects.push_back(object(moved(icosphere(1, 0.5f), {0.3f, 0.1f, 0}), grey));
    Object lamp = object(square(0.5f, 0), grey, translate(0, 0, 3) * scale(1, 1, -1));
    lamp.light = emission(5);
    s.world().objects.push_back(lamp);
    s.add(Light{PointLight{.scale = 3, .from = {2, 2, 2}}, Mat4{}, {}});
    return s;
}

bool has_note(Scene const& s, std::string const& text) {
    return std::any_of(s.notes.begin(), s.notes.end(),
                       [&](Note const& n) { return n.text.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("every shape is where it should be") {
    Scene s;
    s.files = {"shapes.pbrt"};
    TriangleMesh const octahedron{
        .p = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        .triangles = {
            {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    std::vector<Shape> const shapes{
        square(1, 0),
        BilinearMesh{.p = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}, .patches = {{0, 1, 2, 3}}},
        LoopSubdivision{octahedron.p, octahedron.triangles, 2},
        Sphere{},
        Cylinder{},
        Disk{},
        Box{},
        Quad{}};
    std::vector<MaterialId> materials;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        materials.push_back(diffuse(s));
        s.world().objects.push_back(
            object(shapes[i], materials.back(), translate(10.0 * static_cast<double>(i), 0, 0)));
    }
    World const world = compile(std::move(s));
    CHECK(world.counts().objects == shapes.size());
    CHECK(world.counts().analytic == 6);
    CHECK(world.counts().triangles == 2 + 8 * 16);
    CHECK(world.counts().lights == 0);
    RayStats stats;
    // A ray down z, a little beside the axis.
    std::vector<float> const z{0, 0, 0.2f, std::sqrt(1 - 0.05f), 0, 0, 1, 0};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        CAPTURE(i);
        float const x = 10.0f * static_cast<float>(i) + 0.1f;
        SurfaceHit hit;
        bool const found =
            world.intersect({{x, 0.2f, 5}, {0, 0, -1}}, kInfinity, RayKind::Camera, stats, hit);
        bool const is_cylinder = std::holds_alternative<Cylinder>(shapes[i]);
        CHECK(found == !is_cylinder);
        if (!found) continue;
        CHECK(hit.material == materials[i]);
        CHECK(std::abs(hit.s.p.x - x) < 1e-5f);
        CHECK(hit.s.ng.z > 0.3f);
        CHECK(std::abs(hit.t - (5 - hit.s.p.z)) < 1e-5f);
        if (!std::holds_alternative<LoopSubdivision>(shapes[i])) CHECK(hit.s.p.z == doctest::Approx(z[i]));
        CHECK_FALSE(hit.emits);
        CHECK(hit.instance == kNoInstance);
    }
    SurfaceHit hit;
    CHECK(world.intersect({{40, 0.2f, 0}, {1, 0, 0}}, kInfinity, RayKind::Camera, stats,
                          hit));  // the cylinder's wall, from inside
    CHECK(hit.material == materials[4]);
    CHECK(stats.rays[0] == shapes.size() + 1);
    CHECK(stats.hits == shapes.size());
    CHECK(stats.rejected == 0);
}

TEST_CASE("three levels of instances are the same as the scene written out by hand") {
    Mat4 const a = translate(3, 0, 1) * *rotate(20, 0, 1, 0) * scale(1, 0.8, 1.2);
    Mat4 const b = translate(-2, 1, 0) * *rotate(50, 1, 1, 0);
    Mat4 const c = scale(1, -1, 1) * translate(0, 5, 0);
    std::vector<Mat4> const inner{a, b}, middle{translate(0, 0, 8), c},
        outer{*rotate(90, 0, 0, 1), translate(20, 0, 0) * scale(2, 2, 2)};
    auto const parts = [](Scene& s) {
        return std::vector<Object>{object(icosphere(1, 1), diffuse(s)),
                                   object(Sphere{0.6f, -0.6f, 0.6f}, diffuse(s), translate(1.5, 0, 0)),
                                   object(Box{}, diffuse(s), translate(0, 0, -2) * *rotate(30, 1, 0, 0))};
    };
    auto const instance = [](GroupId g, Mat4 const& m) {
        return Instance{.group = g, .to_parent = rows_of(m)};
    };

    Scene nested;
    Scene flat;
    Scene baked;
    nested.files = flat.files = baked.files = {"nested.pbrt"};
    GroupId const g1 = nested.add(Group{.name = "1"});
    GroupId const g2 = nested.add(Group{.name = "2"});
    GroupId const g3 = nested.add(Group{.name = "3"});
    nested.groups[g1.value].objects = parts(nested);
    for (Mat4 const& m : inner) nested.groups[g2.value].instances.push_back(instance(g1, m));
    for (Mat4 const& m : middle) nested.groups[g3.value].instances.push_back(instance(g2, m));
    for (Mat4 const& m : outer) nested.world().instances.push_back(instance(g3, m));

    GroupId const f1 = flat.add(Group{.name = "1"});
    flat.groups[f1.value].objects = parts(flat);
    std::vector<Object> const by_hand = parts(baked);
    for (Mat4 const& o : outer)
        for (Mat4 const& m : middle)
            for (Mat4 const& i : inner) {
                Mat4 const all = matrix_of(rows_of(o)) * matrix_of(rows_of(m)) * matrix_of(rows_of(i));
                flat.world().instances.push_back(instance(f1, all));
                for (Object x : by_hand) {
                    x.to_group = all * x.to_group;
                    baked.world().objects.push_back(x);
                }
            }
    World const n = compile(std::move(nested));
    World const f = compile(std::move(flat));
    World const h = compile(std::move(baked));
    CHECK(n.counts().instances == 8);
    CHECK(n.counts().objects == 3);
    CHECK(h.counts().instances == 0);
    Rays random(3);
    RayStats stats;
    int hits = 0;
    int differing = 0;
    int far_off = 0;
    for (int i = 0; i < 100'000; ++i) {
        Vec3 const o = n.bounds().centre() + length(n.bounds().diagonal()) * random.direction();
        Vec3 const to =
            n.bounds().lo + Vec3{random.unit(), random.unit(), random.unit()} * n.bounds().diagonal();
        Ray const ray{o, normalize(to - o)};
        SurfaceHit x;
        SurfaceHit y;
        SurfaceHit z;
        bool const in_n = n.intersect(ray, kInfinity, RayKind::Camera, stats, x);
        bool const in_f = f.intersect(ray, kInfinity, RayKind::Camera, stats, y);
        bool const in_h = h.intersect(ray, kInfinity, RayKind::Camera, stats, z);
        if (in_n != in_f || (in_n && (x.t != y.t || !same_bits(x.s.p, y.s.p) || !same_bits(x.s.ng, y.s.ng) ||
                                      x.material != y.material || x.instance != y.instance)))
            ++differing;
        // The third has other roundings: at silhouettes it may see something else.
        if (in_n != in_h || (in_n && (std::abs(x.t - z.t) > 1e-4f || length(x.s.p - z.s.p) > 1e-4f ||
                                      dot(x.s.ng, z.s.ng) < 0.999f || x.material != z.material)))
            ++far_off;
        hits += in_n;
    }
    CHECK(hits > 10'000);
    CHECK(differing == 0);
    CHECK(far_off < 20);
}

TEST_CASE("an instance costs its record and Embree's, and nothing of the group") {
    auto const resident = [] {
        std::ifstream statm("/proc/self/statm");
        std::size_t total = 0;
        std::size_t pages = 0;
        statm >> total >> pages;
        return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    };
    auto const scene_of = [](int side) {
        Scene s;
        s.files = {"many.pbrt"};
        GroupId const g = s.add(Group{.name = "g"});
        s.groups[g.value].objects.push_back(object(icosphere(4, 0.4f), diffuse(s)));
        s.groups[g.value].objects.push_back(
            object(Sphere{0.1f, -0.1f, 0.1f}, diffuse(s), translate(0.5, 0, 0)));
        for (int x = 0; x < side; ++x)
            for (int y = 0; y < side; ++y)
                s.world().instances.push_back(
                    {.group = g, .to_parent = rows_of(translate(x, y, 0) * *rotate(x + y, 0, 0, 1))});
        return s;
    };
    WorldMemory const one = compile(scene_of(1)).memory();
    int const side = 316;
    auto const n = static_cast<double>(side * side);
    Scene scene = scene_of(side);
    std::size_t const before = resident();
    World const world = compile(std::move(scene));
    std::size_t const after = resident();
    WorldMemory const many = world.memory();
    CHECK(world.counts().instances == static_cast<std::uint64_t>(side) * side);
    double const ours = static_cast<double>(many.instances - one.instances) / (n - 1);
    double const embree = static_cast<double>(many.bvh - one.bvh) / (n - 1);
    MESSAGE("bytes an instance: ", ours, " ours, ", embree, " Embree's, ", sizeof(Instance),
            " in the scene's description; the process grew by ", static_cast<double>(after - before) / n);
    CHECK(ours <= 64);
    CHECK(embree < 1024);
    CHECK(many.meshes == one.meshes);
    CHECK(static_cast<double>(after - before) / n < 1536);
}

TEST_CASE("memory is accounted for") {
    auto const ball = [](int levels) { return compile(alone(icosphere(levels, 1))); };
    World const small = ball(3);
    World const large = ball(5);
    CHECK(small.memory().meshes == 642 * sizeof(Vec3) + 1280 * sizeof(Vec3i));
    CHECK(large.memory().meshes == 10242 * sizeof(Vec3) + 20480 * sizeof(Vec3i));
    CHECK(large.memory().bvh > 20480 * 20);
    CHECK(large.memory().bvh < 20480 * 300);
    WorldMemory const m = large.memory();
    CHECK(m.total() == m.meshes + m.bvh + m.images + m.spectra + m.lights + m.instances);
    CHECK(compile(lit_floor()).memory().lights > small.memory().lights);
}

TEST_CASE("interfaces are not in the way of light, and only there at all when they emit") {
    for (bool const instanced : {false, true}) {
        for (bool const emits : {false, true}) {
            CAPTURE(instanced);
            CAPTURE(emits);
            Scene s;
            s.files = {"interface.pbrt"};
            MaterialId const nothing = s.add(Material{InterfaceMaterial{}, "", {}});
            Object ball = object(Sphere{}, nothing);
            if (emits) ball.light = emission(1);
            Object mesh = object(moved(cube(0.5f), {0, 5, 0}), nothing);
            if (emits) mesh.light = emission(1);
            if (instanced) {
                GroupId const g = s.add(Group{.name = "g"});
                s.groups[g.value].objects = {ball, mesh};
                s.world().instances.push_back({.group = g});
            } else {
                s.world().objects = {ball, mesh};
            }
            s.world().objects.push_back(object(square(9, -3), diffuse(s)));
            World const world = compile(std::move(s));
            RayStats stats;
            for (float const y : {0.2f, 5.2f}) {
                SurfaceHit hit;
                REQUIRE(world.intersect({{0.1f, y, 4}, {0, 0, -1}}, kInfinity, RayKind::Camera, stats, hit));
                CHECK(hit.emits == emits);
                CHECK((hit.s.p.z > 0) == emits);
                SurfaceHit floor;
                REQUIRE(
                    world.intersect({{0.1f, y, -2}, {0, 0, -1}}, kInfinity, RayKind::Camera, stats, floor));
                LightSample above;
                above.p = {0.1f, y, 4};
                above.wi = {0, 0, 1};
                CHECK(world.transmittance(floor, above, stats) == 1.0f);
                above.at_infinity = true;
                CHECK(world.transmittance(floor, above, stats) == 1.0f);
            }
        }
    }
}

TEST_CASE("things without area are skipped with a note, and the picture is the one without them") {
    Film const without = picture(lit_floor());
    CHECK(brightness(without) > 0);

    SUBCASE("degenerate triangles in a mesh that is seen") {
        Scene s = lit_floor();
        auto& m = std::get<TriangleMesh>(s.world().objects[1].shape);
        m.p.push_back({0, 0, 0.2f});
        m.triangles.insert(m.triangles.begin(), {0, 0, 1});
        m.triangles.insert(m.triangles.begin() + 5, {7, 7, 7});
        m.triangles.push_back({static_cast<int>(m.p.size()) - 1, 3, 3});
        CHECK(has_note(compile(s).scene(), "no area"));
        CHECK(same_picture(picture(s), without));
    }
    SUBCASE("degenerate triangles in a lamp") {
        Scene s = lit_floor();
        auto& m = std::get<TriangleMesh>(s.world().objects[2].shape);
        m.triangles.insert(m.triangles.begin(), {0, 0, 1});
        m.triangles.push_back({2, 2, 2});
        CHECK(has_note(compile(s).scene(), "no area"));
        CHECK(same_picture(picture(s), without));
    }
    SUBCASE("a lamp of nothing but degenerate triangles") {
        Scene s = lit_floor();
        Object lamp =
            object(TriangleMesh{.p = {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}, .triangles = {{0, 1, 2}, {1, 1, 0}}},
                   diffuse(s));
        lamp.light = emission(100);
        s.world().objects.push_back(lamp);
        CHECK(has_note(compile(s).scene(), "no area"));
        CHECK(same_picture(picture(s), without));
    }
    SUBCASE("shapes of no size") {
        Scene s = lit_floor();
        for (Shape const& shape :
             {Shape{Sphere{.radius = 0}}, Shape{Disk{.radius = 0}}, Shape{Cylinder{.z_min = 1, .z_max = 1}},
              Shape{Box{.lo = {0, 0, 0}, .hi = {1, 0, 0}}}, Shape{Quad{.edge_v = {4, 0, 0}}},
              Shape{TriangleMesh{}}}) {
            Object lamp = object(shape, diffuse(s));
            lamp.light = emission(100);
            s.world().objects.push_back(lamp);
        }
        s.world().objects.push_back(object(Sphere{}, diffuse(s), scale(1, 0, 1)));
        CHECK(compile(s).scene().notes.size() >= 7);
        CHECK(same_picture(picture(s), without));
    }
}

TEST_CASE("duplicate and coplanar surfaces are rendered, the same each time") {
    Scene s = lit_floor();
    s.world().objects.push_back(s.world().objects[0]);
    s.world().objects.push_back(s.world().objects[1]);
    s.world().objects.push_back(s.world().objects[2]);
    s.world().objects.push_back(object(Quad{{-3, -3, -1}, {6, 0, 0}, {0, 6, 0}}, diffuse(s)));
    Film const a = picture(s);
    CHECK(brightness(a) > 0);
    CHECK(same_picture(a, picture(s)));
}

TEST_CASE("an empty scene, and one without lights, are black") {
    Scene empty;
    empty.files = {"empty.pbrt"};
    World const world = compile(empty);
    RayStats stats;
    SurfaceHit hit;
    CHECK_FALSE(world.intersect({{0, 0, 0}, {0, 0, 1}}, kInfinity, RayKind::Camera, stats, hit));
    CHECK(world.bounds().empty());
    CHECK(world.counts().objects == 0);
    CHECK_FALSE(world.sample_light({}, {}, 0.5f, {0.5f, 0.5f}, Wavelengths::rgb()).has_value());
    CHECK(world.environment({}, {0, 0, 1}, Wavelengths::rgb()).is_black());
    CHECK(brightness(picture(empty)) == 0);

    Scene dark = lit_floor();
    dark.lights.clear();
    dark.world().objects[2].light.reset();
    CHECK(compile(dark).counts().lights == 0);
    CHECK(brightness(picture(dark)) == 0);

    Scene unlit = lit_floor();
    unlit.world().objects.clear();
    CHECK(brightness(picture(unlit)) == 0);
}
