// Photons and photon paths as PLY files (binary, little endian), which point-cloud viewers, Blender and the like open.
#pragma once

#include "photon_cloud.h"

#include <filesystem>

namespace nephroid::cli {

/// What is written of a photon, as it lies in the file.
struct PlyPhoton {
    std::array<float, 3> p, n, d,
        power;  // position, normal, direction to where it came from, linear sRGB in W
    std::array<std::uint8_t, 3> color{};  // sRGB
    std::uint8_t map = 0;                 // 0 global, 1 caustic
    std::int32_t bounce = 0, light = 0;
};
static_assert(sizeof(PlyPhoton) == 60);

/// Photons one after the other. Colours are set when all are there.
class PhotonCloud {
  public:
    void add(PhotonRecord const& photon, Wavelengths const& lambda, ShotKind map);
    [[nodiscard]] std::size_t size() const { return photons_.size(); }
    /// Throws Error(Io). Nothing is there until all is.
    void write(std::filesystem::path const& path);

  private:
    std::vector<PlyPhoton> photons_;
};

/// Paths as edges between vertices: white before the first surface, yellow while mirrors and glass alone have turned them, blue
/// after others.
class PathLines {
  public:
    void add(TracedPath const& path);
    [[nodiscard]] std::size_t segments() const { return edges_.size(); }
    void write(std::filesystem::path const& path) const;

  private:
    struct Vertex {
        std::array<float, 3> p;
        std::array<std::uint8_t, 3> color;
    };
    struct Edge {
        std::array<std::int32_t, 2> vertices;
        std::array<std::uint8_t, 3> color;
    };
    std::vector<Vertex> vertices_;
    std::vector<Edge> edges_;
};

}  // namespace nephroid::cli
