// Which portals a scene may hold.
#include "sample_scene.h"

#include <doctest/doctest.h>

#include <string>

using namespace nephroid;

namespace {

Scene with_portal(std::array<Vec3, 4> const& corners) {
    Scene s = sample_scene();
    std::get<InfiniteLight>(s.lights[1].kind).portal = corners;
    return s;
}
std::string fault_of(Scene const& s) {
    try {
        validate(s);
        return "";
    } catch (Error const& e) {
        return e.what();
    }
}

}  // namespace

TEST_CASE("a portal is a rectangle, within pbrt's tolerance, of any size") {
    CHECK(fault_of(with_portal({{{0, 0, 0}, {0, 2, 0}, {3, 2, 0}, {3, 0, 0}}})).empty());
    CHECK(fault_of(with_portal({{{0, 0, 0}, {0, 2, 0}, {3, 2.002f, 0.01f}, {3, 0, 0}}})).empty());
    CHECK(fault_of(with_portal({{{0, 0, 0}, {0, 2e-30f, 0}, {3e-30f, 2e-30f, 0}, {3e-30f, 0, 0}}})).empty());
    for (auto const& corners : std::initializer_list<std::array<Vec3, 4>>{
             {{{0, 0, 0}, {0, 2, 0}, {3, 0, 0}, {3, 2, 0}}},     // crossed over
             {{{0, 0, 0}, {1, 2, 0}, {4, 2, 0}, {3, 0, 0}}},     // a parallelogram
             {{{0, 0, 0}, {0, 2, 0}, {3, 2, 0.5f}, {3, 0, 0}}},  // not flat
             {{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {3, 0, 0}}},     // a trapezium
         })
        CHECK(fault_of(with_portal(corners)) ==
              "scene.pbrt:11: the light's portal is not a rectangle; give its four corners in order");
    CHECK(fault_of(with_portal({{{0, 0, 0}, {0, 2, 0}, {0, 2, 0}, {3, 0, 0}}})).find("two equal corners") !=
          std::string::npos);
    CHECK(fault_of(with_portal({{{0, 0, 0}, {0, 2, 0}, {3, kInfinity, 0}, {3, 0, 0}}})).find("finite") !=
          std::string::npos);
}

TEST_CASE("a portal shapes the picture: scenes with another one, or none, are others") {
    Scene const none = sample_scene();
    Scene const a = with_portal({{{0, 0, 0}, {0, 2, 0}, {3, 2, 0}, {3, 0, 0}}});
    Scene const b = with_portal({{{0, 0, 0}, {0, 2, 0}, {3, 2, 0}, {3, 0, 1e-6f}}});
    CHECK(hash(none) != hash(a));
    CHECK(hash(a) != hash(b));
    CHECK(hash(a) == hash(with_portal({{{0, 0, 0}, {0, 2, 0}, {3, 2, 0}, {3, 0, 0}}})));
}
