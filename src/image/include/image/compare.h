// How far apart two pictures are: error measures, the FLIP difference evaluator, and a statistical test that needs no
// tuning: could these two noisy renders be pictures of the same thing? Sizes and channels must match; Error(Input) else.
#pragma once

#include "image/image.h"

#include <vector>

namespace nephroid {

/// Mean over all pixels and colour channels (alpha left out): sqrt(mean (a-b)^2).
double rmse(Image const& a, Image const& reference);
/// mean (a-b)^2 / (b^2 + 0.01), with b the reference: noise in dark regions weighs as much as in bright ones.
double rel_mse(Image const& a, Image const& reference);
/// The mean of each channel.
std::vector<double> channel_means(Image const& image);
/// Averages of blocks of n x n pixels (smaller at the right and lower edge), as floats: RMSE and relMSE of binned images
/// see bias where single pixels show noise.
Image binned(Image const& image, int n);

/// LDR-FLIP (Andersson et al. 2020) of the two images clamped to [0, 1], per pixel in [0, 1]: 0 is the same to the eye.
/// 67 pixels per degree is a 24-inch 4K monitor seen from 70 cm.
Image flip(Image const& test, Image const& reference, float pixels_per_degree = 67.0f);
double mean_flip(Image const& test, Image const& reference, float pixels_per_degree = 67.0f);

/// P(|T| >= |t|) of Student's t distribution with `dof` degrees of freedom (may be fractional or infinite).
double student_t_two_sided(double t, double dof);
/// The regularised incomplete beta function I_x(a, b), by its continued fraction.
double incomplete_beta(double a, double b, double x);

/// A render's mean and the variance of that mean, per pixel and channel, from `samples` independent samples a pixel
/// (0: unknown, many).
struct MeanPicture {
    Image const& mean;
    Image const& variance_of_mean;
    int samples = 0;
};
struct WelchResult {
    int tiles_x = 0, tiles_y = 0;
    std::vector<double>
        p;  // per tile, row by row: the smallest over channels, Sidak-corrected for their number
    double smallest = 1;  // of the tiles
    double corrected =
        1;  // Sidak: the probability of so small a p anywhere if both show the same: 1-(1-p)^tiles
};
/// Welch's test on the means of tiles, degrees of freedom by Satterthwaite. Pixels are taken to be independent; a wide
/// pixel filter that shares samples between pixels makes it too sure.
WelchResult welch_test(MeanPicture const& a, MeanPicture const& b, int tile_size = 16);

}  // namespace nephroid
