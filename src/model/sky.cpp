#include "sky.h"

#include "spectrum/color.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

// Relative spectral distributions of the daylight components S0, S1 and S2 (Judd, MacAdam & Wyszecki 1964; CIE 15, table T.2),
// 300 to 830 nm by 10 nm, linear between.
constexpr int kBasisFirst = 300, kBasisStep = 10, kBasisCount = 54;
constexpr float kBasis[3][kBasisCount] = {
    {0.04f,  6.0f,   29.6f,  55.3f,  57.3f,  61.8f,  61.5f,  68.8f,  63.4f,  65.8f,  94.8f,
     104.8f, 105.9f, 96.8f,  113.9f, 125.6f, 125.5f, 121.3f, 121.3f, 113.5f, 113.1f, 110.8f,
     106.5f, 108.8f, 105.3f, 104.4f, 100.0f, 96.0f,  95.1f,  89.1f,  90.5f,  90.3f,  88.4f,
     84.0f,  85.1f,  81.9f,  82.6f,  84.9f,  81.3f,  71.9f,  74.3f,  76.4f,  63.3f,  71.7f,
     77.0f,  65.2f,  47.7f,  68.6f,  65.0f,  66.0f,  61.0f,  53.3f,  58.9f,  61.9f},
    {0.02f,  4.5f,   22.4f,  42.0f,  40.6f,  41.6f,  38.0f,  42.4f,  38.5f,  35.0f,  43.4f,
     46.3f,  43.9f,  37.1f,  36.7f,  35.9f,  32.6f,  27.9f,  24.3f,  20.1f,  16.2f,  13.2f,
     8.6f,   6.1f,   4.2f,   1.9f,   0.0f,   -1.6f,  -3.5f,  -3.5f,  -5.8f,  -7.2f,  -8.6f,
     -9.5f,  -10.9f, -10.7f, -12.0f, -14.0f, -13.6f, -12.0f, -13.3f, -12.9f, -10.6f, -11.6f,
     -12.2f, -10.2f, -7.8f,  -11.2f, -10.4f, -10.6f, -9.7f,  -8.3f,  -9.3f,  -9.8f},
    {0.0f,  2.0f,  4.0f,  8.5f,  7.8f,  6.7f,  5.3f,  6.1f,  3.0f,  1.2f,  -1.1f, -0.5f, -0.7f, -1.2f,
     -2.6f, -2.9f, -2.8f, -2.6f, -2.6f, -1.8f, -1.5f, -1.3f, -1.2f, -1.0f, -0.5f, -0.3f, 0.0f,  0.2f,
     0.5f,  2.1f,  3.2f,  4.1f,  4.7f,  5.1f,  6.7f,  7.3f,  8.6f,  9.8f,  10.2f, 8.3f,  9.6f,  8.5f,
     7.0f,  7.6f,  8.0f,  6.7f,  5.2f,  7.4f,  6.8f,  7.0f,  6.4f,  5.5f,  6.1f,  6.5f}};

// The paper's appendix, 380 to 750 nm by 10 nm: the sun's radiance above the atmosphere (W m^-2 sr^-1 nm^-1), and what ozone
// and water vapour absorb (1/cm; Iqbal 1983, "An Introduction to Solar Radiation"). Mixed gases absorb from 760 nm on, where
// the sun's table has ended; y-bar is below 1e-4 there.
constexpr int kSunFirst = 380, kSunStep = 10, kSunCount = 38;
constexpr double kSun[kSunCount] = {16559.0, 16233.7, 21127.5, 25888.2, 25829.1, 24232.3, 26760.5, 29658.3,
                                    30545.4, 30057.5, 30663.7, 28830.4, 28712.1, 27825.0, 27100.6, 27233.6,
                                    26361.3, 25503.8, 25060.2, 25311.6, 25355.9, 25134.2, 24631.5, 24173.2,
                                    23685.3, 23212.1, 22827.7, 22339.8, 21970.2, 21526.7, 21097.9, 20728.3,
                                    20240.4, 19870.8, 19427.2, 19072.4, 18628.9, 18259.2};
constexpr double kOzone[kSunCount] = {0,     0,     0,     0,     0,     0,     0,     0.003, 0.006, 0.009,
                                      0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120,
                                      0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048,
                                      0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};
constexpr int kWaterFirst = 31;  // 690 nm
constexpr double kWater[kSunCount - kWaterFirst] = {0.016, 0.024, 0.0125, 1.0, 0.87, 0.061, 0.001};

float perez(Sky::Distribution const& d, float cos_theta, float gamma, float cos_gamma) {
    return (1.0f + d.a * std::exp(d.b / cos_theta)) *
           (1.0f + d.c * std::exp(d.d * gamma) + d.e * cos_gamma * cos_gamma);
}

}  // namespace

Sky make_sky(float turbidity, Vec3 sun) {
    double const t = static_cast<double>(turbidity);
    double const theta = std::atan2(std::hypot(static_cast<double>(sun.x), static_cast<double>(sun.y)),
                                    static_cast<double>(sun.z));
    // Appendix A.2: the distributions' coefficients are linear in the turbidity, …
    struct Line {
        double slope, at_0;
    };
    constexpr Line lines[3][5] = {
        {{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}},
        {{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}},
        {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}}};
    // … the zenith's chromaticity quadratic in it and cubic in the sun's angle (rows: T^2, T, 1; columns: theta^3 … 1) …
    constexpr double chromaticity[2][3][4] = {{{0.00166, -0.00375, 0.00209, 0},
                                               {-0.02903, 0.06377, -0.03202, 0.00394},
                                               {0.11693, -0.21196, 0.06052, 0.25886}},
                                              {{0.00275, -0.00610, 0.00317, 0},
                                               {-0.04214, 0.08970, -0.04153, 0.00516},
                                               {0.15346, -0.26756, 0.06670, 0.26688}}};
    double zenith[3];
    for (int i = 0; i < 2; ++i) {
        double value = 0;
        for (auto const& row : chromaticity[i])
            value = value * t + ((row[0] * theta + row[1]) * theta + row[2]) * theta + row[3];
        zenith[i] = value;
    }
    // … and its luminance, kcd/m^2.
    double const chi = (4.0 / 9.0 - t / 120.0) * (kPiDouble - 2 * theta);
    zenith[2] = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;

    Sky sky;
    sky.sun = sun;
    for (std::size_t i = 0; i < 3; ++i) {
        auto const at = [&](int k) { return lines[i][k].slope * t + lines[i][k].at_0; };
        double const c = std::cos(theta);
        double const f =
            (1 + at(0) * std::exp(at(1))) * (1 + at(2) * std::exp(at(3) * theta) + at(4) * c * c);
        sky.x_y_luminance[i] = {static_cast<float>(at(0)), static_cast<float>(at(1)),
                                static_cast<float>(at(2)), static_cast<float>(at(3)),
                                static_cast<float>(at(4)), static_cast<float>(zenith[i] / f)};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        TabulatedSpd basis;
        for (int k = 0; k < kBasisCount; ++k) {
            basis.lambda.push_back(static_cast<float>(kBasisFirst + kBasisStep * k));
            basis.value.push_back(kBasis[i][k]);
        }
        sky.basis_luminance[i] = static_cast<float>(photometric(basis));
    }
    return sky;
}

Vec3 sky_color(Sky const& sky, Vec3 w) {
    if (!(w.z > 0.0f)) return {kD65White.x, kD65White.y, 0.0f};
    float const gamma = angle_between(w, sky.sun);
    float const cos_gamma = std::cos(gamma);
    Vec3 color;
    for (int i = 0; i < 3; ++i) {
        auto const& d = sky.x_y_luminance[static_cast<std::size_t>(i)];
        color[i] = d.zenith * perez(d, w.z, gamma, cos_gamma);
    }
    return color;
}

std::array<float, 2> daylight_weights(float x, float y) {
    float const m = 0.0241f + 0.2562f * x - 0.7341f * y;
    return {(-1.3515f - 1.7703f * x + 5.9114f * y) / m, (0.0300f - 31.4424f * x + 30.0717f * y) / m};
}

Spectrum sky_radiance(Sky const& sky, Vec3 w, Wavelengths const& lambda) {
    if (!(w.z > 0.0f)) return {};
    Vec3 const c = sky_color(sky, w);
    if (lambda.is_rgb()) {
        Vec3 const rgb = max(xyz_to_srgb(Vec3{c.x, c.y, 1.0f - c.x - c.y} * (c.z / c.y)), Vec3{0.0f});
        return {rgb.x, rgb.y, rgb.z, 0.0f};
    }
    auto const [m1, m2] = daylight_weights(c.x, c.y);
    auto const& b = sky.basis_luminance;
    float const per_luminance = c.z / (b[0] + m1 * b[1] + m2 * b[2]);
    Spectrum result;
    for (int i = 0; i < 4; ++i) {
        float const at = (lambda.lambda(i) - kBasisFirst) * (1.0f / kBasisStep);
        int const k = std::min(static_cast<int>(at), kBasisCount - 2);
        float const t = at - static_cast<float>(k);
        auto const value = [&](int row) { return lerp(t, kBasis[row][k], kBasis[row][k + 1]); };
        result.set(i, max(0.0f, (value(0) + m1 * value(1) + m2 * value(2)) * per_luminance));
    }
    return result;
}

TabulatedSpd sun_spectrum(float turbidity, float cos_zenith) {
    // Appendix A.1. Optical mass relative to the zenith's, by the angle in degrees (Kasten 1965):
    double const cosine = std::clamp(static_cast<double>(cos_zenith), 0.0, 1.0);
    double const degrees = std::acos(cosine) * 180 / kPiDouble;
    double const mass = 1 / (cosine + 0.15 * std::pow(93.885 - degrees, -1.253));
    // Angstrom's turbidity (fitted to the turbidity as the paper has it), and his exponent for particles' sizes.
    double const beta = 0.04608365822050 * static_cast<double>(turbidity) - 0.04586025928522;
    constexpr double alpha = 1.3;
    constexpr double ozone_cm = 0.35, water_cm = 2;
    TabulatedSpd spd;
    for (int i = 0; i < kSunCount; ++i) {
        double const nm = kSunFirst + kSunStep * i;
        double const um = nm / 1000;
        double const water = i < kWaterFirst ? 0 : kWater[i - kWaterFirst] * water_cm * mass;
        double const depth = 0.008735 * std::pow(um, -4.08) * mass + beta * std::pow(um, -alpha) * mass +
                             kOzone[i] * ozone_cm * mass + 0.2385 * water / std::pow(1 + 20.07 * water, 0.45);
        spd.lambda.push_back(static_cast<float>(nm));
        spd.value.push_back(static_cast<float>(kSun[i] * std::exp(-depth)));
    }
    return spd;
}

}  // namespace nephroid
