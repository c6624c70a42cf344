// What a scene is said to cost against what it costs; and scenes that nobody could expand.
#include <doctest/doctest.h>

#include "films.h"
#include "world/estimate.h"

#include <filesystem>
#include <fstream>

using namespace nephroid;
using namespace nephroid::test;

namespace {

std::uint64_t added(Scene const& scene) { return estimated_bytes(scene) - held_bytes(scene); }

Scene grid(int n, bool shining) {
    TriangleMesh mesh;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            mesh.p.emplace_back(static_cast<float>(x), static_cast<float>(y),
                                static_cast<float>((x * y) % 7));
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            int const a = y * (n + 1) + x;
            mesh.triangles.emplace_back(a, a + 1, a + n + 1);
            mesh.triangles.emplace_back(a + 1, a + n + 2, a + n + 1);
        }
    Scene scene =
        read_text("WorldBegin\nMaterial \"diffuse\"\nAreaLightSource \"diffuse\"\nShape \"sphere\"\n");
    Object& o = scene.world().objects.front();
    o.shape = std::move(mesh);
    if (!shining) o.light.reset();
    return scene;
}

}  // namespace

TEST_CASE("the estimate is not below what the world holds, nor far above") {
    for (bool const shining : {false, true}) {
        Scene scene = grid(500, shining);
        std::uint64_t const small = estimated_bytes(Scene{});  // what any world takes
        std::uint64_t const estimated = estimated_bytes(scene) - small;
        World const world = compile(std::move(scene));
        CAPTURE(estimated);
        CAPTURE(world.memory().total());
        CHECK(estimated > world.memory().total());
        CHECK(estimated < 3 * world.memory().total());
    }
}

TEST_CASE("the estimate counts the files of measured materials, once each, and alpha on emitters") {
    char const* const path = "measured-of-64-KiB.bsdf";
    std::ofstream(path) << std::string(1 << 16, 'x');
    Scene scene = read_text("WorldBegin\nAreaLightSource \"diffuse\"\nShape \"sphere\"");
    std::uint64_t const before = added(scene);
    for (int i = 0; i < 2; ++i) scene.add(Material{MeasuredMaterial{{path, {}}}, "", {}});
    CHECK(added(scene) - before == 5 * (1 << 16));
    std::filesystem::remove(path);
    CHECK(added(scene) == before);
    scene.world().objects.front().alpha = scene.add(Texture{ConstantFloatTexture{0.5f}, {}});
    CHECK(added(scene) >= before + 256 * 256 * 4);
}

TEST_CASE("the estimate counts what is not expanded") {
    std::uint64_t const small = added(read_text("WorldBegin\nShape \"sphere\""));
    // Instances multiply.
    std::string bomb = "WorldBegin\nObjectBegin \"o0\"\nShape \"sphere\"\nObjectEnd\n";
    for (int level = 1; level <= 12; ++level) {
        bomb += "ObjectBegin \"o" + std::to_string(level) + "\"\n";
        for (int i = 0; i < 40; ++i) bomb += "ObjectInstance \"o" + std::to_string(level - 1) + "\"\n";
        bomb += "ObjectEnd\n";
    }
    CHECK(added(read_text(bomb + "ObjectInstance \"o4\"")) > small + 2'560'000 * 400ull);
    CHECK(added(read_text(bomb + "ObjectInstance \"o12\"")) >
          (std::uint64_t{1} << 62));  // 40^12 do not fit 64 bits
    // Subdivision grows by four a level, and must not wrap around.
    Scene scene = grid(10, false);
    LoopSubdivision loop;
    loop.p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    loop.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    loop.levels = 8;
    scene.world().objects.front().shape = loop;
    std::uint64_t const eight = added(scene);
    std::get<LoopSubdivision>(scene.world().objects.front().shape).levels = 9;
    double const growth = static_cast<double>(added(scene) - small) / static_cast<double>(eight - small);
    CHECK(growth == doctest::Approx(4).epsilon(0.01));
    std::get<LoopSubdivision>(scene.world().objects.front().shape).levels = 2'000'000'000;
    CHECK(added(scene) > (std::uint64_t{1} << 40));
}

TEST_CASE("a scene that is not valid has an estimate, too") {
    Scene scene;
    scene.groups.resize(3);
    scene.groups[0].instances = {{GroupId{1}}, {GroupId{77}}};
    scene.groups[1].instances = {{GroupId{2}}};
    scene.groups[2].instances = {{GroupId{1}}};  // in circles
    scene.images.push_back({"/nowhere.png", "", {}});
    CHECK(added(scene) < (std::uint64_t{1} << 30));
}
