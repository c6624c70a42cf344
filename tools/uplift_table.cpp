// Computes the coefficients of Jakob & Hanika 2019 for linear sRGB: for every node of the table, the polynomial whose sigmoid
// has that colour under D65. Gauss-Newton in double, residual in CIELAB, started from the neighbour's solution.
//
//   uplift_table OUT.bin
#include "../src/spectrum/cie.h"
#include "../src/spectrum/uplift_format.h"
#include "spectrum/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

using namespace nephroid;
using V3 = std::array<double, 3>;

constexpr int kStep = 5;         // nm between samples of a reflectance
constexpr double kLimit = 1000;  // of coefficients
constexpr int kSamples = (kDenseCount - 1) / kStep + 1;

/// Weights that turn a reflectance at the sampled wavelengths into linear sRGB under D65.
struct Quadrature {
    std::array<double, kSamples> t{};  // wavelength scaled to [0, 1]
    std::array<V3, kSamples> rgb{};
};

Quadrature make_quadrature() {
    Quadrature q;
    Observer const& o = cie_1931();
    Dense const& d65 = illuminant_d65();
    Matrix3 const m = xyz_to_rgb(kSrgb);
    // Weights of the sum over each nm of a reflectance that is cubic between samples (Lagrange, the four nearest).
    std::array<V3, kSamples> xyz{};
    V3 white{};
    for (int i = 0; i < kDenseCount; ++i) {
        auto const n = static_cast<std::size_t>(i);
        V3 const v{o.x[n] * d65[n], o.y[n] * d65[n], o.z[n] * d65[n]};
        int const first = std::clamp(i / kStep - 1, 0, kSamples - 4);
        double const x = static_cast<double>(i) / kStep - first;
        for (int j = 0; j < 4; ++j) {
            double f = 1;
            for (int k = 0; k < 4; ++k)
                if (k != j) f *= (x - k) / (j - k);
            for (std::size_t c = 0; c < 3; ++c) xyz[static_cast<std::size_t>(first + j)][c] += f * v[c];
        }
        for (std::size_t c = 0; c < 3; ++c) white[c] += v[c];
    }
    for (int k = 0; k < kSamples; ++k) {
        auto const n = static_cast<std::size_t>(k);
        q.t[n] = static_cast<double>(k) / (kSamples - 1);
        for (std::size_t c = 0; c < 3; ++c)
            q.rgb[n][c] = (m[c][0] * xyz[n][0] + m[c][1] * xyz[n][1] + m[c][2] * xyz[n][2]) / white[1];
    }
    return q;
}

using M3 = std::array<V3, 3>;  // of a Jacobian: [value][variable]
struct Point {
    V3 value{};
    M3 jacobian{};
};

/// The colour of a polynomial's sigmoid, and how it changes with the coefficients.
Point rgb_of(Quadrature const& q, V3 const& c) {
    Point p;
    for (std::size_t i = 0; i < kSamples; ++i) {
        double const t = q.t[i];
        double const x = (c[0] * t + c[1]) * t + c[2];
        double const inverse = 1 / std::sqrt(1 + x * x);
        double const s = 0.5 + 0.5 * x * inverse;
        double const slope = 0.5 * inverse * inverse * inverse;
        for (std::size_t k = 0; k < 3; ++k) {
            double const weight = q.rgb[i][k];
            double const change = weight * slope;
            p.value[k] += weight * s;
            p.jacobian[k][0] += change * t * t;
            p.jacobian[k][1] += change * t;
            p.jacobian[k][2] += change;
        }
    }
    return p;
}

/// CIELAB relative to the space's white, and its derivatives by whatever the rgb depends on.
Point lab_of(Point const& rgb) {
    static Matrix3 const m = rgb_to_xyz(kSrgb);
    Point f;  // of the compressed X, Y, Z
    for (std::size_t i = 0; i < 3; ++i) {
        double const white = m[i][0] + m[i][1] + m[i][2];
        double t = 0;
        for (std::size_t k = 0; k < 3; ++k) t += m[i][k] / white * rgb.value[k];
        constexpr double d = 6.0 / 29;
        bool const bright = t > d * d * d;
        double const root = std::cbrt(t);
        f.value[i] = bright ? root : t / (3 * d * d) + 4.0 / 29;
        double const slope = bright ? 1 / (3 * root * root) : 1 / (3 * d * d);
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 3; ++j)
                f.jacobian[i][j] += slope * m[i][k] / white * rgb.jacobian[k][j];
    }
    auto const lab = [](double x, double y, double z, double offset) {
        return V3{116 * y - offset, 500 * (x - y), 200 * (y - z)};
    };
    Point p;
    p.value = lab(f.value[0], f.value[1], f.value[2], 16);
    for (std::size_t j = 0; j < 3; ++j) {
        V3 const column = lab(f.jacobian[0][j], f.jacobian[1][j], f.jacobian[2][j], 0);
        for (std::size_t i = 0; i < 3; ++i) p.jacobian[i][j] = column[i];
    }
    return p;
}

/// Solves the 3 x 3 system by Cramer's rule; false when it is singular.
bool solve(M3 const& a, V3 const& b, V3& x) {
    auto const det = [](V3 const& p, V3 const& q, V3 const& r) {
        return p[0] * (q[1] * r[2] - q[2] * r[1]) - q[0] * (p[1] * r[2] - p[2] * r[1]) +
               r[0] * (p[1] * q[2] - p[2] * q[1]);
    };
    // Columns.
    V3 const c0{a[0][0], a[1][0], a[2][0]};
    V3 const c1{a[0][1], a[1][1], a[2][1]};
    V3 const c2{a[0][2], a[1][2], a[2][2]};
    double const d = det(c0, c1, c2);
    if (std::abs(d) < 1e-30) return false;
    x = {det(b, c1, c2) / d, det(c0, b, c2) / d, det(c0, c1, b) / d};
    return true;
}

double squared(V3 const& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

void gauss_newton(Quadrature const& q, V3 const& rgb, V3& c) {
    V3 const target = lab_of(Point{rgb, {}}).value;
    auto const residual_at = [&](Point const& p) {
        return V3{target[0] - p.value[0], target[1] - p.value[1], target[2] - p.value[2]};
    };
    Point at = lab_of(rgb_of(q, c));
    double left = squared(residual_at(at));
    for (int iteration = 0; iteration < 30 && left > 1e-10; ++iteration) {
        V3 step{};
        if (!solve(at.jacobian, residual_at(at), step)) return;
        // Full steps overshoot where the sigmoid saturates: halve until it helps.
        bool improved = false;
        for (double length = 1; length > 1e-3 && !improved; length /= 2) {
            V3 next = c;
            for (std::size_t i = 0; i < 3; ++i) next[i] += length * step[i];
            // Beyond this the sigmoid is a step, and more changes nothing.
            double const largest = std::max({std::abs(next[0]), std::abs(next[1]), std::abs(next[2])});
            if (largest > kLimit)
                for (double& v : next) v *= kLimit / largest;
            Point const there = lab_of(rgb_of(q, next));
            double const would_be_left = squared(residual_at(there));
            if (would_be_left < left) {
                c = next, at = there, left = would_be_left;
                improved = true;
            }
        }
        if (!improved) return;
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: uplift_table OUT.bin\n");
        return 2;
    }
    Quadrature const q = make_quadrature();
    std::vector<float> table(static_cast<std::size_t>(kUpliftEntries) * 3);
    for (int largest = 0; largest < 3; ++largest)
        for (int j = 0; j < kUpliftSize; ++j)
            for (int i = 0; i < kUpliftSize; ++i) {
                double const y = static_cast<double>(j) / (kUpliftSize - 1);
                double const x = static_cast<double>(i) / (kUpliftSize - 1);
                auto const run = [&](int first, int last, int step) {
                    V3 c{0, 0, 0};
                    for (int k = first; k != last + step; k += step) {
                        double const z = uplift_node(k);
                        V3 rgb{};
                        rgb[static_cast<std::size_t>(largest)] = z;
                        rgb[static_cast<std::size_t>((largest + 1) % 3)] = x * z;
                        rgb[static_cast<std::size_t>((largest + 2) % 3)] = y * z;
                        gauss_newton(q, rgb, c);
                        auto const at =
                            static_cast<std::size_t>(
                                ((largest * kUpliftSize + k) * kUpliftSize + j) * kUpliftSize + i) *
                            3;
                        for (std::size_t n = 0; n < 3; ++n) table[at + n] = static_cast<float>(c[n]);
                    }
                };
                // From a middling brightness, where the flat start is near, to both ends.
                int const start = kUpliftSize / 5;
                run(start, kUpliftSize - 1, 1);
                run(start, 0, -1);
            }
    std::FILE* const f = std::fopen(argv[1], "wb");
    if (!f || std::fwrite(table.data(), sizeof(float), table.size(), f) != table.size() ||
        std::fclose(f) != 0) {
        std::fprintf(stderr, "uplift_table: cannot write %s\n", argv[1]);
        return 4;
    }
    return 0;
}
