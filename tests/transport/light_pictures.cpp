// Emission that varies over a surface: sampled where it is bright, and right.
#include "emitters.h"
#include "image/write.h"
#include "measure.h"

#include <unistd.h>
#include <filesystem>

using namespace nephroid;
using namespace nephroid::test;

namespace {

DirectIntegrator direct(ShapeSampling shapes, DirectStrategy strategy = DirectStrategy::Light) {
    DirectIntegrator d{1};
    d.lights.shapes = shapes;
    d.strategy = strategy;
    return d;
}

/// Dark but for one texel.
class SpotPicture {
  public:
    SpotPicture(int size, float dim)
        : path_(std::filesystem::temp_directory_path() /
                ("nephroid_spot_" + std::to_string(::getpid()) + "_" + std::to_string(size) + ".pfm")) {
        Image image(PixelFormat::Float, size, size, {"R", "G", "B"});
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                for (int c = 0; c < 3; ++c)
                    image.set(
                        x, y, c,
                        x == size / 3 && y == size * 17 / 20 ? 100.0f * static_cast<float>(c + 1) : dim);
        write_pfm(path_, image);
    }
    ~SpotPicture() { std::filesystem::remove(path_); }
    SpotPicture(SpotPicture const&) = delete;
    SpotPicture& operator=(SpotPicture const&) = delete;
    [[nodiscard]] ImageFile file() const { return {path_.string(), "", {}}; }

  private:
    std::filesystem::path path_;
};

AreaLight showing(ImageId image) {
    AreaLight l = white(1);
    l.image = image;
    return l;
}

/// Relative variance of a sample.
double variance(World const& world, Settings const& s) {
    Means const m = measure(world, s, 64);
    double const mean = m[0][1].mean();
    return m[0][1].variance() / (mean * mean);
}

}  // namespace

TEST_CASE("light pictures: one bright spot has a tenth of the variance at most, on every shape") {
    SpotPicture const picture(48, 0.01f);
    for (auto const& e : emitting_shapes()) {
        if (e.name == "box" || e.name == "box of triangles") continue;  // the spot is on each face
        CAPTURE(e.name);
        Scene scene;
        add(scene, floor_quad(50), diffuse(scene, 1));
        look_parallel(scene, {-0.8f, 1.4f, 0.01f}, {0, 0, -1}, 0.3f);  // on the spot's side of round ones
        AreaLight const light = showing(scene.add(picture.file()));
        place(scene, e, placements()[2], 1, light);
        World const world = compile(scene);
        Settings by_area = settings(direct(ShapeSampling::Area));
        by_area.sampler = IndependentSampler{};
        Settings by_picture = settings(direct(ShapeSampling::SolidAngle));
        by_picture.sampler = IndependentSampler{};
        double const before = variance(world, by_area);
        double const after = variance(world, by_picture);
        MESSAGE(e.name, ": variance by area / by picture: ", before / after);
        CHECK(before > 10 * after);
    }
}

TEST_CASE("light pictures: pictures and textures on every shape, by area and by what is bright") {
    SpotPicture const picture(9, 3);
    for (auto const& e : emitting_shapes()) {
        CAPTURE(e.name);
        for (bool const procedural : {false, true}) {
            CAPTURE(procedural);
            Scene scene;
            add(scene, floor_quad(50), diffuse(scene, 1));
            look_parallel(scene, {0.1f, 0.1f, 0.01f}, {0, 0, -1}, 0.3f);
            AreaLight light = white(1, true);
            if (procedural) {
                CheckerboardTexture board;
                board.mapping = UvMapping{3, 5, 0, 0};
                board.tex1 = spectrum(scene, RgbUnboundedSpd{{8, 4, 2}}, SpectrumRole::Unbounded);
                board.tex2 = spectrum(scene, RgbUnboundedSpd{{0, 0, 0.1f}}, SpectrumRole::Unbounded);
                light.texture = scene.add(Texture{board, {}});
            } else {
                light = showing(scene.add(picture.file()));
                light.two_sided = true;
            }
            place(scene, e, placements()[e.name.size() % placements().size()], 1, light);
            World const world = compile(scene);
            check_same(
                {{"area", &world, settings(direct(ShapeSampling::Area)), 2048},
                 {"picture", &world, settings(direct(ShapeSampling::SolidAngle)), 64},
                 {"mis", &world, settings(direct(ShapeSampling::SolidAngle, DirectStrategy::Mis)), 64}});
        }
    }
}
