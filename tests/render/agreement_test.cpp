// Integrators that share little must agree: path tracing, photon mapping with final gathering, progressive photon mapping and light
// tracing on the scenes that we ship. Tiles of 16 x 16 pixels (8 x 8 by default) are compared by Welch's test over independent
// batches, seeds of their own.
//
// Progressive estimates are biased by their radius: to first order by r at edges, where part of the disk is empty. So they are taken at
// r and at r / 2, with the same photons, and extrapolated to 0: 2 E(r/2) - E(r).
#include "statistics.h"

#include <doctest/doctest.h>

#include "films.h"
#include "photon_plan.h"

#include <algorithm>
#include <array>

using namespace nephroid;
using namespace nephroid::test;

namespace {

// What paths from the camera can find is compared: no caustics of points, of parallel light or of the sun.
struct Subject {
    char const* file;
    bool light_paths;     // the camera sees no specular surface
    float caustic_noise;  // passes of path tracing, times this
    // Of progressive estimates, scene units: small beside what is seen of the scene. 0: a part of the automatic radius. Where most
    // photons fall outside the picture, that is wider than the things in it.
    float radius = 0;
    // Lit from a wide sky: photons so sparse that leaves are smaller than any radius, and sppm is left out.
    bool open = false;
};
std::vector<Subject> subjects() {
    std::vector<Subject> const all{{"cornell-box", true, 1},
                                   {"cornell-mirror-boxes", false, 4},
                                   {"window", false, 1},
                                   {"lights", false, 1},
                                   {"instances", false, 1, 0, true},
                                   {"cornell-spheres", false, 4},
                                   {"cup", false, 4, 0.2f},
                                   {"ring", false, 4, 0.2f},
                                   {"pool", false, 4, 0.1f},
                                   {"iced-juice", false, 4, 0.2f},
                                   {"prism", false, 4},
                                   {"report/05-naive", true, 1},
                                   {"report/12-creature-mirror", false, 4},
                                   {"report/10-diamond", false, 4}};
    // Sanitizers see nothing new in the second.
    return full() ? all : std::vector<Subject>(all.begin(), all.begin() + (kSanitizerShare > 1 ? 1 : 2));
}

constexpr int kBatches = 16;

/// Means over batches: of tiles, by channel, and of the whole picture, all channels.
struct Tiles {
    std::vector<std::array<Mean, 3>> of;
    Mean picture;
};
int tile_size() { return full() ? 16 : 8; }
int picture_size() { return full() ? 64 : 24; }

std::vector<std::array<double, 3>> tile_means(Film const& film) {
    int const n = tile_size(), across = film.width() / n, down = film.height() / n;
    std::vector<std::array<double, 3>> means(static_cast<std::size_t>(across * down));
    for (int y = 0; y < down * n; ++y)
        for (int x = 0; x < across * n; ++x) {
            PixelSums const& p = film.pixel(x, y);
            for (std::size_t c = 0; c < 3; ++c)
                means[static_cast<std::size_t>(y / n * across + x / n)][c] += p.rgb[c] / p.weight / (n * n);
        }
    return means;
}

std::vector<std::array<double, 3>> render_tiles(World const& world, Settings s, int passes,
                                                std::uint64_t seed) {
    s.seed = seed;
    RenderJob const job(world, s);
    return tile_means(rendered(job, {0, static_cast<std::uint64_t>(passes)}));
}

template <class Render>
Tiles batches(Render const& render_batch) {
    Tiles tiles;
    for (int b = 0; b < kBatches; ++b) {
        auto const means = render_batch(static_cast<std::uint64_t>(b));
        tiles.of.resize(means.size());
        double sum = 0;
        for (std::size_t i = 0; i < means.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) tiles.of[i][c].add(means[i][c]), sum += means[i][c];
        tiles.picture.add(sum / static_cast<double>(3 * means.size()));
    }
    return tiles;
}

double welch_p(Mean const& a, Mean const& b, double slack) {
    double const va = a.standard_error() * a.standard_error(), vb = b.standard_error() * b.standard_error();
    double const off = std::abs(a.mean() - b.mean()) - slack;
    double const dof = (va + vb) * (va + vb) / ((va * va + vb * vb) / (kBatches - 1) + 1e-300);
    return off <= 0 ? 1 : student_p(off / std::sqrt(va + vb), dof);
}

/// `slack`: a share of the mean, of the tile or of the picture, that may be missing where an algorithm is biased by design.
void check_agreement(std::string const& scene, std::string const& name, Tiles const& expected,
                     Tiles const& found, double slack) {
    double const alpha = sidak(static_cast<int>(3 * expected.of.size()) + 1);
    std::array<double, 3> level{};  // of the picture
    for (auto const& tile : expected.of)
        for (std::size_t c = 0; c < 3; ++c)
            level[c] += tile[c].mean() / static_cast<double>(expected.of.size());
    double least = 1, widest = 0;
    std::vector<double> green;  // p-values; those of other channels would not be independent of these
    for (std::size_t i = 0; i < expected.of.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            Mean const& a = expected.of[i][c];
            Mean const& b = found.of[i][c];
            double const p = welch_p(a, b, slack * std::max(a.mean(), level[c]));
            if (c == 1) green.push_back(welch_p(a, b, 0));
            least = std::min(least, p);
            widest = std::max(widest, (a.half_width() + b.half_width()) / a.mean());
            INFO(scene, ", ", name, ", tile ", i, ", channel ", c);
            CHECK_MESSAGE(p >= alpha, a.mean(), " expected, ", b.mean(), " found, p = ", p);
        }
    // The picture: to 0.1% where that much can be seen, else as equal as can be seen.
    Mean const& a = expected.picture;
    Mean const& b = found.picture;
    double const tolerance = (full() ? 0.001 : 0.01) + slack;
    double const p = welch_p(a, b, tolerance * a.mean()), uniform = ks_uniform(green);
    double const error = std::hypot(a.standard_error(), b.standard_error()) / a.mean();
    MESSAGE(scene, ": ", name, " / path = ", b.mean() / a.mean(), " +- ", error, ", least p ", least, " of ",
            3 * expected.of.size(), ", widest interval ", widest, ", p-values uniform: p = ", uniform);
    double const off = std::abs(b.mean() / a.mean() - 1);
    if (2.6 * error < tolerance)
        CHECK(off < tolerance);
    else
        CHECK(p >= alpha);
    CHECK(error < (full() ? 0.015 : 0.03));  // else the check could hardly fail
    if (slack == 0)
        CHECK(uniform >= sidak(1));  // neither is biased: Welch's values are as often large as small
}

void check_subject(Subject const& subject) {
    int const more = full() ? 16 : 1;
    Scene scene = read_scene(std::string(NEPHROID_SOURCE_DIR "/scenes/") + subject.file + ".pbrt");
    World const world = compile(std::move(scene));
    Settings base = world.scene().settings;
    base.filter = BoxFilter{};
    base.color = ColorMode::Rgb;
    base.film.resolution = {picture_size(), picture_size()};
    base.film.crop.reset();
    base.film.max_component = kInfinity;
    constexpr int kDepth = 24;

    Settings path = base;
    path.integrator = PathIntegrator{.max_depth = kDepth};
    int const path_passes = static_cast<int>(24.0f * subject.caustic_noise) * more;
    Tiles const expected =
        batches([&](std::uint64_t b) { return render_tiles(world, path, path_passes, 100 + b); });

    SppmIntegrator sppm;
    sppm.max_depth = kDepth;
    sppm.shooting = {.global_paths = full() ? 50000 : 3000, .max_depth = kDepth};
    sppm.alpha = 1;
    Settings progressive = base;
    progressive.integrator = sppm;
    int const passes = full() ? 64 : 12;
    float const radius = subject.radius > 0 ? subject.radius
                                            : (full() ? 0.1f : 0.2f) *
                                                  RenderJob(world, progressive).photon_plan()->global_radius;
    if (!subject.open) {
        Tiles const extrapolated = batches([&](std::uint64_t b) {
            auto& i = std::get<SppmIntegrator>(progressive.integrator);
            i.estimates.radius = radius;
            auto const wide = render_tiles(world, progressive, passes, 200 + b);
            i.estimates.radius = radius / 2;
            auto narrow = render_tiles(world, progressive, passes, 200 + b);
            for (std::size_t k = 0; k < narrow.size(); ++k)
                for (std::size_t c = 0; c < 3; ++c) narrow[k][c] = 2 * narrow[k][c] - wide[k][c];
            return narrow;
        });
        check_agreement(subject.file, "sppm", expected, extrapolated, full() ? 0.002 : 0.01);
    }

    PhotonMapIntegrator gathering;
    gathering.max_depth = kDepth;
    gathering.shooting = {.global_paths = full() ? 400000 : 40000, .max_depth = kDepth};
    gathering.gather_samples = 4;
    Settings gathered = base;
    gathered.integrator = gathering;
    gathered.spp = 4 * more;
    Tiles const by_maps = batches([&](std::uint64_t b) { return render_tiles(world, gathered, 1, 300 + b); });
    check_agreement(subject.file, "photonmap", expected, by_maps, 0.02);

    if (!subject.light_paths) return;
    Settings lights = base;
    lights.integrator = LightPathIntegrator{.max_depth = kDepth, .paths = 20000};
    Tiles const by_light =
        batches([&](std::uint64_t b) { return render_tiles(world, lights, 4 * more, 400 + b); });
    check_agreement(subject.file, "lightpath", expected, by_light, 0);
}

}  // namespace

TEST_CASE("path tracing, photon mapping, progressive photon mapping and light tracing agree") {
    // One by name: --subcase=cup
    for (Subject const& subject : subjects()) SUBCASE(subject.file) check_subject(subject);
}
