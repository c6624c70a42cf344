// The law: a render is a sum of independent passes, and pass i is a pure function of (world, settings, seed, i). Whoever
// computes it, in whatever order and company, the sums are the same.
#include <doctest/doctest.h>

#include "films.h"

#include "film/checkpoint.h"
#include "film/develop.h"

#include <algorithm>
#include <filesystem>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Every integrator with every sampler in both colour modes: f(job, what it is).
template <class F>
void for_each_job(World const& world, F f) {
    for (Integrator const& integrator : integrators())
        for (Sampler const& sampler : samplers())
            for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
                // What sanitizers look for does not come with one pair of sampler and colours only.
                bool const second = color == ColorMode::Spectral;
                if (kSanitizerShare > 1 && ((integrator.index() + sampler.index()) % 2 != 0) != second)
                    continue;
                Settings s = world.scene().settings;
                s.integrator = integrator;
                s.sampler = sampler;
                s.color = color;
                s.film.aovs = true;
                s.seed = 7;
                INFO("integrator ", integrator.index(), ", sampler ", sampler.index(), ", color ",
                     static_cast<int>(color));
                f(RenderJob(world, s));
            }
}

std::vector<std::string> scenes() { return {kRoom, kCup, kChecks, kBodies}; }

bool same_floats(Image const& a, Image const& b) {
    if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels()) return false;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int c = 0; c < a.channels(); ++c)
                if (a.get(x, y, c) != b.get(x, y, c)) return false;
    return true;
}
bool something_is_seen(Film const& f) {
    double sum = 0;
    for (int y = 0; y < f.height(); ++y)
        for (int x = 0; x < f.width(); ++x) sum += std::abs(f.pixel(x, y).rgb[1]);
    return sum > 0;
}

struct Folder {
    std::filesystem::path path;
    Folder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "nephroid-render-XXXXXX").string();
        REQUIRE(mkdtemp(pattern.data()) != nullptr);
        path = pattern;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;
};

}  // namespace

TEST_CASE("a pass has the same bits on any number of threads, and those of its definition") {
    for (std::string const& text : scenes()) {
        World const world = compile(read_text(text));
        for_each_job(world, [&](RenderJob const& job) {
            Film const reference = by_definition(job, {0, 5});
            CHECK(something_is_seen(reference));
            CHECK(reference.dropped() == 0);
            for (int const threads : {1, 2, 7, 64}) {
                CAPTURE(threads);
                CHECK(differing_pixels(reference, rendered(job, {0, 5}, threads)) == 0);
            }
        });
    }
}

TEST_CASE("passes may be rendered in any order, split over films, and merged") {
    for (std::string const& text : scenes()) {
        World const world = compile(read_text(text));
        for_each_job(world, [&](RenderJob const& job) {
            Film const one = rendered(job, {0, 8});
            // Two machines.
            Film const halves = merge(rendered(job, {0, 3}), rendered(job, {3, 8}));
            CHECK(rounding_between(one, halves) < 1e-14);
            CHECK(same_floats(develop(one), develop(halves)));
            // Eight machines, and the films come in as they please.
            std::vector<std::uint64_t> order{5, 0, 7, 2, 6, 1, 3, 4};
            Film gathered;
            for (std::uint64_t const pass : order) merge_into(gathered, rendered(job, {pass, pass + 1}));
            CHECK(rounding_between(one, gathered) < 1e-14);
            CHECK(same_floats(develop(one), develop(gathered)));
            // A film with a hole, filled.
            Film holed = rendered(job, {2, 5});
            CHECK(add_passes(job, {0, 8}, holed).passes == 5);
            CHECK(rounding_between(one, holed) < 1e-14);
            CHECK(same_floats(develop(one), develop(holed)));
        });
    }
}

TEST_CASE("a render goes on from a file as if it had never stopped") {
    Folder const folder;
    World const world = compile(read_text(kRoom));
    for_each_job(world, [&](RenderJob const& job) {
        Film const one = rendered(job, {0, 6});
        Film const first = rendered(job, {0, 2});
        write_film(folder.path / "a.film.exr", first, {});
        Film from_film = read_film(folder.path / "a.film.exr");
        add_passes(job, {0, 6}, from_film);
        CHECK(differing_pixels(one, from_film) == 0);
        write_checkpoint(folder.path / "c.film.exr", first);
        Film from_checkpoint = read_checkpoint(folder.path / "c.film.exr");
        add_passes(job, {0, 6}, from_checkpoint);
        CHECK(differing_pixels(one, from_checkpoint) == 0);
    });
}

TEST_CASE("a longer render leaves earlier passes as they are") {
    for (std::string const& text : scenes()) {
        World const world = compile(read_text(text));
        for_each_job(world, [&](RenderJob const& job) {
            Film const whole = rendered(job, {0, 16});
            Film grown = rendered(job, {0, 8});
            add_passes(job, {8, 16}, grown);
            CHECK(differing_pixels(whole, grown) == 0);
            // By tiny batches.
            Film bit_by_bit = job.make_film();
            for (std::uint64_t const end : {1, 2, 4, 7, 11, 16}) add_passes(job, {0, end}, bit_by_bit);
            CHECK(differing_pixels(whole, bit_by_bit) == 0);
            // How many samples a scene asks for is not what a pass depends on.
            Settings more = job.settings();
            more.spp = 100'000;
            if (auto* maps = std::get_if<PhotonMapIntegrator>(&more.integrator))
                maps->passes = more.spp / samples_per_pass(job.settings());
            RenderJob const long_job(world, more);
            CHECK(differing_pixels(rendered(job, {3, 4}), rendered(long_job, {3, 4})) == 0);
            CHECK(long_job.make_film().identity() == whole.identity());
        });
    }
}

TEST_CASE("large batches are small ones") {
    // Passes so fast that the loop takes them by the dozen.
    World const world = compile(read_text(kChecks));
    Settings s = world.scene().settings;
    s.film.aovs = true;
    RenderJob const job(world, s);
    Film const reference = by_definition(job, {0, 300});
    CHECK(differing_pixels(reference, rendered(job, {0, 300}, 1)) == 0);
    Film split = rendered(job, {0, 17});
    add_passes(job, {0, 299}, split);
    add_passes(job, {0, 300}, split);
    CHECK(differing_pixels(reference, split) == 0);
}

TEST_CASE("far passes are as good as near ones") {
    World const world = compile(read_text(kRoom));
    for_each_job(world, [&](RenderJob const& job) {
        std::uint64_t const far = (std::uint64_t{1} << 40) + 3;
        Film const a = rendered(job, {far, far + 2});
        CHECK(something_is_seen(a));
        CHECK(differing_pixels(a, by_definition(job, {far, far + 2})) == 0);
    });
}

TEST_CASE("seeds, passes and nothing else make different pictures") {
    World const world = compile(read_text(kRoom));
    Settings s = world.scene().settings;
    RenderJob const job(world, s);
    s.seed = 1;
    RenderJob const other(world, s);
    Film const a = rendered(job, {0, 1});
    int const pixels = a.width() * a.height();
    CHECK(differing_pixels(a, rendered(other, {0, 1})) > pixels * 9 / 10);
    CHECK_FALSE(same_floats(develop(a), develop(rendered(job, {1, 2}))));
    CHECK_THROWS_AS(merge(a, rendered(other, {1, 2})), Error);
    CHECK_THROWS_AS(merge(a, rendered(job, {0, 2})), Error);
}

TEST_CASE("a crop window holds the pixels of the full picture") {
    for (std::string const& text : scenes()) {
        World const world = compile(read_text(text));
        for_each_job(world, [&](RenderJob const& job) {
            Film const full = rendered(job, {0, 3});
            Vec2i const r = job.settings().film.resolution;
            for (auto const& crop :
                 {std::array<int, 4>{5, 14, 3, 11}, std::array<int, 4>{0, r.x, r.y - 1, r.y},
                  std::array<int, 4>{r.x - 1, r.x, 0, 1}, std::array<int, 4>{-5, 17, -1, 1000}}) {
                Settings s = job.settings();
                s.film.crop = crop;
                RenderJob const cropped(world, s);
                Film const part = rendered(cropped, {0, 3});
                CHECK(part.width() <= r.x);
                CHECK(differing_pixels(full, part) == 0);
            }
        });
    }
    World const world = compile(read_text(kRoom));
    Settings s = world.scene().settings;
    s.film.crop = std::array<int, 4>{40, 50, 0, 10};  // beyond the right edge
    CHECK_THROWS_AS(RenderJob(world, s), Error);
}
