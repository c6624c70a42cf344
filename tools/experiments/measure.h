// What experiments measure: pictures, their errors against a reference, and the variance of single samples.
// Everything is a pure function of scene, settings and seeds, so that a page can be made again, number by number.
#pragma once

#include "film/film.h"
#include "image/image.h"
#include "scene/settings.h"
#include "world/world.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::experiment {

/// A compiled scene, and the settings that its file asks for.
struct Setup {
    World world;
    Settings settings;
};
/// Reads and compiles pbrt text; file names count from `folder`.
Setup prepare(std::string const& pbrt, std::filesystem::path const& folder = ".");

/// `base` with the integrator, the sampler and the samples a pixel of these pbrt directives, so that what a page quotes is what was
/// run.
/// Throws Error(Input) when a directive does not mean what it says (a note of the reader's).
Settings with(Settings const& base, std::string const& directives);

/// Linear sRGB, row by row from the top.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::array<double, 3>> rgb;
};
Picture picture(Film const& film);
Image image_of(Picture const& p);

/// Passes [0, passes) under this seed. Throws std::runtime_error when samples or rays were not numbers.
Film render_film(Setup const& setup, std::string const& directives, std::uint64_t passes, std::uint64_t seed);
/// … developed.
Picture render_picture(Setup const& setup, std::string const& directives, std::uint64_t passes,
                       std::uint64_t seed);

/// Over all pixels and channels.
double mean(Picture const& p);
/// Root of the mean square difference, as a share of the reference's mean.
double relative_rmse(Picture const& p, Picture const& reference);

struct Reference {
    Picture picture;
    double error = 0;  // its own relative RMSE, estimated; 0 for a closed form
};
/// Of references, and of no measurement.
inline constexpr std::array<std::uint64_t, 2> kReferenceSeeds{0x5eed0001, 0x5eed0002};
/// Two renders of `passes` passes, averaged; what lies between them says how good the average is.
Reference reference_by_samples(Setup const& setup, std::string const& directives, std::uint64_t passes);
/// The surface point in each pixel's centre; the origin where there is none.
std::vector<Vec3> positions(Setup const& setup);
/// The radiance that a formula gives for the surface point in each pixel's centre.
Reference closed_form(Setup const& setup, std::function<double(Vec3 p)> const& radiance);

/// Relative RMSE after each of `counts` samples (ascending) a pixel, over `seeds` renders: the root of the mean square.
std::vector<double> rmse_over_samples(Setup const& setup, std::string const& directives,
                                      std::span<int const> counts, int seeds, Picture const& reference);

/// Variance of a single sample, averaged over the pixels, as a share of the squared mean of the picture.
/// The sampler must be "independent"; relative RMSE after n samples is sqrt(variance / n).
struct SampleVariance {
    double relative = 0, error = 0;   // and its standard error, from the seeds
    double mean = 0, mean_error = 0;  // of the picture
};
SampleVariance variance_per_sample(Setup const& setup, std::string const& directives, std::uint64_t passes,
                                   int seeds);
/// The same, pixel by pixel, of the first seed's render: the share is of the pixel's own squared mean.
std::vector<double> variance_by_pixel(Setup const& setup, std::string const& directives,
                                      std::uint64_t passes);

/// Mean over several renders, and its standard error.
struct Estimate {
    double mean = 0, error = 0;
};
/// Per pixel, over `seeds` renders of `passes` passes; the average of the channels.
std::vector<Estimate> means_by_pixel(Setup const& setup, std::string const& directives, std::uint64_t passes,
                                     int seeds);

/// Of these pixels together, or of all; each channel for itself.
std::array<Estimate, 3> means_by_channel(Setup const& setup, std::string const& directives,
                                         std::uint64_t passes, int seeds,
                                         std::vector<bool> const& pixels = {});

/// Slope of log y over log x by least squares; points with y = 0 do not count.
double log_log_slope(std::span<double const> x, std::span<double const> y);

}  // namespace nephroid::experiment
