// Real scenes, held against pictures that pbrt-v4 made of them with thousands of samples (CPU, path integrator).
//
// NEPHROID_FULL takes eight times the samples and halves the tolerances.
#include "film/develop.h"
#include "image/compare.h"
#include "image/read.h"
#include "read/read.h"
#include "reference_pictures.h"
#include "render/render.h"
#include "statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

using namespace nephroid;
using test::data_folder, test::rgb_of;
using test::kSanitizerShare;

namespace {

struct Reference {
    char const* name;   // of the picture
    char const* scene;  // below the data folder
    int passes;         // enough that noise stays well below the tolerance
    double tolerance;   // of the means
};
/// Of what has no coats; with NEPHROID_FULL half of that.
constexpr double kPlain = 0.005;
/// Coats: pbrt-v4 weighs one of the two ways out of its layers by another density than it draws from (see
/// docs/decisions/0007-coats-in-closed-form.md), which shows in its pictures.
constexpr double kCoated = 0.02;

constexpr Reference kReferences[] = {
    {"cornell-box", "pbrt4-minus/cornell-box/cornell-box.pbrt", 64, kPlain},
    {"smallpt", "pbrt4-minus/cornell-box/smallpt.pbrt", 128, kPlain},
    {"cornell-box-specular", "pbrt4-minus/cornell-box/cornell-box-specular.pbrt", 128, kPlain},
    {"lights-shapes", "references/pbrt-v4/lights-shapes.pbrt", 96, kPlain},
    {"lights-delta", "references/pbrt-v4/lights-delta.pbrt", 256, kPlain},
    {"lights-env", "references/pbrt-v4/lights-env.pbrt", 128, kPlain},
    {"materials", "references/pbrt-v4/materials.pbrt", 128, kPlain},
    {"textures", "references/pbrt-v4/textures.pbrt", 128, kPlain},
    {"veach-mis", "pbrt4-minus/veach-mis/veach-mis.pbrt", 64, kCoated},
    {"killeroo-simple", "pbrt4-minus/killeroos/killeroo-simple.pbrt", 64, kCoated},
};

bool is_full() { return std::getenv("NEPHROID_FULL") != nullptr; }

struct Rendered {
    Image picture;
    std::uint64_t dropped = 0;
};

Rendered rendered(std::filesystem::path const& scene, Vec2i size, int passes) {
    World const world = compile(read_scene(scene));
    Settings settings = world.scene().settings;
    settings.film.resolution = size;
    settings.film.crop.reset();
    RenderJob const job(world, settings);
    Film film = job.make_film();
    RenderControl control;
    control.passes = {0, static_cast<std::uint64_t>(passes)};
    render(job, control, film);
    return {develop(film), film.dropped()};
}

bool is_finite(Image const& image) {
    for (float const x : image.floats())
        if (!std::isfinite(x)) return false;
    return true;
}

}  // namespace

TEST_CASE("pictures agree with pbrt-v4's") {
    auto const data = data_folder();
    auto const pictures = data / "references/pbrt-v4";
    if (!std::filesystem::exists(pictures)) {
        MESSAGE("SKIPPED: no pictures at ", pictures.string(), "; set NEPHROID_SHARED");
        return;
    }
    for (Reference const& r : kReferences) {
        CAPTURE(std::string(r.name));
        Image const theirs = rgb_of(read_image(pictures / (std::string(r.name) + ".exr")));
        // Sanitizers look for faults of memory: an eighth of the samples, and room for their noise.
        int const passes = is_full() ? 8 * r.passes : kSanitizerShare > 1 ? r.passes / 8 : r.passes;
        double const room = kSanitizerShare > 1 ? 10 : 1;
        auto const [ours, dropped] = rendered(data / r.scene, {theirs.width(), theirs.height()}, passes);

        auto const a = channel_means(ours);
        auto const b = channel_means(theirs);
        double const binned_error = rel_mse(binned(ours, 16), binned(theirs, 16));
        char line[256];
        std::snprintf(line, sizeof line,
                      "%-20s %5d passes   means %+.2f%% %+.2f%% %+.2f%%   binned relMSE %.2e", r.name, passes,
                      100 * (a[0] / b[0] - 1), 100 * (a[1] / b[1] - 1), 100 * (a[2] / b[2] - 1),
                      binned_error);
        MESSAGE(std::string(line));

        CHECK(dropped == 0);
        CHECK(is_finite(ours));  // negative numbers are colours outside sRGB, which theirs holds as well
        double const tolerance = is_full() ? r.tolerance / 2 : r.tolerance * room;
        for (std::size_t c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]).epsilon(tolerance).scale(0));
        CHECK(binned_error < (is_full() ? 5e-4 : 1e-3 * room));
    }
}
