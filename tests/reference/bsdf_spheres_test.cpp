// Mitsuba's scenes of spheres, one for each kind of surface, remade by hand (bsdf_spheres/*.pbrt) and held against the
// pictures that Mitsuba 2.2.1 and 3.7 made of them (RGB variant, two path segments).
//
// A twin is rendered in batches of different seeds, which say how sure its means are. Two things are asked: that the mean
// of each sphere, channel by channel, is within 1%, or off by no more than chance; and that Welch's test finds no tile of
// 4 x 4 pixels whose luminance differs. (Glass that shows a small light is too noisy for a percent, and mostly not so with
// NEPHROID_FULL.) Luminance, because Mitsuba takes its moments of X, Y and Z and writes the variances through the matrix to
// RGB, which leaves only that of Y a variance.
//
// What differs lies in Mitsuba's models, and is said at the balls and twins below:
// - coats: the light that a rough boundary lets through, and sends back inside, is computed with the shadowing of the two directions
//   multiplied (ours and pbrt's is correlated with height, Heitz 2014, eq. 99), and 2 integral R mu dmu is the plain mean over 64
//   nodes with both ends, which makes it 1/64 too small. With these two in the place of ours the pictures of all coats agree, to 0.1%
//   and in every tile (tried once).
// - bumps: 3.7 turns a normal around that would face away from the viewer, and darkens light that comes in low over the
//   unperturbed surface (Conty Estevez, Lecocq & Stein 2019); ours does neither. With both in ours no tile differs (tried once), and
//   a flat map, which has neither, is asserted.
// - leaves: masks let no shadow ray through (uncut_leaves.pbrt), and the density of a direction sampled at a mask lacks the
//   opacity, so that weights add up to more than one where its edges are soft. A point light has neither.
#include "film/develop.h"
#include "image/compare.h"
#include "image/read.h"
#include "image/write.h"
#include "read/read.h"
#include "reference_pictures.h"
#include "render/render.h"
#include "spectrum/color.h"
#include "statistics.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

using namespace nephroid;
using test::rgb_of;

namespace {

constexpr int kSize = 48;    // of Mitsuba's pictures
constexpr int kBatches = 8;  // one seed each
constexpr int kTile = 4;
// Mitsuba's tests render references with 12000 samples; what is seen of their noise is less than that.
constexpr double kTheirSamples = 12000;

enum class Layout { One, Grid, LinearCoats, Coats };

/// A ball of radius 1 by the place of its middle to the left and up, and its distance from the camera.
struct Ball {
    double left, up, distance;
    double tolerance = 0.01;  // of its mean
    bool by_tiles = true;
};

std::vector<Ball> balls(Layout layout) {
    switch (layout) {
        case Layout::One:
            return {{0, 0, 4}};
        case Layout::LinearCoats:
            // GGX of alpha 0.01, 0.1, 0.4 and 1. What comes back inside, 1/64 too small, divides all of the diffuse light …
            return {{1.2, 1.2, 8, 0.02, false},
                    {-1.2, 1.2, 8, 0.02, false},
                    {1.2, -1.2, 8, 0.02, false},
                    {-1.2, -1.2, 8, 0.08, false}};
        case Layout::Coats:
            // … and with the base's reflectance in between little of it: what is left are the shadowings.
            return {{1.2, 1.2, 8}, {-1.2, 1.2, 8}, {1.2, -1.2, 8, 0.01, false}, {-1.2, -1.2, 8, 0.06, false}};
        default:
            // The third is the one rough coat that is not black, and linear.
            return {{-6, 3, 24}, {-3, 3, 24}, {0, 3, 24, 0.02, false},
                    {3, 3, 24},  {6, 3, 24},  {-6, 0, 24},
                    {-3, 0, 24}, {0, 0, 24},  {3, 0, 24},
                    {6, 0, 24}};
    }
}
constexpr Ball kLeaves[] = {{-6, -3, 24}, {-3, -3, 24}};

struct Twin {
    char const* name;
    Layout layout;
    int fine;    // a pixel is this many squared: textures are compared unfiltered
    int passes;  // of a batch
    bool leaves = false;
    bool bumps = false;
};

constexpr Twin kTwins[] = {
    {"pointlight", Layout::Grid, 4, 4, true},
    {"constant", Layout::Grid, 4, 4},
    {"arealight", Layout::Grid, 4, 4},
    {"envmap", Layout::Grid, 4, 4},
    {"roughdielectric", Layout::One, 4, 4},
    {"roughplastic_linear", Layout::LinearCoats, 4, 2},
    {"roughplastic_nonlinear", Layout::Coats, 4, 2},
    {"textured_diffuse", Layout::One, 4, 2},
    {"textured_roughconductor", Layout::One, 8, 1},
    {"normalmap_identity_roughconductor", Layout::One, 4, 2},
    {"normalmap_roughconductor", Layout::One, 8, 1, false, true},
    {"normalmap", Layout::One, 8, 1, false, true},
    {"bumpmap", Layout::One, 8, 1, false, true},
};

/// Where a ball is in the picture, pixels.
struct Disc {
    double x, y, radius;
    explicit Disc(Ball const& b) {
        double const scale = kSize / 2 / 0.305941;  // for a tangent of 1: fov 34.02 degrees
        x = kSize / 2 - b.left / b.distance * scale;
        y = kSize / 2 - b.up / b.distance * scale;
        radius = scale / std::sqrt(b.distance * b.distance - 1);
    }
    [[nodiscard]] bool holds(int px, int py, double share) const {
        return std::hypot(px + 0.5 - x, py + 0.5 - y) < share * radius;
    }
};

double luminance_at(Image const& m, int x, int y) {
    return static_cast<double>(luminance(Vec3{m.get(x, y, 0), m.get(x, y, 1), m.get(x, y, 2)}));
}

/// Means over pixels of Mitsuba's size, one picture a batch.
std::vector<Image> batches(std::filesystem::path const& scene, Twin const& twin, int passes) {
    World const world = compile(read_scene(scene));
    Settings settings = world.scene().settings;
    settings.film.resolution = {kSize * twin.fine, kSize * twin.fine};
    settings.color = ColorMode::Rgb;
    std::vector<Image> result;
    for (int b = 0; b < kBatches; ++b) {
        settings.seed = static_cast<std::uint64_t>(b);
        RenderJob const job(world, settings);
        Film film = job.make_film();
        RenderControl control;
        control.passes = {0, static_cast<std::uint64_t>(passes)};
        render(job, control, film);
        CHECK(!film.tainted());
        result.push_back(binned(develop(film), twin.fine));
    }
    return result;
}

/// Their picture with the rows of ours: row r of theirs is at the polar angle r / (h - 1) pi, of ours at (r + 1/2) / h pi.
/// Eight rows for each of their intervals, between which bilinear look-ups are as theirs but at the knots.
Image respaced(Image const& theirs) {
    int const h = theirs.height();
    constexpr int kRows = 8;
    Image out(PixelFormat::Float, theirs.width(), kRows * (h - 1), {"R", "G", "B"});
    for (int y = 0; y < out.height(); ++y) {
        int const row = y / kRows;
        float const t = (static_cast<float>(y % kRows) + 0.5f) / kRows;
        for (int x = 0; x < out.width(); ++x)
            for (int c = 0; c < 3; ++c)
                out.set(x, y, c, (1 - t) * theirs.get(x, row, c) + t * theirs.get(x, row + 1, c));
    }
    return out;
}

/// The twins beside what they name: Mitsuba's meshes and textures.
std::filesystem::path prepared_folder(std::filesystem::path const& data) {
    auto const folder =
        std::filesystem::temp_directory_path() / ("nephroid_spheres_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::copy(std::filesystem::path(NEPHROID_SOURCE_DIR) / "tests/reference/bsdf_spheres",
                          folder);
    std::filesystem::create_directory_symlink(data / "common", folder / "common");
    write_exr(folder / "museum.exr", respaced(rgb_of(read_image(data / "common/textures/museum.exr"))));
    return folder;
}

/// The worst of all balls and channels, as difference and standard error, both relative; and how many are so noisy that chance alone
/// may take them off by a percent.
struct Worst {
    double off = 0, error = kInfinity;
    int noisy = 0;
};

Worst compare_balls(Twin const& twin, std::vector<Image> const& ours, Image const& theirs) {
    auto list = balls(twin.layout);
    if (twin.leaves) list.insert(list.end(), std::begin(kLeaves), std::end(kLeaves));
    double const alpha = test::sidak(static_cast<int>(3 * list.size() * std::size(kTwins)));
    Worst worst;
    for (Ball const& ball : list) {
        Disc const disc(ball);
        // The outermost tenth is left to the tiles, which do not dilute it by what is behind.
        auto const mean = [&](Image const& m, int c) {
            double sum = 0;
            int n = 0;
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x)
                    if (disc.holds(x, y, 0.9)) sum += static_cast<double>(m.get(x, y, c)), ++n;
            return sum / n;
        };
        for (int c = 0; c < 3; ++c) {
            CAPTURE(ball.left);
            CAPTURE(ball.up);
            CAPTURE(c);
            double const expected = mean(theirs, c);
            test::Mean m;
            for (Image const& image : ours) m.add(mean(image, c));
            if (expected == 0) {
                CHECK(m.mean() == 0);  // a mirror finds no point light
                continue;
            }
            double const off = m.mean() / expected - 1, error = m.standard_error() / expected;
            CAPTURE(off);
            CAPTURE(error);
            CHECK((std::abs(off) < ball.tolerance || m.p(expected) > alpha));
            if (error > 0.004) ++worst.noisy;
            if (std::abs(off) - 2 * error > std::abs(worst.off) - 2 * worst.error)
                worst.off = off, worst.error = error;
        }
    }
    return worst;
}

WelchResult compare_tiles(Twin const& twin, std::vector<Image> const& ours, Image const& theirs,
                          Image const& their_variance) {
    Image const blank(PixelFormat::Float, kSize, kSize, {"Y"});
    Image a = blank, a_variance = blank, b = blank, b_variance = blank;
    std::vector<Ball> left_out;
    for (Ball const& ball : balls(twin.layout))
        if (!ball.by_tiles) left_out.push_back(ball);
    if (twin.layout == Layout::Grid && !twin.leaves)
        left_out.insert(left_out.end(), std::begin(kLeaves), std::end(kLeaves));
    auto const is_out = [&](int x, int y) {
        // Wide enough for the corners of leaves, and for balls that the projection draws out.
        return std::any_of(left_out.begin(), left_out.end(),
                           [&](Ball const& ball) { return Disc(ball).holds(x, y, 1.6); });
    };
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            if (is_out(x, y)) continue;
            test::Mean m;
            for (Image const& image : ours) m.add(luminance_at(image, x, y));
            double const expected = luminance_at(theirs, x, y);
            // XYZ and back cost theirs a few units of the fifth digit, and the faintest tails of its lobes are cut.
            double const rounding = 1e-4 * expected + 1e-6;
            a.set(x, y, 0, static_cast<float>(m.mean()));
            a_variance.set(x, y, 0, static_cast<float>(m.variance() / kBatches));
            b.set(x, y, 0, static_cast<float>(expected));
            b_variance.set(
                x, y, 0,
                static_cast<float>(std::max(0.0, luminance_at(their_variance, x, y)) / kTheirSamples +
                                   rounding * rounding));
        }
    return welch_test({a, a_variance, kBatches}, {b, b_variance, 0}, kTile);
}

}  // namespace

TEST_CASE("spheres of every surface agree with Mitsuba's") {
    auto const data = test::data_folder() / "mitsuba/mitsuba-data";
    auto const pictures = data / "tests/scenes/bsdf_spheres/refs";
    if (!std::filesystem::exists(pictures)) {
        MESSAGE("SKIPPED: no pictures at ", pictures.string(), "; set NEPHROID_SHARED");
        return;
    }
    auto const folder = prepared_folder(data);
    for (Twin const& twin : kTwins) {
        std::string const name = twin.name;
        CAPTURE(name);
        auto const picture = [&](char const* what) {
            return rgb_of(read_image(pictures / ("test_" + name + "_ref_rgb" + what + ".exr")));
        };
        Image const theirs = picture("");
        REQUIRE(theirs.width() == kSize);
        REQUIRE(theirs.height() == kSize);
        auto const ours = batches(folder / (name + ".pbrt"), twin,
                                  std::max(1, test::samples(twin.passes, 8 * twin.passes)));
        Worst const ball = compare_balls(twin, ours, theirs);
        WelchResult const tiles = compare_tiles(twin, ours, theirs, picture("_var"));
        auto const at = std::min_element(tiles.p.begin(), tiles.p.end()) - tiles.p.begin();
        char line[256];
        std::snprintf(line, sizeof line,
                      "%-34s worst mean %+.2f%% (noise %.2f%%; %d above 0.4%%)   worst tile p %.1e at "
                      "(%d, %d), of all %.2g   %s",
                      twin.name, 100 * ball.off, 100 * ball.error, ball.noisy, tiles.smallest,
                      static_cast<int>(at) % tiles.tiles_x, static_cast<int>(at) / tiles.tiles_x,
                      tiles.corrected, twin.bumps ? "bumps" : "asserted");
        MESSAGE(std::string(line));
        if (!twin.bumps) CHECK(tiles.corrected > test::sidak(std::size(kTwins)));
    }
    std::filesystem::remove_all(folder);
}
