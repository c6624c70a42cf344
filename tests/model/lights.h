// What the tests of lights share: a light made ready, pictures of their own, and luminances.
#pragma once

#include "model/light.h"

#include "image/write.h"
#include "spectrum/color.h"
#include "support.h"

#include <unistd.h>
#include <filesystem>
#include <string>

namespace nephroid::test {

/// A scene with one light, made ready.
struct Lit {
    Scene scene;
    Assets assets;
    LightData data;

    Lit(LightKind const& kind, Mat4 const& to_world = {}, std::vector<ImageFile> images = {}) {
        scene.images = std::move(images);
        scene.add(Light{kind, to_world, {}});
        assets = Assets(scene);
        data = prepare(scene.lights[0], assets);
    }
    Lit(Lit const&) = delete;
    Lit& operator=(Lit const&) = delete;
    [[nodiscard]] Light const& light() const { return scene.lights[0]; }
    [[nodiscard]] std::optional<LightSample> sample(Vec3 p, Vec2 u,
                                                    Wavelengths const& w = Wavelengths::rgb()) const {
        return sample_light(light(), data, assets, p, u, w);
    }
    [[nodiscard]] Spectrum radiance(Vec3 w, Wavelengths const& l = Wavelengths::rgb()) const {
        return environment_radiance(light(), data, assets, {}, w, l);
    }
    [[nodiscard]] Spectrum radiance(Vec3 p, Vec3 w) const {
        return environment_radiance(light(), data, assets, p, w, Wavelengths::rgb());
    }
    [[nodiscard]] double pdf(Vec3 p, Vec3 w) const {
        return static_cast<double>(environment_pdf(light(), data, p, w));
    }
    [[nodiscard]] double pdf(Vec3 w) const {
        return static_cast<double>(environment_pdf(light(), data, {}, w));
    }
};

inline double luminance_of(Spectrum rgb) { return static_cast<double>(luminance({rgb[0], rgb[1], rgb[2]})); }
/// Luminance as the film sees spectral radiance: the mean of Y over wavelengths.
template <class F>
double spectral_luminance(F const& f) {
    double sum = 0;
    int const n = 2000;
    for (int i = 0; i < n; ++i) {
        auto const w = Wavelengths::spectral(0.25f * (static_cast<float>(i) + 0.5f) / n);
        sum += static_cast<double>(to_xyz(f(w), w).y);
    }
    return sum / n;
}

/// A picture file, gone with the object.
class Picture {
  public:
    Picture(std::string const& name, int width, int height, std::function<Vec3(int, int)> const& texel)
        : path_((std::filesystem::temp_directory_path() /
                 ("nephroid_light_" + std::to_string(::getpid()) + "_" + name + ".pfm"))
                    .string()) {
        Image image(PixelFormat::Float, width, height, {"R", "G", "B"});
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) image.set(x, y, c, texel(x, y)[c]);
        write_pfm(path_, image);
    }
    ~Picture() { std::filesystem::remove(path_); }
    Picture(Picture const&) = delete;
    Picture& operator=(Picture const&) = delete;
    [[nodiscard]] std::vector<ImageFile> files() const { return {{path_, "", {}}}; }

  private:
    std::string path_;
};

inline Mat4 turned() { return *rotate(50, 1, 2, 3); }

}  // namespace nephroid::test
