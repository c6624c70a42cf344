// FLIP: A Difference Evaluator for Alternating Images (Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild,
// HPG 2020), for low dynamic range. Section numbers are the paper's. Borders are extended by their last pixel.
#include "image/compare.h"
#include "math/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {

namespace {

using Plane = std::vector<double>;
using Color = std::array<double, 3>;

struct Picture {
    int width = 0, height = 0;
    std::array<Plane, 3> planes;
    [[nodiscard]] std::size_t size() const { return planes[0].size(); }
    [[nodiscard]] Color at(std::size_t i) const { return {planes[0][i], planes[1][i], planes[2][i]}; }
    void set(std::size_t i, Color const& c) {
        for (std::size_t k = 0; k < 3; ++k) planes[k][i] = c[k];
    }
};

constexpr double kToXyz[3][3] = {{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                 {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                 {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};

Color multiply(double const (&m)[3][3], Color const& v) {
    Color out{};
    for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

Color white() {
    static Color const w = multiply(kToXyz, {1, 1, 1});
    return w;
}

Color to_linear_rgb(Color const& xyz) {
    static constexpr double kFromXyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                              {-0.969224334, 1.875930071, 0.041554224},
                                              {0.055639423, -0.204011202, 1.057148933}};
    return multiply(kFromXyz, xyz);
}

/// 3.2: the opponent space YCxCz of the contrast sensitivity functions.
Color to_ycxcz(Color const& rgb) {
    Color n = multiply(kToXyz, rgb);
    for (std::size_t k = 0; k < 3; ++k) n[k] /= white()[k];
    return {116 * n[1] - 16, 500 * (n[0] - n[1]), 200 * (n[1] - n[2])};
}
Color from_ycxcz(Color const& v) {
    double const y = (v[0] + 16) / 116;
    return to_linear_rgb({(y + v[1] / 500) * white()[0], y * white()[1], (y - v[2] / 200) * white()[2]});
}

/// 3.3: CIELAB with Hunt's effect: the same chroma difference counts less where it is dark.
Color to_hunt_lab(Color const& rgb) {
    auto f = [](double t) {
        constexpr double kDelta = 6.0 / 29.0;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
    };
    Color n = multiply(kToXyz, rgb);
    for (std::size_t k = 0; k < 3; ++k) n[k] = f(n[k] / white()[k]);
    double const lightness = 116 * n[1] - 16;
    return {lightness, 0.01 * lightness * 500 * (n[0] - n[1]), 0.01 * lightness * 200 * (n[1] - n[2])};
}

double hyab(Color const& a, Color const& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Convolution with across(x) down(y); both kernels have 2r+1 taps.
Plane convolve(Plane const& in, int width, int height, Plane const& across, Plane const& down) {
    auto pass = [&](Plane const& source, Plane const& kernel, bool horizontal) {
        Plane out(source.size());
        int const r = static_cast<int>(kernel.size() / 2);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                double sum = 0;
                for (int k = -r; k <= r; ++k) {
                    int const u = horizontal ? std::clamp(x + k, 0, width - 1) : x;
                    int const v = horizontal ? y : std::clamp(y + k, 0, height - 1);
                    sum += kernel[static_cast<std::size_t>(k + r)] *
                           source[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(u)];
                }
                out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)] = sum;
            }
        return out;
    };
    return pass(pass(in, across, true), down, false);
}

template <class F>
Plane make_kernel(int radius, F&& f) {
    Plane kernel;
    for (int k = -radius; k <= radius; ++k) kernel.push_back(f(static_cast<double>(k)));
    return kernel;
}

/// 3.2, table 1: each sensitivity is a sum of two Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees; the sum over
/// the whole kernel is one.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivities[3] = {
    {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

Plane filter_by_sensitivity(Plane const& in, int width, int height, Sensitivity const& s, double ppd) {
    int const radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * sqr(double{kPi}))) * ppd));
    constexpr double kPiSquared = 9.869604401089358;
    Plane out(in.size(), 0.0);
    double total = 0;
    for (auto const& [a, b] : {std::pair{s.a1, s.b1}, std::pair{s.a2, s.b2}}) {
        if (a == 0) continue;
        Plane const kernel =
            make_kernel(radius, [&, b = b](double k) { return std::exp(-kPiSquared * sqr(k / ppd) / b); });
        double sum = 0;
        for (double const k : kernel) sum += k;
        double const amplitude = a * std::sqrt(3.141592653589793 / b);
        total += amplitude * sum * sum;
        Plane const filtered = convolve(in, width, height, kernel, kernel);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += amplitude * filtered[i];
    }
    for (double& v : out) v /= total;
    return out;
}

Picture load(Image const& image) {
    Picture p;
    p.width = image.width();
    p.height = image.height();
    for (Plane& plane : p.planes)
        plane.resize(static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height));
    bool const color = image.channels() >= 3;
    std::size_t i = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x, ++i) {
            Color rgb{};
            for (int c = 0; c < 3; ++c) {
                float const v = image.get(x, y, color ? c : 0);
                rgb[static_cast<std::size_t>(c)] = v > 0.0f ? std::min(v, 1.0f) : 0.0f;
            }
            p.set(i, to_ycxcz(rgb));
        }
    return p;
}

/// What the eye sees at that distance, in Hunt-adjusted CIELAB.
Picture perceived(Picture const& opponent, double ppd) {
    Picture out = opponent;
    for (std::size_t k = 0; k < 3; ++k)
        out.planes[k] =
            filter_by_sensitivity(opponent.planes[k], out.width, out.height, kSensitivities[k], ppd);
    for (std::size_t i = 0; i < out.size(); ++i) {
        Color rgb = from_ycxcz(out.at(i));
        for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
        out.set(i, to_hunt_lab(rgb));
    }
    return out;
}

/// 3.3: large colour differences are compressed into [0.95, 1].
double color_error(Color const& a, Color const& b) {
    static double const largest = std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), 0.7);
    constexpr double kShare = 0.4, kTop = 0.95;
    double const e = std::pow(hyab(a, b), 0.7);
    double const knee = kShare * largest;
    return e < knee ? kTop * e / knee : std::min(1.0, kTop + (e - knee) / (largest - knee) * (1 - kTop));
}

struct Features {
    Plane edge, point;
};

/// 3.4: magnitudes of the first (edges) and second (points) Gaussian derivatives of lightness; the positive and the
/// negative weights of each kernel sum to one.
Features find_features(Picture const& opponent, double ppd) {
    double const sigma = 0.5 * 0.082 * ppd;
    int const radius = static_cast<int>(std::ceil(3 * sigma));
    auto gauss = [&](double k) { return std::exp(-sqr(k) / (2 * sqr(sigma))); };
    Plane blur = make_kernel(radius, gauss);
    double sum = 0;
    for (double const k : blur) sum += k;
    for (double& k : blur) k /= sum;
    auto balanced = [](Plane kernel) {
        double positive = 0, negative = 0;
        for (double const k : kernel) (k > 0 ? positive : negative) += std::abs(k);
        for (double& k : kernel) k /= k > 0 ? positive : std::max(negative, 1e-300);
        return kernel;
    };
    Plane const first = balanced(make_kernel(radius, [&](double k) { return -k * gauss(k); }));
    Plane const second =
        balanced(make_kernel(radius, [&](double k) { return (sqr(k / sigma) - 1) * gauss(k); }));
    Plane lightness = opponent.planes[0];
    for (double& v : lightness) v = (v + 16) / 116;
    auto magnitude = [&](Plane const& kernel) {
        Plane x = convolve(lightness, opponent.width, opponent.height, kernel, blur);
        Plane const y = convolve(lightness, opponent.width, opponent.height, blur, kernel);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
        return x;
    };
    return {magnitude(first), magnitude(second)};
}

}  // namespace

Image flip(Image const& test, Image const& reference, float pixels_per_degree) {
    if (test.empty() || test.width() != reference.width() || test.height() != reference.height())
        throw Error(ErrorKind::Input, "FLIP: the images differ in size; compare images of one size");
    if (!(pixels_per_degree >= 1.0f && pixels_per_degree <= 1000.0f))
        throw Error(ErrorKind::Input, "FLIP: pixels per degree must lie between 1 and 1000; 67 is usual");
    double const ppd = pixels_per_degree;
    Picture const a = load(test), b = load(reference);
    Picture const seen_a = perceived(a, ppd), seen_b = perceived(b, ppd);
    Features const features_a = find_features(a, ppd), features_b = find_features(b, ppd);
    Image result(PixelFormat::Float, test.width(), test.height(), {"Y"});
    for (std::size_t i = 0; i < a.size(); ++i) {
        double const edge = std::abs(features_a.edge[i] - features_b.edge[i]);
        double const point = std::abs(features_a.point[i] - features_b.point[i]);
        double const feature_error = std::sqrt(std::min(1.0, std::max(edge, point) / std::sqrt(2.0)));
        // 3.5: a feature that differs amplifies the colour difference.
        result.floats()[i] =
            static_cast<float>(std::pow(color_error(seen_a.at(i), seen_b.at(i)), 1 - feature_error));
    }
    return result;
}

double mean_flip(Image const& test, Image const& reference, float pixels_per_degree) {
    return channel_means(flip(test, reference, pixels_per_degree))[0];
}

}  // namespace nephroid
