#include "spectrum/color.h"

#include "cie.h"
#include "dense.h"

#include <cmath>

namespace nephroid {

namespace {

Matrix3 inverted(Matrix3 const& m) {
    auto const c = [&](std::size_t i, std::size_t j) {
        std::size_t const i1 = (i + 1) % 3;
        std::size_t const i2 = (i + 2) % 3;
        std::size_t const j1 = (j + 1) % 3;
        std::size_t const j2 = (j + 2) % 3;
        return m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    };
    double const det = m[0][0] * c(0, 0) + m[0][1] * c(0, 1) + m[0][2] * c(0, 2);
    Matrix3 r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r[i][j] = c(j, i) / det;
    return r;
}

std::array<double, 3> xyz_of(Vec2 xy) {
    double const x = static_cast<double>(xy.x);
    double const y = static_cast<double>(xy.y);
    return {x / y, 1, (1 - x - y) / y};
}

std::array<double, 3> times(Matrix3 const& m, std::array<double, 3> const& v) {
    std::array<double, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return r;
}

/// Linear sRGB matching functions at each nm.
struct RgbObserver {
    DenseTable r, g, b;
};
RgbObserver const& rgb_observer() {
    static RgbObserver const observer = [] {
        RgbObserver o;
        Matrix3 const m = xyz_to_rgb(kSrgb);
        Observer const& c = cie_1931();
        for (std::size_t i = 0; i < kDenseCount; ++i) {
            auto const rgb = times(m, {c.x[i], c.y[i], c.z[i]});
            o.r[i] = static_cast<float>(rgb[0]);
            o.g[i] = static_cast<float>(rgb[1]);
            o.b[i] = static_cast<float>(rgb[2]);
        }
        return o;
    }();
    return observer;
}

}  // namespace

Vec3 operator*(Matrix3 const& m, Vec3 v) {
    auto const r = times(m, {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    return {static_cast<float>(r[0]), static_cast<float>(r[1]), static_cast<float>(r[2])};
}
Matrix3 operator*(Matrix3 const& a, Matrix3 const& b) {
    Matrix3 r{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
    return r;
}

Matrix3 rgb_to_xyz(RgbColorSpace const& s) {
    Matrix3 primaries;
    std::array<std::array<double, 3>, 3> const columns{xyz_of(s.r), xyz_of(s.g), xyz_of(s.b)};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) primaries[i][j] = columns[j][i];
    auto const amounts = times(inverted(primaries), xyz_of(s.w));
    for (auto& row : primaries)
        for (std::size_t j = 0; j < 3; ++j) row[j] *= amounts[j];
    return primaries;
}
Matrix3 xyz_to_rgb(RgbColorSpace const& s) { return inverted(rgb_to_xyz(s)); }

Vec3 xyz_to_srgb(Vec3 xyz) {
    static Matrix3 const m = xyz_to_rgb(kSrgb);
    return m * xyz;
}
Vec3 srgb_to_xyz(Vec3 rgb) {
    static Matrix3 const m = rgb_to_xyz(kSrgb);
    return m * rgb;
}

Matrix3 white_balance(Vec2 from, Vec2 to) {
    // Bradford's cone responses.
    static constexpr Matrix3 cones{
        {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
    auto const f = times(cones, xyz_of(from));
    auto const t = times(cones, xyz_of(to));
    Matrix3 const gain{{{t[0] / f[0], 0, 0}, {0, t[1] / f[1], 0}, {0, 0, t[2] / f[2]}}};
    return inverted(cones) * (gain * cones);
}

Vec3 convert_rgb(Vec3 rgb, RgbColorSpace const& from, RgbColorSpace const& to) {
    Matrix3 m = rgb_to_xyz(from);
    if (from.w != to.w) m = white_balance(from.w, to.w) * m;
    return (xyz_to_rgb(to) * m) * rgb;
}

Vec2 daylight_xy(float kelvin) {
    double const t = static_cast<double>(kelvin) * 1.4388 / 1.4380;
    if (t < 4000) {
        std::array<double, 3> xyz{};
        Observer const& o = cie_1931();
        Dense const body = dense_values(BlackbodySpd{static_cast<float>(t)});
        for (std::size_t i = 0; i < body.size(); ++i)
            xyz[0] += body[i] * o.x[i], xyz[1] += body[i] * o.y[i], xyz[2] += body[i] * o.z[i];
        double const sum = xyz[0] + xyz[1] + xyz[2];
        return {static_cast<float>(xyz[0] / sum), static_cast<float>(xyz[1] / sum)};
    }
    double const x = t <= 7000 ? -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + 0.09911e3 / t + 0.244063
                               : -2.0064e9 / (t * t * t) + 1.9018e6 / (t * t) + 0.24748e3 / t + 0.237040;
    double const y = -3 * x * x + 2.870 * x - 0.275;
    return {static_cast<float>(x), static_cast<float>(y)};
}

Vec3 spectral_to_linear_srgb(Spectrum radiance, Wavelengths const& lambda) {
    RgbObserver const& o = rgb_observer();
    Spectrum const weighed = lambda.weigh(radiance);  // 0, not 0/0, in lanes given up to the hero
    Vec3 sum{0, 0, 0};
    for (int i = 0; i < 4; ++i) {
        float const x = lambda.lambda(i) - kLambdaMin;
        int j = static_cast<int>(x);
        j = j < 0 ? 0 : (j > kDenseCount - 2 ? kDenseCount - 2 : j);
        float const t = x - static_cast<float>(j);
        auto const k = static_cast<std::size_t>(j);
        sum += weighed[i] *
               Vec3{lerp(t, o.r[k], o.r[k + 1]), lerp(t, o.g[k], o.g[k + 1]), lerp(t, o.b[k], o.b[k + 1])};
    }
    return sum * 0.25f;
}
Vec3 to_xyz(Spectrum radiance, Wavelengths const& lambda) {
    return srgb_to_xyz(to_linear_srgb(radiance, lambda));
}

}  // namespace nephroid
