#include "support.h"

#include "image/compare.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace nephroid;

namespace {

Image constant(int width, int height, Vec3 color) {
    Image image(PixelFormat::Float, width, height, {"R", "G", "B"});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, color[c]);
    return image;
}

}  // namespace

TEST_CASE("RMSE, relMSE, means and bins") {
    Image const a = constant(5, 3, {1, 2, 3}), b = constant(5, 3, {1, 2, 1});
    CHECK(rmse(a, a) == 0);
    CHECK(rmse(a, b) == doctest::Approx(std::sqrt(4.0 / 3)));
    CHECK(rel_mse(a, b) == doctest::Approx(4 / 1.01 / 3));
    CHECK(channel_means(a)[2] == doctest::Approx(3));
    Image ramp(PixelFormat::Float, 5, 1, {"Y"});
    ramp.floats() = {1, 3, 5, 7, 20};
    Image const bins = binned(ramp, 2);
    CHECK(bins.floats() == std::vector<float>{2, 6, 20});
    CHECK(test::error_of([&] { (void)rmse(a, ramp); }) == ErrorKind::Input);
    // alpha is no light
    Image c(PixelFormat::Float, 1, 1, {"Y", "A"}), d = c;
    d.set(0, 0, 1, 1.0f);
    CHECK(rmse(c, d) == 0);
}

TEST_CASE("FLIP: nothing for equals, the paper's maximum for black and white, symmetric") {
    Image const black = constant(40, 30, {0, 0, 0}), white = constant(40, 30, {1, 1, 1});
    CHECK(mean_flip(white, white) == 0);
    // Constants pass the filters unchanged: |L| = 100, so 0.95 + (100^0.7 - 0.4 c)/(0.6 c) 0.05 with c = 41.26 (green to
    // blue) is 0.967.
    CHECK(mean_flip(black, white) == doctest::Approx(0.967).epsilon(0.001));
    CHECK(mean_flip(constant(8, 8, {0, 1, 0}), constant(8, 8, {0, 0, 1})) ==
          doctest::Approx(1).epsilon(1e-6));
    Image const a = test::gradient(PixelFormat::Float, 40, 30, 3);
    CHECK(mean_flip(a, white) == doctest::Approx(mean_flip(white, a)));
    Image dot = black;
    dot.set(20, 15, 1, 1.0f);
    Image const error = flip(dot, black);
    CHECK(error.get(20, 15, 0) > error.get(24, 15, 0));
    CHECK(error.get(20, 15, 0) > 0.2f);
    CHECK(error.get(0, 0, 0) == 0.0f);
    // The same dot further away, more pixels to the degree, is seen less.
    CHECK(flip(dot, black, 200.0f).get(20, 15, 0) < flip(dot, black, 20.0f).get(20, 15, 0));
}

TEST_CASE("Student's t: quantiles from the tables") {
    CHECK(student_t_two_sided(12.7062, 1) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(student_t_two_sided(2.228139, 10) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(student_t_two_sided(-3.169273, 10) == doctest::Approx(0.01).epsilon(1e-4));
    CHECK(student_t_two_sided(1.983972, 100) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(student_t_two_sided(1.959964, 1e12) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(student_t_two_sided(1.959964, 9e6) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(student_t_two_sided(0, 5) == doctest::Approx(1));
    CHECK(student_t_two_sided(1, 1) == doctest::Approx(0.5));  // Cauchy
    double const far = student_t_two_sided(30, 9e6);           // deep tails keep their logarithm
    CHECK(std::log10(far) == doctest::Approx(-197.0).epsilon(0.001));
    CHECK(incomplete_beta(2, 3, 0.4) == doctest::Approx(0.5248));
    CHECK(incomplete_beta(0.5, 0.5, 0.25) == doctest::Approx(1.0 / 3));
    CHECK(incomplete_beta(1, 1, 0.3) == doctest::Approx(0.3));
}

TEST_CASE("Welch's test: the textbook case as a picture of one pixel") {
    // Two samples with means 20.6 and 22.1, variances 7.9 and 5.6 (n = 15, 12): t = -1.4980, dof = 24.9, p = 0.1468.
    Image ma(PixelFormat::Float, 1, 1, {"Y"}), mb = ma, va = ma, vb = ma;
    ma.set(0, 0, 0, 20.6f);
    mb.set(0, 0, 0, 22.1f);
    va.set(0, 0, 0, 7.9f / 15);
    vb.set(0, 0, 0, 5.6f / 12);
    double const v = 7.9 / 15 + 5.6 / 12;
    double const dof = v * v / (sqr(7.9 / 15) / 14 + sqr(5.6 / 12) / 11);
    WelchResult const r = welch_test({ma, va, 15}, {mb, vb, 12});
    CHECK(dof == doctest::Approx(24.9).epsilon(0.01));
    CHECK(r.smallest == doctest::Approx(student_t_two_sided(1.5 / std::sqrt(v), dof)).epsilon(1e-5));
    CHECK(r.smallest == doctest::Approx(0.1447).epsilon(0.02));
    CHECK(r.corrected == doctest::Approx(r.smallest));
}

TEST_CASE("Welch's test: noise alone passes, a biased tile is found, NaN never passes") {
    int const n = 64;
    Image a(PixelFormat::Float, n, n, {"Y"}), b = a, variance = a;
    std::uint32_t state = 7;
    auto uniform = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) * 0x1p-24f;
    };
    for (auto* image : {&a, &b})
        for (float& v : image->floats()) v = uniform();
    for (float& v : variance.floats()) v = 1.0f / 12.0f;  // of one uniform number
    WelchResult const same = welch_test({a, variance}, {b, variance});
    CHECK(same.tiles_x == 4);
    CHECK(same.p.size() == 16);
    CHECK(same.corrected > 0.01);
    for (int y = 16; y < 32; ++y)
        for (int x = 32; x < 48; ++x) b.set(x, y, 0, b.get(x, y, 0) + 0.2f);
    WelchResult const biased = welch_test({a, variance}, {b, variance});
    CHECK(biased.corrected < 1e-6);
    CHECK(biased.p[1 * 4 + 2] == biased.smallest);
    b.set(0, 0, 0, std::nanf(""));
    CHECK(welch_test({a, variance}, {b, variance}).p[0] == 0);
    for (float& v : variance.floats()) v = 0;
    CHECK(welch_test({a, variance}, {a, variance}).corrected == 1);
}
