// Portals of infinite lights: four points of the world, and what is said of others.
#include "helpers.h"

#include <variant>

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("a portal is four points of the world, whatever the transformation; without one there is none") {
    auto const scene = read_world(R"(
        Translate 1 2 3
        LightSource "infinite" "string filename" "/sky.exr" "point3 portal" [ 0 0 0  0 2 0  3 2 0  3 0 0 ]
        LightSource "infinite" "rgb L" [ 1 2 3 ])");
    auto const& l = std::get<InfiniteLight>(scene.lights.at(0).kind);
    REQUIRE(l.portal);
    CHECK((*l.portal)[0] == Vec3{0, 0, 0});
    CHECK((*l.portal)[1] == Vec3{0, 2, 0});
    CHECK((*l.portal)[2] == Vec3{3, 2, 0});
    CHECK((*l.portal)[3] == Vec3{3, 0, 0});
    CHECK_FALSE(std::get<InfiniteLight>(scene.lights.at(1).kind).portal);
    CHECK(notes(scene).empty());
}

TEST_CASE("portals that are not four points are refused where they are") {
    CHECK(error_in_world("LightSource \"infinite\"\n  \"point3 portal\" [ 0 0 0  1 0 0  1 1 0 ]") ==
          "t.pbrt:3: LightSource \"infinite\": \"portal\" has 3 points; it must have 4, the corners of a "
          "rectangle in order");
    CHECK(contains(error_in_world("LightSource \"infinite\" \"point3 portal\" [ ]"), "t.pbrt:2: "));
    CHECK(
        contains(error_in_world("LightSource \"infinite\" \"point3 portal\" [ 0 0 0  1 0 ]"), "t.pbrt:2: "));
    CHECK(
        contains(error_in_world("LightSource \"infinite\" \"float portal\" [ 0 0 0  1 0 0 ]"), "t.pbrt:2: "));
}
