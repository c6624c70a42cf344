// All ways of choosing lights and of drawing points on them find the same light; and the one that is wrong is wrong as it should be.
#include "emitters.h"
#include "measure.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

DirectIntegrator direct(LightSampling how, DirectStrategy strategy = DirectStrategy::Light) {
    DirectIntegrator d{1};
    d.lights = how;
    d.strategy = strategy;
    return d;
}
/// A white floor, looked down on at p.
Scene bench(Vec3 p) {
    Scene s;
    add(s, floor_quad(50), diffuse(s, 1));
    look_parallel(s, p + Vec3{0, 0, 0.01f}, {0, 0, -1}, 1e-3f);
    return s;
}
/// A box light over the floor, and what its faces send to p: irradiance and area of each one that is seen.
Box const kBox{{-0.5f, -0.3f, 0.4f}, {0.4f, 0.5f, 1.1f}};
struct FaceLight {
    double irradiance, area;
};
std::vector<FaceLight> faces_seen(D3 p) {
    std::vector<FaceLight> seen;
    for (int axis = 0; axis < 3; ++axis)
        for (bool high : {false, true}) {
            Vec3 const size = kBox.hi - kBox.lo;
            int const a = (axis + (high ? 1 : 2)) % 3;
            int const b = (axis + (high ? 2 : 1)) % 3;
            Quad face{high ? kBox.hi : kBox.lo, {0, 0, 0}, {0, 0, 0}};
            face.edge_u[a] = high ? -size[a] : size[a];
            face.edge_v[b] = high ? -size[b] : size[b];
            double const e = polygon_irradiance(p, quad_corners(face, {}));
            if (e > 0) seen.push_back({e, static_cast<double>(size[a]) * static_cast<double>(size[b])});
        }
    return seen;
}

constexpr LightChoice kChoices[] = {LightChoice::Bvh, LightChoice::Power, LightChoice::Uniform};
constexpr ShapeSampling kShapes[] = {ShapeSampling::SolidAngle, ShapeSampling::Area,
                                     ShapeSampling::VisibleArea, ShapeSampling::Projected};

}  // namespace

TEST_CASE("light strategies: every shape by every way is Lambert's irradiance") {
    for (auto const& e : emitting_shapes()) {
        CAPTURE(e.name);
        Placement const where = placements()[static_cast<std::size_t>(e.name.size()) % placements().size()];
        CAPTURE(where.name);
        for (D3 const p : {D3{0.3, 0.2, 0}, D3{-3, 1, 0}}) {
            double const expected = e.irradiance(turned(e, where.all()), p) / kPiD;
            if (expected < 1e-5) continue;
            Scene scene = bench({static_cast<float>(p[0]), static_cast<float>(p[1]), 0});
            place(scene, e, where, 1, white(1));
            World const world = compile(scene);
            for (LightChoice const choice : kChoices)
                for (ShapeSampling const shapes : {ShapeSampling::SolidAngle, ShapeSampling::Area}) {
                    CAPTURE(static_cast<int>(choice));
                    CAPTURE(static_cast<int>(shapes));
                    Settings const s = settings(direct({choice, shapes}));
                    check_mean(world, s, 64, expected);
                }
        }
    }
}

TEST_CASE("light strategies: a box by all of its samplers, and the one that is biased") {
    for (Vec3 const at : {Vec3{0, 0, 0}, Vec3{1.5f, 0.3f, 0}, Vec3{2, 2, 0}}) {
        Scene scene = bench(at);
        add(scene, kBox).light = white(1);
        World const world = compile(scene);
        double sum = 0;
        double area = 0;
        double wrong = 0;
        auto const seen = faces_seen({at.x, at.y, 0});
        for (FaceLight const& f : seen) sum += f.irradiance, area += f.area;
        for (FaceLight const& f : seen)
            wrong += f.irradiance * area / (f.area * static_cast<double>(seen.size()));
        CAPTURE(seen.size());
        for (ShapeSampling const shapes : kShapes) {
            CAPTURE(static_cast<int>(shapes));
            for (DirectStrategy const strategy :
                 {DirectStrategy::Light, DirectStrategy::Mis, DirectStrategy::Bsdf})
                check_mean(world, settings(direct({LightChoice::Bvh, shapes}, strategy)), 64, sum / kPiD);
        }
        // A face that is small is drawn too often for what its density claims.
        check_mean(world, settings(direct({LightChoice::Bvh, ShapeSampling::VisibleUnweighed})), 64,
                   wrong / kPiD);
        if (seen.size() > 1) CHECK(std::abs(wrong / sum - 1) > 0.02);
    }
}

TEST_CASE("light strategies: several lights, at infinity and near, by every choice") {
    Scene scene = bench({0, 0, 0});
    add(scene, Sphere{}).light = white(2);
    scene.world().objects.back().to_group = translate(0, 0, 3);
    add(scene, Quad{{2, -0.5f, 0.5f}, {0, 1, 0}, {0, 0, 1}}).light = white(3);
    scene.world().objects.back().reverse_orientation = true;
    scene.add(point_light({-1, 1, 1}, 0.5f));
    scene.add(sky(0.1f));
    DistantLight sun;
    sun.from = {0, 0, 1};
    sun.to = {0, 1, 0};
    scene.add(Light{sun, {}, {}});
    // Nothing of it reaches the floor.
    SpotLight away;
    away.from = {0, 0, 2};
    away.to = {0, 0, 3};
    scene.add(Light{away, {}, {}});
    World const world = compile(scene);
    std::vector<Variant> variants;
    for (LightChoice const choice : kChoices)
        for (DirectStrategy const strategy : {DirectStrategy::Light, DirectStrategy::Mis})
            variants.push_back({std::to_string(static_cast<int>(choice)), &world,
                                settings(direct({choice, ShapeSampling::SolidAngle}, strategy)), 256});
    check_same(variants);
}

TEST_CASE("light strategies: a light inside another, and a receiver on a light") {
    // A glowing floor under a glowing ball that holds a smaller one; the smaller one is seen by nobody.
    Scene scene;
    add(scene, floor_quad(50), diffuse(scene, 0.5f)).light = white(1);
    add(scene, Sphere{}).light = white(1);
    scene.world().objects.back().to_group = translate(0, 0, 2);
    add(scene, Sphere{0.5f, -0.5f, 0.5f}).light = white(100);
    scene.world().objects.back().to_group = translate(0, 0, 2);
    look_at_point(scene, {0.1f, 0, 0.2f}, {0, 0, 0});
    World const world = compile(scene);
    // E = pi (R/d)^2 below the ball; the floor shines itself and sends nothing to itself.
    for (LightChoice const choice : kChoices)
        for (DirectStrategy const strategy : {DirectStrategy::Light, DirectStrategy::Mis})
            check_mean(world, settings(direct({choice, ShapeSampling::SolidAngle}, strategy)), 64,
                       1 + 0.5 * 0.25);
}

TEST_CASE("light strategies: ten million watts, and no area at all") {
    Scene scene = bench({0, 0, 0});
    AreaLight strong = white(1);
    strong.power = 1e7f;  // lm
    add(scene, Quad{{-0.5f, 0.5f, 1}, {1, 0, 0}, {0, -1, 0}}).light = strong;
    add(scene, rectangle({0, 0, 2}, {1, 0, 2}, {2, 0, 2}, {3, 0, 2})).light = white(1e7f);
    World const world = compile(scene);
    CHECK(world.scene().notes.size() > 0);  // the flat one was left out
    double const radiance = 1e7 / kPiD;
    double const e = polygon_irradiance({0, 0, 0}, {{-.5, .5, 1}, {.5, .5, 1}, {.5, -.5, 1}, {-.5, -.5, 1}});
    check_mean(world, settings(direct({})), 64, radiance * std::abs(e) / kPiD);
}

TEST_CASE("light strategies: an instance that moves its emitter back from afar does not shade it") {
    // The product of both maps is a small move; a ray's trip through them is not.
    for (Shape const& shape : {Shape{Sphere{}}, Shape{Box{{-1, -1, -1}, {1, 1, 1}}}, Shape{Disk{}}}) {
        Scene scene = bench({0, 0, 0});
        GroupId const group = scene.add(Group{});
        Object& o = add(scene.groups[group.value], shape);
        o.to_group = translate(3000, 0, 0) * rotation(180, 1, 0, 0);
        o.light = white(1);
        scene.world().instances.push_back({group, rows_of(translate(-3000, 0, 10)), {}});
        World const world = compile(scene);
        double const expected =
            std::holds_alternative<Sphere>(shape) ? kPiD / 100
            : std::holds_alternative<Disk>(shape)
                ? kPiD / 101
                : std::abs(polygon_irradiance({0, 0, 0}, {{-1, -1, 9}, {1, -1, 9}, {1, 1, 9}, {-1, 1, 9}}));
        for (ShapeSampling const shapes : {ShapeSampling::SolidAngle, ShapeSampling::Area})
            check_mean(world, settings(direct({LightChoice::Bvh, shapes})), 64, expected / kPiD);
    }
}

TEST_CASE("light strategies: a small trapezoid far from the origin is no parallelogram") {
    // At 1000 a float's last bit is as large as a hundredth of this lamp's side.
    Vec3 const at{1000, 500, 0};
    Scene scene = bench(at);
    scene.world().objects[0].to_group = translate(1000, 500, 0);
    Vec3 const p[4] = {at + Vec3{-0.02f, -0.01f, 0.05f}, at + Vec3{-0.005f, 0.01f, 0.05f},
                       at + Vec3{0.005f, 0.01f, 0.05f}, at + Vec3{0.02f, -0.01f, 0.05f}};
    add(scene, rectangle(p[0], p[1], p[2], p[3])).light = white(1, true);
    World const world = compile(scene);
    CHECK(world.counts().lights == 2);
    double const e = std::abs(
        polygon_irradiance(doubles(at), {doubles(p[0]), doubles(p[1]), doubles(p[2]), doubles(p[3])}));
    check_mean(world, settings(direct({})), 64, e / kPiD);
}

TEST_CASE("light strategies: the sky through a portal and through holes beyond it") {
    Scene scene = bench({0, 0, 0});
    InfiniteLight through;
    // Four corners; the light comes from above: (p3 - p0) x (p1 - p0) is +z.
    through.portal = std::array<Vec3, 4>{Vec3{-1, -1, 1}, Vec3{-1, 1, 1}, Vec3{1, 1, 1}, Vec3{1, -1, 1}};
    scene.add(Light{through, {}, {}});
    MixMaterial half;
    half.a = material(scene, InterfaceMaterial{});
    half.b = diffuse(scene, 0.0f);
    half.amount = scene.add(Texture{ConstantFloatTexture{0.5f}, {}});
    add(scene, floor_quad(40, 2), material(scene, half));
    World const world = compile(scene);
    double const e =
        std::abs(polygon_irradiance({0, 0, 0}, {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}));
    for (DirectStrategy const strategy : {DirectStrategy::Light, DirectStrategy::Bsdf, DirectStrategy::Mis})
        check_mean(world, settings(direct({}, strategy)), 64, 0.5 * e / kPiD);
}
