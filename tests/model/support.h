// What the tests of models share: random directions, chi square over the sphere, and scenes made by hand.
#pragma once

#include "math/frame.h"
#include "model/assets.h"
#include "model/texture.h"
#include "scene/scene.h"
#include "statistics.h"

#include <unistd.h>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace nephroid::test {

/// A point or vector in double, for definitions written out.
struct D3 {
    double x, y, z;
};
inline double dot(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline D3 to_d(Vec3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Vec3 random_direction(Random& r) {
    double const z = r.uniform(-1, 1);
    double const phi = r.uniform(0, 2 * kPiD);
    double const s = std::sqrt(1 - z * z);
    return normalize(Vec3{static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                          static_cast<float>(z)});
}
inline TexturePoint at_point(Vec3 p, Vec3 dx = Vec3{0}, Vec3 dy = Vec3{0}) {
    TexturePoint t;
    t.p = p, t.dpdx = dx, t.dpdy = dy;
    return t;
}
inline Vec2 random_square(Random& r) {
    float const x = r.unit();
    return {x, r.unit()};
}
inline Vec3 direction(double theta, double phi) {
    return {static_cast<float>(std::sin(theta) * std::cos(phi)),
            static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta))};
}

/// Cells of equal solid angle: bands of z times azimuths.
class SphereCells {
  public:
    SphereCells(int bands, int azimuths) : bands_(bands), azimuths_(azimuths) {}
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(bands_ * azimuths_); }
    [[nodiscard]] std::size_t cell(Vec3 w) const {
        int const z =
            std::clamp(static_cast<int>((static_cast<double>(w.z) + 1) / 2 * bands_), 0, bands_ - 1);
        double const phi = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * kPiD) + 0.5;
        int const a = std::clamp(static_cast<int>(phi * azimuths_), 0, azimuths_ - 1);
        return static_cast<std::size_t>(z * azimuths_ + a);
    }
    /// Integral of a density over each cell by the midpoint rule on sub x sub points.
    [[nodiscard]] std::vector<double> integrate(std::function<double(Vec3)> const& pdf, int sub) const {
        std::vector<double> r(size());
        for (int z = 0; z < bands_; ++z)
            for (int k = 0; k < azimuths_; ++k)
                for (int a = 0; a < sub; ++a)
                    for (int b = 0; b < sub; ++b) {
                        double const c = (z + (a + 0.5) / sub) / bands_ * 2 - 1;
                        double const phi = ((k + (b + 0.5) / sub) / azimuths_ - 0.5) * 2 * kPiD;
                        r[static_cast<std::size_t>(z * azimuths_ + k)] +=
                            pdf(direction(std::acos(c), phi)) / (sub * sub) * 4 * kPiD / (bands_ * azimuths_);
                    }
        return r;
    }

  private:
    int bands_, azimuths_;
};

/// A folder that goes away with the test.
class Folder {
  public:
    Folder()
        : path_(std::filesystem::temp_directory_path() / ("nephroid_model_" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;
    [[nodiscard]] std::string file(std::string const& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

inline TextureId add_number(Scene& s, float value) { return s.add(Texture{ConstantFloatTexture{value}, {}}); }
inline TextureId add_color(Scene& s, Vec3 rgb) {
    return s.add(Texture{ConstantSpectrumTexture{RgbAlbedoSpd{rgb}, SpectrumRole::Albedo}, {}});
}

}  // namespace nephroid::test
