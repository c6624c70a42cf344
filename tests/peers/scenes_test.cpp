// The scenes of the benchmark are what they say: nothing of them is ignored, and everything is in what the others are given.
#include "support.h"

#include "read/read.h"
#include "scene/scene.h"

using namespace nephroid;
using namespace nephroid::peers;
namespace fs = std::filesystem;

namespace {

PeerScene made(std::string const& file) {
    Scene const scene = read_scene(fs::path(NEPHROID_SOURCE_DIR) / file);
    INFO(file);
    for (Note const& n : scene.notes) FAIL_CHECK(n.text);
    return make_peer_scene(scene);
}
/// Of a side of it, in the world.
double area(PeerMesh const& m) {
    double sum = 0;
    for (Vec3i const t : m.mesh.triangles) {
        Vec3 const p = m.mesh.p[static_cast<std::size_t>(t.x)];
        sum += 0.5 * static_cast<double>(length(cross(m.mesh.p[static_cast<std::size_t>(t.y)] - p,
                                                      m.mesh.p[static_cast<std::size_t>(t.z)] - p)));
    }
    return sum;
}
std::size_t boxes(PeerScene const& s) {
    std::size_t n = 0;
    for (PeerMesh const& m : s.meshes) n += m.mesh.triangles.size() == 12;
    return n;
}

}  // namespace

TEST_CASE("the Cornell boxes") {
    for (char const* file : {"bench/peers/scenes/cornell.pbrt", "bench/peers/scenes/cornell_glass.pbrt"}) {
        PeerScene const s = made(file);
        CHECK(s.resolution == Vec2i{400, 400});
        CHECK(s.depth == 8);
        CHECK(s.meshes[0].emission.x == doctest::Approx(17));
        CHECK(area(s.meshes[0]) == doctest::Approx(0.47 * 0.38));
        CHECK(front(s.meshes[0].mesh).y == doctest::Approx(-1));  // it shines down
        REQUIRE(s.meshes[0].flat);
    }
    CHECK(made("bench/peers/scenes/cornell_glass.pbrt").balls.size() == 1);
}
TEST_CASE("the hall has its pillars and the room its table") {
    PeerScene const hall = made("bench/peers/scenes/many_lights.pbrt"),
                    room = made("bench/peers/scenes/interior.pbrt");
    CHECK(boxes(hall) == 22);
    CHECK(boxes(room) == 5);
    // None of them is the box of -1 to 1 that a shape without parameters is.
    for (PeerScene const* s : {&hall, &room})
        for (PeerMesh const& m : s->meshes) CHECK(std::abs(area(m) - 24) > 0.01);
    std::size_t lamps = 0;
    for (PeerMesh const& m : hall.meshes) lamps += m.emission != Vec3{0};
    CHECK(lamps == 320);
    CHECK(room.pictures.size() == 3);
}
TEST_CASE("the caustics have their glass and their light") {
    PeerScene const pool = made("scenes/pool.pbrt"), cup = made("scenes/cup.pbrt");
    auto const has = [](PeerScene const& s, PeerSurface::Kind kind) {
        for (PeerMesh const& m : s.meshes)
            if (s.surfaces[static_cast<std::size_t>(m.surface)].kind == kind) return true;
        return false;
    };
    CHECK(has(pool, PeerSurface::Kind::Glass));
    CHECK(has(cup, PeerSurface::Kind::Mirror));
    for (PeerScene const* s : {&pool, &cup}) {
        CHECK(s->sky.x > 0);
        CHECK(s->meshes[0].emission.x > 0);
    }
}
