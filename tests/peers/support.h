// A folder of one's own, and a scene with one of each thing.
#pragma once

#include "peer_scene.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace nephroid::test {

/// Made anew, and gone at the end.
class PeersFolder {
  public:
    PeersFolder()
        : path_(std::filesystem::temp_directory_path() /
                ("nephroid-test-peers-" + std::to_string(::getpid()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~PeersFolder() { std::filesystem::remove_all(path_); }
    PeersFolder(PeersFolder const&) = delete;
    PeersFolder& operator=(PeersFolder const&) = delete;
    [[nodiscard]] std::filesystem::path const& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline std::string text_of(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    REQUIRE(file.good());
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// A lamp of 2 x 0.5 at height 3 that shines down, a floor with a picture, a ball of glass, a mirror; seen from the side.
inline peers::PeerScene one_of_each() {
    using namespace peers;
    PeerScene s;
    PeerPicture picture{Image(PixelFormat::Float, 2, 1, {"R", "G", "B"}), true};
    for (int k = 0; k < 3; ++k) picture.image.set(0, 0, k, 1), picture.image.set(1, 0, k, 0.25f);
    s.pictures.push_back(picture);
    s.surfaces = {{PeerSurface::Kind::Diffuse, Vec3{0}},
                  {PeerSurface::Kind::Diffuse, Vec3{0.5f}, 0},
                  {PeerSurface::Kind::Glass, Vec3{1}, -1, 1.25f},
                  {PeerSurface::Kind::Mirror, Vec3{0.9f, 0.8f, 0.7f}}};
    PeerMesh lamp;
    lamp.mesh.p = {{-1, -0.25f, 3}, {-1, 0.25f, 3}, {1, 0.25f, 3}, {1, -0.25f, 3}};
    lamp.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    lamp.emission = {8, 4, 2};
    lamp.flat = FlatLight{{0, 0, 3}, {1, 0, 0}, {0, 0.25f, 0}, false};
    PeerMesh floor;
    floor.mesh.p = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
    floor.mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    floor.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    floor.surface = 1;
    PeerMesh mirror = floor;
    mirror.mesh.uv.clear();
    for (Vec3& p : mirror.mesh.p) p = {p.x, 4, p.y + 4};
    mirror.surface = 3;
    s.meshes = {lamp, floor, mirror};
    s.balls = {{{0.5f, -1, 0.75f}, 0.625f, 2}};
    s.camera = {{0, -8, 1}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.5f};
    s.resolution = {60, 40};
    s.depth = 5;
    return s;
}

}  // namespace nephroid::test
