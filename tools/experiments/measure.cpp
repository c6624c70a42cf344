#include "measure.h"

#include "math/error.h"
#include "read/read.h"
#include "render/render.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephroid::experiment {

namespace {

/// Adds what is missing of passes [0, passes) to the film.
void grow(RenderJob const& job, std::uint64_t passes, Film& film) {
    RenderControl control;
    control.passes = {0, passes};
    render(job, control, film);
    if (film.tainted()) throw std::runtime_error("samples or rays were not numbers");
}

Settings seeded(Setup const& setup, std::string const& directives, std::uint64_t seed) {
    Settings s = with(setup.settings, directives);
    s.seed = seed;
    return s;
}

/// Unbiased variance of one sample of equal weight, and the mean.
struct Moments {
    double mean = 0, variance = 0;
};
Moments moments(PixelSums const& p, std::size_t channel) {
    auto const n = static_cast<double>(p.samples);
    Moments m;
    m.mean = p.rgb[channel] / p.weight;
    m.variance = std::max(0.0, p.square[channel] / p.weight_square - m.mean * m.mean) * n / (n - 1);
    return m;
}

/// A mean of few numbers, and its standard error.
class Spread {
  public:
    void add(double v) { n_ += 1, sum_ += v, square_ += v * v; }
    [[nodiscard]] double mean() const { return sum_ / n_; }
    [[nodiscard]] double error() const {
        return n_ > 1 ? std::sqrt(std::max(0.0, square_ / n_ - mean() * mean()) / (n_ - 1)) : 0;
    }

  private:
    double n_ = 0, sum_ = 0, square_ = 0;
};

}  // namespace

Setup prepare(std::string const& pbrt, std::filesystem::path const& folder) {
    Scene scene = read_pbrt_string(pbrt, "experiment", folder);
    Settings const settings = scene.settings;
    return {compile(std::move(scene)), settings};
}

Settings with(Settings const& base, std::string const& directives) {
    Scene const scene = read_pbrt_string(directives + "\nWorldBegin\n", "settings", ".");
    if (!scene.notes.empty()) throw Error(ErrorKind::Input, directives + ": " + scene.notes.front().text);
    Settings s = base;
    s.integrator = scene.settings.integrator;
    s.sampler = scene.settings.sampler;
    s.spp = scene.settings.spp;
    return s;
}

Picture picture(Film const& film) {
    Picture p{film.width(), film.height(), {}};
    p.rgb.reserve(static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height));
    auto const crop = film.crop();
    for (int y = crop[2]; y < crop[3]; ++y)
        for (int x = crop[0]; x < crop[1]; ++x) {
            PixelSums const& s = film.pixel(x, y);
            p.rgb.push_back({s.rgb[0] / s.weight, s.rgb[1] / s.weight, s.rgb[2] / s.weight});
        }
    return p;
}

Film render_film(Setup const& setup, std::string const& directives, std::uint64_t passes,
                 std::uint64_t seed) {
    RenderJob const job(setup.world, seeded(setup, directives, seed));
    Film film = job.make_film();
    grow(job, passes, film);
    return film;
}

Picture render_picture(Setup const& setup, std::string const& directives, std::uint64_t passes,
                       std::uint64_t seed) {
    return picture(render_film(setup, directives, passes, seed));
}

Image image_of(Picture const& p) {
    Image image(PixelFormat::Float, p.width, p.height, default_channel_names(3));
    std::size_t i = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x, ++i)
            for (int c = 0; c < 3; ++c)
                image.set(x, y, c, static_cast<float>(p.rgb[i][static_cast<std::size_t>(c)]));
    return image;
}

double mean(Picture const& p) {
    double sum = 0;
    for (auto const& c : p.rgb) sum += c[0] + c[1] + c[2];
    return sum / (3 * static_cast<double>(p.rgb.size()));
}

double relative_rmse(Picture const& p, Picture const& reference) {
    double sum = 0;
    for (std::size_t i = 0; i < p.rgb.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) sum += std::pow(p.rgb[i][c] - reference.rgb[i][c], 2);
    return std::sqrt(sum / (3 * static_cast<double>(p.rgb.size()))) / mean(reference);
}

Reference reference_by_samples(Setup const& setup, std::string const& directives, std::uint64_t passes) {
    Picture const a = render_picture(setup, directives, passes, kReferenceSeeds[0]);
    Picture const b = render_picture(setup, directives, passes, kReferenceSeeds[1]);
    Reference r{a, relative_rmse(a, b) / 2};
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) r.picture.rgb[i][c] = (a.rgb[i][c] + b.rgb[i][c]) / 2;
    return r;
}

std::vector<Vec3> positions(Setup const& setup) {
    Settings s = setup.settings;
    s.film.aovs = true;
    RenderJob const job(setup.world, s);
    Film film = job.make_film();
    grow(job, 1, film);
    std::vector<Vec3> p;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            AovSums const& a = film.aov(x, y);
            p.push_back(a.hits > 0
                            ? Vec3(a.position[0] / a.hits, a.position[1] / a.hits, a.position[2] / a.hits)
                            : Vec3(0, 0, 0));
        }
    return p;
}

Reference closed_form(Setup const& setup, std::function<double(Vec3 p)> const& radiance) {
    Vec2i const size = setup.settings.film.resolution;
    Reference r{{size.x, size.y, {}}, 0};
    for (Vec3 const& p : positions(setup)) {
        double const value = radiance(p);
        r.picture.rgb.push_back({value, value, value});
    }
    return r;
}

std::vector<double> rmse_over_samples(Setup const& setup, std::string const& directives,
                                      std::span<int const> counts, int seeds, Picture const& reference) {
    std::vector<double> square(counts.size());
    for (int seed = 1; seed <= seeds; ++seed) {
        RenderJob const job(setup.world, seeded(setup, directives, static_cast<std::uint64_t>(seed)));
        Film film = job.make_film();
        // A longer render begins with the shorter one, so one film passes through all counts.
        for (std::size_t i = 0; i < counts.size(); ++i) {
            grow(job, static_cast<std::uint64_t>(counts[i]), film);
            double const e = relative_rmse(picture(film), reference);
            square[i] += e * e / seeds;
        }
    }
    for (double& s : square) s = std::sqrt(s);
    return square;
}

SampleVariance variance_per_sample(Setup const& setup, std::string const& directives, std::uint64_t passes,
                                   int seeds) {
    if (!std::holds_alternative<IndependentSampler>(with(setup.settings, directives).sampler))
        throw Error(ErrorKind::Input, "samples that depend on each other have no variance of their own");
    Spread relative, average;
    for (int seed = 1; seed <= seeds; ++seed) {
        Film const film = render_film(setup, directives, passes, static_cast<std::uint64_t>(seed));
        Moments all;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x)
                for (std::size_t c = 0; c < 3; ++c) {
                    Moments const m = moments(film.pixel(x, y), c);
                    all.mean += m.mean, all.variance += m.variance;
                }
        double const values = 3.0 * film.width() * film.height();
        average.add(all.mean / values);
        relative.add(all.variance / values / std::pow(all.mean / values, 2));
    }
    return {relative.mean(), relative.error(), average.mean(), average.error()};
}

std::vector<double> variance_by_pixel(Setup const& setup, std::string const& directives,
                                      std::uint64_t passes) {
    Film const film = render_film(setup, directives, passes, 1);
    std::vector<double> v;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            Moments const m = moments(film.pixel(x, y), 1);
            v.push_back(m.mean > 0 ? m.variance / (m.mean * m.mean) : 0);
        }
    return v;
}

std::vector<Estimate> means_by_pixel(Setup const& setup, std::string const& directives, std::uint64_t passes,
                                     int seeds) {
    std::vector<Spread> spread;
    for (int seed = 1; seed <= seeds; ++seed) {
        Picture const p = render_picture(setup, directives, passes, static_cast<std::uint64_t>(seed));
        spread.resize(p.rgb.size());
        for (std::size_t i = 0; i < p.rgb.size(); ++i)
            spread[i].add((p.rgb[i][0] + p.rgb[i][1] + p.rgb[i][2]) / 3);
    }
    std::vector<Estimate> e;
    e.reserve(spread.size());
    for (Spread const& s : spread) e.push_back({s.mean(), s.error()});
    return e;
}

std::array<Estimate, 3> means_by_channel(Setup const& setup, std::string const& directives,
                                         std::uint64_t passes, int seeds, std::vector<bool> const& pixels) {
    std::array<Spread, 3> spread;
    for (int seed = 1; seed <= seeds; ++seed) {
        Picture const p = render_picture(setup, directives, passes, static_cast<std::uint64_t>(seed));
        std::array<double, 3> sum{};
        double count = 0;
        for (std::size_t i = 0; i < p.rgb.size(); ++i) {
            if (!pixels.empty() && !pixels[i]) continue;
            count += 1;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += p.rgb[i][c];
        }
        for (std::size_t c = 0; c < 3; ++c) spread[c].add(sum[c] / count);
    }
    std::array<Estimate, 3> e;
    for (std::size_t c = 0; c < 3; ++c) e[c] = {spread[c].mean(), spread[c].error()};
    return e;
}

double log_log_slope(std::span<double const> x, std::span<double const> y) {
    double n = 0;
    double sx = 0;
    double sy = 0;
    double sxx = 0;
    double sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(y[i] > 0)) continue;
        double const u = std::log(x[i]);
        double const v = std::log(y[i]);
        n += 1, sx += u, sy += v, sxx += u * u, sxy += u * v;
    }
    double const d = n * sxx - sx * sx;
    return d > 0 ? (n * sxy - sx * sy) / d : 0;
}

}  // namespace nephroid::experiment
