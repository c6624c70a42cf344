// Welch's unequal-variance t-test on tiles of two renders (Welch 1947; degrees of freedom: Satterthwaite 1946).
#include "image/compare.h"
#include "math/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid {

namespace {

/// The continued fraction of I_x(a,b) (Abramowitz & Stegun 26.5.8), evaluated from the front (modified Lentz).
double beta_fraction(double a, double b, double x) {
    constexpr double kTiny = 1e-300;
    auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
    double c = 1.0;
    double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    double value = d;
    for (int m = 1; m <= 10000; ++m) {
        double const even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1.0 / away_from_zero(1.0 + even * d);
        c = away_from_zero(1.0 + even / c);
        value *= c * d;
        double const odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1.0 / away_from_zero(1.0 + odd * d);
        c = away_from_zero(1.0 + odd / c);
        double const step = c * d;
        value *= step;
        if (std::abs(step - 1.0) < 1e-15) break;
    }
    return value;
}

/// ln B(a, b). For large arguments the difference of lgammas cancels; Stirling's series does not.
double log_beta(double a, double b) {
    if (a < b) std::swap(a, b);
    if (a < 1e4) return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
    auto tail = [](double z) { return 1.0 / (12.0 * z) - 1.0 / (360.0 * z * z * z); };
    double const difference =
        -(a - 0.5) * std::log1p(b / a) - b * std::log(a + b) + b + tail(a) - tail(a + b);
    return std::lgamma(b) + difference;
}

/// P(any of n independent p-values is at most p).
double sidak(double p, double n) { return p >= 1.0 ? 1.0 : -std::expm1(n * std::log1p(-p)); }

struct TileSum {
    double difference = 0;  // of the sums
    double variance = 0;    // of that difference
    double weight = 0;      // sum of v^2/(n-1): Satterthwaite's denominator
};

void add(TileSum& tile, MeanPicture const& e, double sign, int x, int y, int c) {
    double const v = e.variance_of_mean.get(x, y, c);
    tile.difference += sign * e.mean.get(x, y, c);
    tile.variance += v;
    if (e.samples > 0) tile.weight += v * v / std::max(e.samples - 1, 1);
}

double p_value(TileSum const& t) {
    if (!std::isfinite(t.difference) || !(t.variance >= 0)) return 0.0;  // NaN never passes
    if (t.variance == 0) return t.difference == 0 ? 1.0 : 0.0;
    double const dof =
        t.weight > 0 ? t.variance * t.variance / t.weight : std::numeric_limits<double>::infinity();
    return student_t_two_sided(t.difference / std::sqrt(t.variance), dof);
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
    if (!(x > 0)) return 0.0;
    if (x >= 1) return 1.0;
    double const front = std::exp(a * std::log(x) + b * std::log1p(-x) - log_beta(a, b));
    // The fraction converges fast on this side of the mean; the other side is its complement.
    if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
    return 1.0 - front * beta_fraction(b, a, 1 - x) / b;
}

double student_t_two_sided(double t, double dof) {
    if (std::isnan(t)) return 0.0;
    // Beyond 10^7 degrees of freedom the normal distribution agrees to the digits that matter.
    if (dof > 1e7) return std::erfc(std::abs(t) / std::sqrt(2.0));
    return incomplete_beta(dof / 2, 0.5, dof / (dof + t * t));
}

WelchResult welch_test(MeanPicture const& a, MeanPicture const& b, int tile_size) {
    for (Image const* i : {&a.variance_of_mean, &b.mean, &b.variance_of_mean})
        if (i->width() != a.mean.width() || i->height() != a.mean.height() ||
            i->channels() != a.mean.channels() || i->empty())
            throw Error(ErrorKind::Input,
                        "compare: means and variances differ in shape; compare images of one shape");
    if (tile_size < 1) throw Error(ErrorKind::Input, "compare: a tile has at least one pixel a side");
    int const width = a.mean.width(), height = a.mean.height(), channels = a.mean.channels();
    WelchResult result;
    result.tiles_x = (width - 1) / tile_size + 1;
    result.tiles_y = (height - 1) / tile_size + 1;
    for (int ty = 0; ty < result.tiles_y; ++ty)
        for (int tx = 0; tx < result.tiles_x; ++tx) {
            double smallest = 1;
            for (int c = 0; c < channels; ++c) {
                TileSum tile;
                for (int y = ty * tile_size; y < std::min(height, (ty + 1) * tile_size); ++y)
                    for (int x = tx * tile_size; x < std::min(width, (tx + 1) * tile_size); ++x) {
                        add(tile, a, 1, x, y, c);
                        add(tile, b, -1, x, y, c);
                    }
                smallest = std::min(smallest, p_value(tile));
            }
            result.p.push_back(sidak(smallest, channels));
        }
    result.smallest = *std::min_element(result.p.begin(), result.p.end());
    result.corrected = sidak(result.smallest, static_cast<double>(result.p.size()));
    return result;
}

}  // namespace nephroid
