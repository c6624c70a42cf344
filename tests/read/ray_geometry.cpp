// .ray files: shapes, transforms, meshes and the camera.
#include "rays.h"

#include <cmath>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Vec3 placed(Object const& o, Vec3 p) {
    auto const t = make_transform(o.to_group);
    REQUIRE(t);
    return t->point(p);
}
bool near(Vec3 a, Vec3 b, float tolerance = 1e-5f) { return length(a - b) < tolerance; }

float area(TriangleMesh const& m) {
    float sum = 0;
    for (auto const& t : m.triangles) {
        auto const at = [&](int k) { return m.p[static_cast<std::size_t>(t[k])]; };
        sum += 0.5f * length(cross(at(1) - at(0), at(2) - at(0)));
    }
    return sum;
}
/// By the divergence theorem; above 0 where the faces of a closed mesh look outwards.
float volume(TriangleMesh const& m) {
    float sum = 0;
    for (auto const& t : m.triangles) {
        auto const at = [&](int k) { return m.p[static_cast<std::size_t>(t[k])]; };
        sum += dot(at(0), cross(at(1), at(2))) / 6;
    }
    return sum;
}
bool normals_agree(TriangleMesh const& m) {
    for (auto const& t : m.triangles) {
        auto const at = [&](int k) { return m.p[static_cast<std::size_t>(t[k])]; };
        Vec3 const n = cross(at(1) - at(0), at(2) - at(0));
        for (int k = 0; k < 3; ++k)
            if (!(dot(n, m.n[static_cast<std::size_t>(t[k])]) > 0)) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("shapes have the format's sizes") {
    auto const scene =
        valid_ray("sphere {} box { name = a } square {} cylinder {} cylinder { capped = false }");
    auto const& objects = scene.world().objects;
    REQUIRE(objects.size() == 7);
    CHECK(shape_of<Sphere>(scene, 0).radius == 1);
    CHECK(shape_of<Box>(scene, 1).lo == Vec3{-0.5f});
    CHECK(shape_of<Box>(scene, 1).hi == Vec3{0.5f});
    auto const& square = shape_of<Quad>(scene, 2);
    CHECK(square.origin == Vec3{-0.5f, -0.5f, 0});
    CHECK(cross(square.edge_u, square.edge_v) == Vec3{0, 0, 1});
    for (std::size_t i : {3, 6}) {
        CHECK(shape_of<Cylinder>(scene, i).radius == 1);
        CHECK(shape_of<Cylinder>(scene, i).z_min == 0);
        CHECK(shape_of<Cylinder>(scene, i).z_max == 1);
    }
    CHECK(shape_of<Disk>(scene, 4).height == 1);
    CHECK_FALSE(objects[4].reverse_orientation);
    CHECK(shape_of<Disk>(scene, 5).height == 0);
    CHECK(objects[5].reverse_orientation);
}

TEST_CASE("cones: areas, volumes and normals") {
    auto const cone = [](std::string const& what) {
        return shape_of<TriangleMesh>(valid_ray("cone { " + what + " }"));
    };
    auto const whole = cone("");
    CHECK(volume(whole) == doctest::Approx(double{kPi} / 3).epsilon(2e-4));
    CHECK(area(whole) == doctest::Approx(double{kPi} * (1 + std::sqrt(2.0))).epsilon(2e-4));
    CHECK(normals_agree(whole));
    CHECK(area(cone("capped = false")) == doctest::Approx(double{kPi} * std::sqrt(2.0)).epsilon(2e-4));
    // The wall's normals are the cone's, exactly.
    auto const wall = cone("capped = false; height = 2; bottom_radius = 3");
    for (std::size_t i = 0; i < wall.n.size(); ++i) {
        CHECK(std::abs(length(wall.n[i]) - 1) < 1e-6f);
        CHECK(wall.n[i].z == doctest::Approx(3 / std::sqrt(13.0)));
    }
    auto const frustum = cone("height = 3; bottom_radius = 2; top_radius = 1");
    CHECK(volume(frustum) == doctest::Approx(double{kPi} * 7).epsilon(2e-4));
    CHECK(normals_agree(frustum));
    auto const below = cone("height = -3; bottom_radius = 2; top_radius = 1");
    CHECK(volume(below) == doctest::Approx(double{kPi} * 7).epsilon(2e-4));
    CHECK(normals_agree(below));
    auto const tip_down = cone("height = 2; bottom_radius = 0; top_radius = 1");
    CHECK(volume(tip_down) == doctest::Approx(double{kPi} * 2 / 3).epsilon(2e-4));
    CHECK(normals_agree(tip_down));
    // Nothing is left of it: no error.
    CHECK(valid_ray("cone { height = 0; bottom_radius = 0 }").world().objects.empty());
}

TEST_CASE("transforms nest: the innermost acts first") {
    auto const first = [](std::string const& text) { return read_ray(text).world().objects.at(0); };
    CHECK(placed(first("translate(1, 2, 3, scale(2, sphere {}))"), {1, 0, 0}) == Vec3{3, 2, 3});
    CHECK(placed(first("scale(2, translate(1, 2, 3, sphere {}));"), {1, 0, 0}) == Vec3{4, 4, 6});
    CHECK(placed(first("scale(1, 2, -3, sphere {};)"), {1, 1, 1}) == Vec3{1, 2, -3});
    // Counter-clockwise, seen from the axis' tip, in radians.
    CHECK(near(placed(first("rotate(0, 0, 2, 1.5707963268, sphere {})"), {1, 0, 0}), {0, 1, 0}));
    CHECK(placed(first("transform((1,0,0,5), (0,1,0,6), (0,1,1,7), (0,0,0,1), sphere {})"), {1, 2, 3}) ==
          Vec3{6, 8, 12});
    auto const scene =
        read_ray("translate(1, 0, 0, { sphere {} translate(0, 1, 0, { box {} }) ; square {} })");
    REQUIRE(scene.world().objects.size() == 3);
    CHECK(placed(scene.world().objects[0], {0, 0, 0}) == Vec3{1, 0, 0});
    CHECK(placed(scene.world().objects[1], {0, 0, 0}) == Vec3{1, 1, 0});
    CHECK(placed(scene.world().objects[2], {0, 0, 0}) == Vec3{1, 0, 0});
    // Flat: left out with a note, not refused.
    auto const flat = valid_ray("scale(1, 0, 1, sphere {}) sphere {}");
    CHECK(flat.world().objects.size() == 1);
}

TEST_CASE("polymeshes: fans, normals, materials of points") {
    std::string const points = "points = ((0,0,0), (1,0,0), (1,1,0), (0,1,0), (0,0,1)); ";
    auto const quad = shape_of<TriangleMesh>(valid_ray("polymesh { " + points + "faces = ((0,1,2,3)) }"));
    CHECK(quad.triangles == std::vector<Vec3i>{{0, 1, 2}, {0, 2, 3}});
    CHECK(quad.n.empty());
    auto const given =
        shape_of<TriangleMesh>(valid_ray("trimesh { faces = ((0,1,2)); points = ((0,0,0),(1,0,0),(0,1,0)); "
                                         "normals = ((0,0,1),(1,0,0),(0,1,0)); gennormals }"));
    CHECK(given.n == std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}});
    // Two faces at a right angle: the mean of both on their edge. Points without a face still have a normal.
    for (char const* how : {"gennormals;", "gennormals = true;"}) {
        auto const smooth =
            shape_of<TriangleMesh>(valid_ray("polymesh { " + points + how + " faces = ((0,1,3), (0,4,1)) }"));
        CHECK(near(smooth.n[0], normalize(Vec3{0, 1, 1})));
        CHECK(near(smooth.n[3], {0, 0, 1}));
        CHECK(near(smooth.n[4], {0, 1, 0}));
        CHECK(near(smooth.n[2], {0, 0, 1}));
    }
    CHECK(
        shape_of<TriangleMesh>(valid_ray("polymesh { " + points + "gennormals = false; faces = ((0,1,2)) }"))
            .n.empty());
    auto const many =
        valid_ray("polymesh { " + points +
                  "faces = ((0,1,2), (3,4,0), (0,2,3)); materials = ({ diffuse = (1,0,0) }, {}, {}, "
                  "{ diffuse = (0,1,0) }, {}) }");
    REQUIRE(many.world().objects.size() == 2);
    CHECK(shape_of<TriangleMesh>(many, 0).triangles.size() == 2);
    CHECK(shape_of<TriangleMesh>(many, 1).triangles.size() == 1);
    CHECK(shape_of<TriangleMesh>(many, 1).p == std::vector<Vec3>{{0, 1, 0}, {0, 0, 1}, {0, 0, 0}});
    CHECK(contains(notes(many), "t.ray:2: materials of points are not blended over a face"));
}

namespace {

/// Where the camera looks from, along, and what is to its right and above.
std::array<Vec3, 4> view(Scene const& scene) {
    auto const t = make_transform(scene.camera.to_world);
    REQUIRE(t);
    return {t->point({0, 0, 0}), t->vector({0, 0, 1}), t->vector({1, 0, 0}), t->vector({0, 1, 0})};
}
float degrees_of(Scene const& scene) { return as<PerspectiveCamera>(scene.camera.kind).fov * 180 / kPi; }

}  // namespace

TEST_CASE("cameras") {
    auto const standard = read_ray("");
    CHECK(view(standard) == std::array<Vec3, 4>{{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}}});
    CHECK(degrees_of(standard) == doctest::Approx(53.1301));
    CHECK(standard.settings.film.resolution == Vec2i{512, 512});
    CHECK(standard.settings.color == ColorMode::Rgb);
    CHECK(standard.settings.color_given);

    auto const placed = valid_ray(
        "camera { position = (1,2,3); viewdir = (-2,0,0); updir = (0,0.5,0); fov = 40; aspectratio = 2 }");
    auto const [eye, along, right, up] = view(placed);
    CHECK(near(eye, {1, 2, 3}));
    CHECK(near(along, {-1, 0, 0}));
    CHECK(near(right, {0, 0, -1}));
    CHECK(near(up, {0, 1, 0}));
    CHECK(placed.settings.film.resolution == Vec2i{512, 256});
    CHECK(degrees_of(placed) == doctest::Approx(40));
    // The angle is the height's; where the picture is upright the width is the shorter side.
    auto const upright = valid_ray("camera { fov = 90; aspectratio = 0.5 }");
    CHECK(upright.settings.film.resolution == Vec2i{512, 1024});
    CHECK(degrees_of(upright) == doctest::Approx(2 * std::atan(0.5) * 180 / double{kPi}));

    auto const target = view(read_ray("camera { look_at = (0,0,7); position = (0,0,2) }"));
    CHECK(near(target[1], {0, 0, 1}));
    // A quarter turn to the left about y: from -z to -x.
    for (char const* spelling : {"quaternian", "quaternion"}) {
        auto const turned = view(read_ray(std::string("camera { ") + spelling + " = (0, 2, 0, 2) }"));
        CHECK(near(turned[1], {-1, 0, 0}));
        CHECK(near(turned[2], {0, 0, -1}));
        CHECK(near(turned[3], {0, 1, 0}));
    }
    // About x: up.
    auto const raised = view(read_ray("camera { quaternian = (1, 0, 0, 1) }"));
    CHECK(near(raised[1], {0, 1, 0}));
    CHECK(near(raised[3], {0, 0, 1}));
}
