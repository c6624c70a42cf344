// LightSource "sunsky": what it reads, what it clamps with a note, and what it refuses.
#include "helpers.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("sunsky: its parameters, as angles or as a direction") {
    auto const scene = read_world(R"(
        LightSource "sunsky"
        LightSource "sunsky" "float turbidity" 4 "float elevation" 30 "float azimuth" 90 "float scale" 2 "bool sky" false
        LightSource "sunsky" "vector3 sundirection" [0 -3 4] "float sunsize" 1 "bool sun" false
        LightSource "sunsky" "float elevation" 90)");
    REQUIRE(scene.lights.size() == 4);
    auto const& plain = as<SunSkyLight>(scene.lights[0].kind);
    CHECK(plain.turbidity == 3);
    CHECK(plain.scale == 1);
    CHECK((plain.sun && plain.sky));
    CHECK(length(plain.sun_direction - Vec3{0.70710678f, 0, 0.70710678f}) < 1e-6f);
    CHECK(degrees(plain.sun_radius) == doctest::Approx(0.2665));
    auto const& angles = as<SunSkyLight>(scene.lights[1].kind);
    CHECK(angles.turbidity == 4);
    CHECK(length(angles.sun_direction - Vec3{0, 0.8660254f, 0.5f}) < 1e-6f);
    CHECK(angles.scale == 2);
    CHECK((angles.sun && !angles.sky));
    auto const& vector = as<SunSkyLight>(scene.lights[2].kind);
    CHECK(vector.sun_direction == Vec3{0, -3, 4});
    CHECK(degrees(vector.sun_radius) == doctest::Approx(1));
    CHECK((!vector.sun && vector.sky));
    CHECK(as<SunSkyLight>(scene.lights[3].kind).sun_direction == Vec3{0, 0, 1});
    CHECK(scene.notes.empty());
}

TEST_CASE(
    "sunsky: beyond the model's range it is clamped with a note, and nonsense is refused with its line") {
    auto const hazy = read_world("LightSource \"sunsky\" \"float turbidity\" 20");
    CHECK(as<SunSkyLight>(hazy.lights[0].kind).turbidity == 10);
    CHECK(contains(notes(hazy), "it was clamped to 10"));
    auto const pure = read_world("LightSource \"sunsky\" \"float turbidity\" 1");
    CHECK(as<SunSkyLight>(pure.lights[0].kind).turbidity == 1.7f);
    CHECK(contains(notes(pure), "it was clamped to 1.7"));
    auto const set = read_world("LightSource \"sunsky\" \"float elevation\" -5");
    CHECK(as<SunSkyLight>(set.lights[0].kind).sun_direction.z == 0);
    CHECK(contains(notes(set), "raised to the horizon"));

    for (auto const& [text, says] : std::initializer_list<std::pair<std::string, std::string>>{
             {"\"float turbidity\" 0.5", "below 1"},
             {"\"float elevation\" 91", "from -90 to 90"},
             {"\"float elevation\" -90", "nadir"},
             {"\"vector3 sundirection\" [0 0 -1]", "nadir"},
             {"\"vector3 sundirection\" [0 0 0]", "no direction"},
             {"\"vector3 sundirection\" [0 1 1] \"float azimuth\" 3", "not both"},
             {"\"vector3 sundirection\" [0 1]", "sundirection"},
             {"\"float sunsize\" 0", "sun's angle"},
             {"\"float sunsize\" 50", "sun's angle"},
             {"\"float scale\" -1", "scale"},
             {"\"bool sun\" false \"bool sky\" false", "neither"},
             {"\"bool sun\" 1", "sun"}}) {
        CAPTURE(text);
        // Some are wrong for any scene, and found when it is checked as a whole.
        auto const error = error_of([&] { validate(read_world("LightSource \"sunsky\" " + text)); });
        CHECK(contains(error, says));
        CHECK(contains(error, "t.pbrt:"));
    }
}
