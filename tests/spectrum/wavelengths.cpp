#include "spectrum/wavelengths.h"

#include "quadrature.h"
#include "spectrum/runtime.h"

#include <doctest/doctest.h>

#include <vector>

using namespace nephroid;

TEST_CASE("wavelengths: the density integrates to 1 and inverts the sampling") {
    double integral = 0;
    for (int i = 0; i < 4700; ++i)
        integral += 0.1 * static_cast<double>(visible_wavelength_pdf(360.05f + 0.1f * static_cast<float>(i)));
    CHECK(integral == doctest::Approx(1).epsilon(1e-4));
    CHECK(visible_wavelength(0) == doctest::Approx(360).epsilon(1e-5));
    CHECK(visible_wavelength(kOneMinusEpsilon) == doctest::Approx(830).epsilon(1e-4));
    CHECK(visible_wavelength_pdf(359) == 0);
    CHECK(visible_wavelength_pdf(831) == 0);
    // d lambda / du = 1 / pdf
    for (float u = 0.01f; u < 0.99f; u += 0.01f) {
        float const slope = (visible_wavelength(u + 0.005f) - visible_wavelength(u - 0.005f)) / 0.01f;
        CHECK(slope * visible_wavelength_pdf(visible_wavelength(u)) == doctest::Approx(1).epsilon(0.03));
    }
}

TEST_CASE("wavelengths: the table is the function, and so is its slope") {
    double worst = 0;
    double worst_slope = 0;
    double before = 0;
    int const n = 1 << 16;
    for (int i = 0; i < n; ++i) {
        // In double, as the truth; both ends are among the points.
        double const u = static_cast<double>(i) / n;
        double const exact = 538.0 - 138.888889 * std::atanh(0.85691062 - 1.82750197 * u);
        auto const table = static_cast<double>(kWavelengthTable(static_cast<float>(u)));
        worst = std::max(worst, std::abs(table - exact));
        // The density that goes with the samples: over 1/4096 of the range, where float roundings no longer count.
        if (i % 16 == 0) {
            if (i > 0) {
                double const middle = 0.85691062 - 1.82750197 * (u - 8.0 / n);
                double const slope = 138.888889 * 1.82750197 / (1 - middle * middle) * 16 / n;
                worst_slope = std::max(worst_slope, std::abs((table - before) / slope - 1));
            }
            before = table;
        }
    }
    CHECK(worst < 1e-3);
    CHECK(worst_slope < 2e-3);
    CHECK(kWavelengthTable(0) == doctest::Approx(360).epsilon(1e-5));
    CHECK(kWavelengthTable(kOneMinusEpsilon) == doctest::Approx(830).epsilon(1e-5));
}

TEST_CASE("wavelengths: chi-squared of the samples against the density") {
    int const n = 100000, bins = 47;
    std::vector<double> count(bins), expected(bins);
    Colors random;
    for (int i = 0; i < n; ++i) {
        auto const bin = static_cast<int>((kWavelengthTable(random.next()) - 360) / 10);
        count[static_cast<std::size_t>(std::min(bin, bins - 1))] += 1;
    }
    double chi2 = 0;
    for (int b = 0; b < bins; ++b) {
        auto const k = static_cast<std::size_t>(b);
        for (int i = 0; i < 100; ++i)
            expected[k] += n * 0.1 *
                           static_cast<double>(visible_wavelength_pdf(360 + 10 * static_cast<float>(b) +
                                                                      0.1f * (static_cast<float>(i) + 0.5f)));
        chi2 += sqr(count[k] - expected[k]) / expected[k];
    }
    // 46 degrees of freedom: above 90 once in 10,000.
    CHECK(chi2 < 90);
}

TEST_CASE("wavelengths: lanes are a quarter apart and weigh to the width of the range") {
    auto const w = Wavelengths::spectral(0.3f);
    CHECK(w.mode() == ColorMode::Spectral);
    CHECK(w.lambda(0) == doctest::Approx(visible_wavelength(0.3f)).epsilon(1e-6));
    CHECK(w.lambda(3) == doctest::Approx(visible_wavelength(0.05f)).epsilon(1e-5));
    for (int i = 0; i < 4; ++i)
        CHECK(w.pdf()[i] == doctest::Approx(visible_wavelength_pdf(w.lambda(i))).epsilon(1e-5));
    Vec3 const one =
        mean_over_wavelengths([](auto const& l) { return Vec3(l.weigh(Spectrum(1.0f)).average()); }, 20000);
    CHECK(one.x == doctest::Approx(470).epsilon(1e-3));
}

TEST_CASE("wavelengths: keeping the hero alone keeps the expectation") {
    SpectrumStore store;
    auto const light = store.compile(NamedSpd{"stdillum-A"}, SpectrumRole::Illuminant);
    auto const estimate = [&](bool hero) {
        // The hero takes each wavelength in turn: all of [0,1).
        double sum = 0;
        int const n = 8000;
        for (int i = 0; i < n; ++i) {
            auto w = Wavelengths::spectral((static_cast<float>(i) + 0.5f) / static_cast<float>(n));
            if (hero) w.keep_hero();
            Vec3 const rgb = to_linear_srgb(light.sample(w), w);
            REQUIRE(is_finite(rgb));
            sum += static_cast<double>(rgb.y) / n;
        }
        return sum;
    };
    CHECK(estimate(true) == doctest::Approx(estimate(false)).epsilon(1e-4));
    auto w = Wavelengths::spectral(0.7f);
    w.keep_hero();
    auto const once = w.pdf()[0];
    w.keep_hero();
    CHECK(w.hero_only());
    CHECK(w.pdf()[0] == once);
    // Lanes that were given up do not matter, whatever they hold.
    Vec3 const a = to_linear_srgb({1, 0, 0, 0}, w);
    CHECK(to_linear_srgb({1, 5, kInfinity, 7}, w) == a);
    auto rgb = Wavelengths::rgb();
    rgb.keep_hero();
    CHECK(!rgb.hero_only());
}

TEST_CASE("spectrum: lanes") {
    Spectrum const a{1, 2, 3, 4};
    CHECK((a * a).max() == 16);
    CHECK((a + Spectrum(1.0f)).average() == 3.5f);
    CHECK(clamp(a, 2, 3)[0] == 2);
    CHECK(sqrt(a * a)[2] == 3);
    CHECK(Spectrum().is_black());
    CHECK(!a.is_black());
    CHECK(a.is_finite());
    CHECK(!Spectrum(1, 2, kInfinity, 0).is_finite());
    CHECK(!(a / Spectrum(0.0f) * 0.0f).is_finite());
}
