// Mitsuba's scenes of spheres, one for each kind of surface, held against its own pictures.
#include "film/develop.h"
#include "image/compare.h"
#include "image/read.h"
#include "read/read.h"
#include "render/render.h"
#include "statistics.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

using namespace nephroid;

namespace {
std::filesystem::path data_folder() {
    char const* const named = std::getenv("NEPHROID_SHARED");
    auto const shared = named ? std::filesystem::path(named)
                              : std::filesystem::path(NEPHROID_SOURCE_DIR).parent_path() / "shared";
    return shared / "data/mitsuba/mitsuba-data/tests";
}
struct Rendered {
    Image mean, variance, ymean, yvariance;  // of the mean
    int samples;
};
float lum(Image const& m, int x, int y) { return 0.212671f * m.get(x, y, 0) + 0.71516f * m.get(x, y, 1) + 0.072169f * m.get(x, y, 2); }
Rendered rendered(std::filesystem::path const& scene, int k, int passes, bool spectral) {
    World const world = compile(read_scene(scene));
    Settings settings = world.scene().settings;
    settings.film.resolution = {48 * k, 48 * k};
    settings.color = spectral ? ColorMode::Spectral : ColorMode::Rgb;
    int const batches = 8;
    std::vector<test::Mean> v(48 * 48 * 4);
    for (int b = 0; b < batches; ++b) {
        settings.seed = static_cast<std::uint64_t>(b);
        RenderJob const job(world, settings);
        Film film = job.make_film();
        RenderControl control;
        control.passes = {0, static_cast<std::uint64_t>(passes)};
        render(job, control, film);
        Image const m = binned(develop(film), k);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                for (int c = 0; c < 3; ++c) v[(y * 48 + x) * 4 + c].add(m.get(x, y, c));
                v[(y * 48 + x) * 4 + 3].add(lum(m, x, y));
            }
    }
    Rendered r;
    r.samples = batches;
    r.mean = Image(PixelFormat::Float, 48, 48, {"R", "G", "B"});
    r.variance = r.mean;
    r.ymean = Image(PixelFormat::Float, 48, 48, {"Y"});
    r.yvariance = r.ymean;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            for (int c = 0; c < 3; ++c) {
                r.mean.set(x, y, c, float(v[(y * 48 + x) * 4 + c].mean()));
                r.variance.set(x, y, c, float(v[(y * 48 + x) * 4 + c].variance() / batches));
            }
            r.ymean.set(x, y, 0, float(v[(y * 48 + x) * 4 + 3].mean()));
            r.yvariance.set(x, y, 0, float(v[(y * 48 + x) * 4 + 3].variance() / batches));
        }
    return r;
}
Image rgb_of(Image const& image, float scale) {
    Image out(PixelFormat::Float, image.width(), image.height(), {"R", "G", "B"});
    char const* const names[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        int const from = image.channel(names[c]).value();
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) out.set(x, y, c, image.get(x, y, from) * scale);
    }
    return out;
}
}  // namespace

TEST_CASE("dev") {
    auto const data = data_folder();
    auto const folder = std::filesystem::temp_directory_path() / "nephroid-bsdf-spheres";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::filesystem::copy(std::filesystem::path(NEPHROID_SOURCE_DIR) / "tests/reference/bsdf_spheres", folder);
    std::filesystem::create_directory_symlink(data.parent_path() / "common", folder / "common");
    std::string names = std::getenv("TW");
    int const k = std::atoi(std::getenv("KK")), passes = std::atoi(std::getenv("PP"));
    std::string const variant = std::getenv("VARIANT") ? std::getenv("VARIANT") : "rgb";
    std::size_t at = 0;
    while (at < names.size()) {
        auto const end = std::min(names.find(',', at), names.size());
        std::string const name = names.substr(at, end - at);
        at = end + 1;
        auto const refs = data / "scenes/bsdf_spheres/refs";
        Image const theirs = rgb_of(read_image(refs / ("test_" + name + "_ref_" + variant + ".exr")), 1);
        Image const tvar = rgb_of(read_image(refs / ("test_" + name + "_ref_" + variant + "_var.exr")), 1.0f);
        auto const t0 = std::chrono::steady_clock::now();
        Rendered const r = rendered(folder / (name + ".pbrt"), k, passes, variant != "rgb");
        double const secs = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
        auto const a = channel_means(r.mean), b = channel_means(theirs);
        std::printf("%s %.1fs: means %+.2f%% %+.2f%% %+.2f%%\n", name.c_str(), secs, 100 * (a[0] / b[0] - 1),
                    100 * (a[1] / b[1] - 1), 100 * (a[2] / b[2] - 1));
        std::vector<std::array<double, 3>> discs;
        if (name == "constant" || name == "pointlight" || name == "arealight" || name == "envmap")
            for (double z : {3.0, 0.0, -3.0})
                for (double y : {-6.0, -3.0, 0.0, 3.0, 6.0}) discs.push_back({y / 24, z / 24, 1 / 24.0});
        else if (name.find("plastic") != std::string::npos)
            for (double z : {1.2, -1.2})
                for (double y : {1.2, -1.2}) discs.push_back({y / 8, z / 8, 1 / 8.0});
        else
            discs.push_back({0, 0, 1 / 4.0});
        for (auto d : discs) {
            double const s = 24 / 0.305941, cx = 24 - d[0] * s, cy = 24 - d[1] * s, rad = d[2] * s * 0.9;
            std::array<double, 3> o{}, t{}, ov{}, tv{};
            int n = 0;
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x)
                    if (std::hypot(x + .5 - cx, y + .5 - cy) < rad) {
                        ++n;
                        for (int c = 0; c < 3; ++c) {
                            auto const u = static_cast<std::size_t>(c);
                            o[u] += r.mean.get(x, y, c), t[u] += theirs.get(x, y, c),
                                ov[u] += r.variance.get(x, y, c), tv[u] += tvar.get(x, y, c);
                        }
                    }
            std::printf("   (%+.2f %+.2f) n=%d ", d[0] / d[2], d[1] / d[2], n);
            for (std::size_t c = 0; c < 3; ++c)
                std::printf(" %8.5f %+.2f%% (se %.2f%%, v %.2g/%.2g)", t[c] / n, 100 * (o[c] / t[c] - 1),
                            100 * std::sqrt(ov[c]) / t[c], ov[c] / n, tv[c] / n);
            std::printf("\n");
        }
        Image ty(PixelFormat::Float, 48, 48, {"Y"}), tyv = ty;
        double const spp = std::atof(std::getenv("NN"));
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) ty.set(x, y, 0, lum(theirs, x, y)), tyv.set(x, y, 0, float(std::max(0.0f, lum(tvar, x, y)) / spp));
        WelchResult const w = welch_test({r.ymean, r.yvariance, r.samples}, {ty, tyv, 0}, 4);
        if (std::getenv("MONO")) {
            Image const mono = read_image(refs / ("test_" + name + "_ref_mono.exr")), mv = read_image(refs / ("test_" + name + "_ref_mono_var.exr"));
            Image const spec = rgb_of(read_image(refs / ("test_" + name + "_ref_spectral.exr")), 1);
            (void)mv; (void)spec; double ee = 0, ov = 0, tv = 0;
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x)
                    if (tyv.get(x, y, 0) * spp > 1e-2) {
                        double const e = double(r.ymean.get(x, y, 0) - ty.get(x, y, 0)), t = double(tyv.get(x, y, 0)) * spp;
                        ee += e * e / t, ov += double(r.yvariance.get(x, y, 0)) / t, tv += 1;
                    }
            std::printf("   N = %g (ee %g ov %g tv %g)\n", tv / (ee - ov), ee, ov, tv);
        }
        if (std::getenv("MAP")) {
            Image const o4 = binned(r.mean, 4), t4 = binned(theirs, 4);
            for (int y = 0; y < 12; ++y) {
                for (int x = 0; x < 12; ++x)
                    std::printf("%+7.2f", 100.0 * (o4.get(x, y, 1) / t4.get(x, y, 1) - 1));
                std::printf("   ");
                for (int x = 0; x < 12; ++x) std::printf(" %6.3f", double(t4.get(x, y, 1)));
                std::printf("   ");
                for (int x = 0; x < 12; ++x) std::printf(" %7.1e", w.p[std::size_t(y * 12 + x)]);
                std::printf("\n");
            }
        }
    }
}
