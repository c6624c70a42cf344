// Filters: drawn by |f|, weights that average 1, and negative lobes that reproduce the exact integral.
#include "model/filter.h"

#include "support.h"

#include <doctest/doctest.h>

#include <map>

using namespace nephroid;
using namespace nephroid::test;

namespace {

std::vector<std::pair<char const*, Filter>> filters() {
    return {{"box", BoxFilter{}},
            {"wide box", BoxFilter{{1.5f, 0.75f}}},
            {"triangle", TriangleFilter{{2, 1}}},
            {"gaussian", GaussianFilter{}},
            {"wide gaussian", GaussianFilter{{3, 2}, 1}},
            {"mitchell", MitchellFilter{}},
            {"sharp mitchell", MitchellFilter{{2, 3}, 0, 0.75f}},
            {"sinc", LanczosSincFilter{}}};
}

/// Integral of g(x, y) f(x, y) over the filter's square, by the midpoint rule in double.
double quadrature(Filter const& f, std::function<double(double, double)> const& g, int n = 600) {
    Vec2 const r = radius(f);
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            double const x = static_cast<double>(r.x) * (2 * (i + 0.5) / n - 1);
            double const y = static_cast<double>(r.y) * (2 * (j + 0.5) / n - 1);
            sum += g(x, y) * static_cast<double>(evaluate(f, {static_cast<float>(x), static_cast<float>(y)}));
        }
    return sum * 4 * static_cast<double>(r.x) * static_cast<double>(r.y) / (static_cast<double>(n) * n);
}

}  // namespace

TEST_CASE("filters by hand") {
    CHECK(evaluate(BoxFilter{}, {0.4f, -0.4f}) == 1);
    CHECK(evaluate(BoxFilter{}, {0.6f, 0}) == 0);
    CHECK(evaluate(TriangleFilter{{2, 2}}, {0.5f, 1}) == doctest::Approx(1.5));
    CHECK(evaluate(TriangleFilter{{2, 2}}, {2.5f, 0}) == 0);
    double const edge = std::exp(-4.5);
    CHECK(evaluate(GaussianFilter{}, {0.5f, 0}) == doctest::Approx((std::exp(-0.5) - edge) * (1 - edge)));
    CHECK(evaluate(GaussianFilter{}, {1.6f, 0}) == 0);
    // B = C = 1/3: 8/9 at the centre, 1/18 at one (half of radius 2), 0 at the edge.
    CHECK(evaluate(MitchellFilter{}, {0, 0}) == doctest::Approx(64.0 / 81));
    CHECK(evaluate(MitchellFilter{}, {1, 0}) == doctest::Approx(8.0 / 9 / 18));
    CHECK(evaluate(MitchellFilter{}, {1.5f, 0}) < 0);
    CHECK(std::abs(evaluate(MitchellFilter{}, {2, 0})) < 1e-6f);
    CHECK(evaluate(LanczosSincFilter{}, {0, 0}) == 1);
    CHECK(evaluate(LanczosSincFilter{}, {1, 0}) == doctest::Approx(0).epsilon(1e-6));
    double const x = kPiD * 1.5;
    CHECK(evaluate(LanczosSincFilter{}, {1.5f, 0}) ==
          doctest::Approx(std::sin(x) / x * std::sin(x / 3) / (x / 3)));
    CHECK(evaluate(LanczosSincFilter{}, {4.5f, 0}) == 0);
}

TEST_CASE("filter samples: density |f|, weights f / pdf of mean 1, within the radius") {
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(2 * static_cast<int>(filters().size()));
    for (auto const& [name, filter] : filters()) {
        CAPTURE(name);
        FilterSampler const sampler(filter);
        Vec2 const r = radius(filter);
        double const integral = quadrature(filter, [](double, double) { return 1; });
        CHECK(sampler.integral() == doctest::Approx(integral).epsilon(2e-3));
        constexpr int k = 40;
        std::vector<double> o(k * k), by_pdf(k * k), by_f(k * k);
        Random random(1);
        Mean weights;
        float const peak = evaluate(filter, {0, 0});
        int mismatched = 0;
        for (int i = 0; i < n; ++i) {
            FilterSample const s = sampler.sample(random_square(random));
            REQUIRE((std::abs(s.offset.x) <= r.x && std::abs(s.offset.y) <= r.y));
            float const density = sampler.pdf(s.offset);
            REQUIRE(density > 0);
            // weight = f / (pdf * integral), with an f that is linear across each of 64 cells a pixel.
            float const f = evaluate(filter, s.offset);
            mismatched += !(std::abs(s.weight * density * sampler.integral() - f) <= 5e-4f * peak);
            weights.add(static_cast<double>(s.weight));
            auto const cell = [](float x, float radius_) {
                return std::clamp(static_cast<int>((x / radius_ + 1) / 2 * k), 0, k - 1);
            };
            ++o[static_cast<std::size_t>(cell(s.offset.y, r.y) * k + cell(s.offset.x, r.x))];
        }
        // An offset rounded into the cell next door has that one's density: one in ulp(4) / cell = 30,000.
        CHECK(mismatched <= n / 15'000);
        auto const mean = agrees(weights, 1, 0.02, alpha);
        INFO("weights ", mean);
        CHECK(mean);
        double total = 0;
        for (int y = 0; y < k; ++y)
            for (int x = 0; x < k; ++x)
                for (int b = 0; b < 16; ++b)
                    for (int a = 0; a < 16; ++a) {
                        Vec2 const p{r.x * static_cast<float>(2 * (x + (a + 0.5) / 16) / k - 1),
                                     r.y * static_cast<float>(2 * (y + (b + 0.5) / 16) / k - 1)};
                        auto const i = static_cast<std::size_t>(y * k + x);
                        double const element = 4.0 * static_cast<double>(r.x * r.y) / (k * k * 256);
                        by_pdf[i] += n * static_cast<double>(sampler.pdf(p)) * element;
                        by_f[i] += std::abs(static_cast<double>(evaluate(filter, p)));
                        total += std::abs(static_cast<double>(evaluate(filter, p)));
                    }
        auto const c = chi_square(o, by_pdf);
        INFO("by pdf ", c);
        CHECK(c.p >= alpha);
        for (double& e : by_f) e *= n / total;
        auto const d = chi_square(o, by_f);
        INFO("by |f| ", d);
        CHECK(d.p >= alpha);
        CHECK(sampler.pdf({r.x * 1.01f, 0}) == 0);
        for (float const x : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
            for (float const y : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f}) {
                FilterSample const s = sampler.sample({x, y});
                CHECK(
                    (std::abs(s.offset.x) <= r.x && std::abs(s.offset.y) <= r.y && std::isfinite(s.weight)));
            }
    }
}

TEST_CASE("filtered values of a polynomial are exact, negative lobes included") {
    // Means over stratified samples in independent batches; the value is the quadrature of g f / f.
    auto const g = [](double x, double y) { return 2 + 0.5 * x + 0.7 * x * x - 0.3 * y * y + 0.2 * x * y; };
    double const alpha = sidak(static_cast<int>(filters().size()));
    for (auto const& [name, filter] : filters()) {
        CAPTURE(name);
        FilterSampler const sampler(filter);
        double const exact = quadrature(filter, g) / quadrature(filter, [](double, double) { return 1; });
        Random r(2);
        Mean mean;
        for (int batch = 0; batch < 64; ++batch) {
            double sum = 0;
            int const side = 96;
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i) {
                    FilterSample const s = sampler.sample({(static_cast<float>(i) + r.unit()) / side,
                                                           (static_cast<float>(j) + r.unit()) / side});
                    sum += static_cast<double>(s.weight) *
                           g(static_cast<double>(s.offset.x), static_cast<double>(s.offset.y));
                }
            mean.add(sum / (side * side));
        }
        auto const a = agrees(mean, exact, 0.005, alpha);
        INFO(a);
        CHECK(a);
    }
}

TEST_CASE("a pixel chosen for a place on the film: all pixels get their filter's value there") {
    Random r(8);
    for (auto const& [name, filter] : filters()) {
        CAPTURE(name);
        FilterSampler const sampler(filter);
        Vec2 const reach = radius(filter);
        for (int i = 0; i < 20; ++i) {
            Vec2 const at{10 + r.unit(), 20 + r.unit()};
            // Numbers on a fine grid: what each pixel gets on average.
            constexpr int kSide = 256;
            std::map<std::pair<int, int>, double> got;
            for (int k = 0; k < kSide * kSide; ++k) {
                Vec2 const u{(static_cast<float>(k % kSide) + 0.5f) / kSide,
                             (static_cast<float>(k / kSide) + 0.5f) / kSide};
                FilterPixel const p = sampler.choose_pixel(at, u);
                got[{p.pixel.x, p.pixel.y}] += static_cast<double>(p.weight) / (kSide * kSide);
            }
            for (int y = 10; y < 31; ++y)
                for (int x = 0; x < 21; ++x) {
                    Vec2 const offset{static_cast<float>(x) + 0.5f - at.x,
                                      static_cast<float>(y) + 0.5f - at.y};
                    bool const inside = std::abs(offset.x) <= reach.x && std::abs(offset.y) <= reach.y;
                    double const expected =
                        inside ? static_cast<double>(evaluate(filter, offset) / sampler.integral()) : 0;
                    REQUIRE(got[{x, y}] == doctest::Approx(expected).epsilon(0.02));
                }
        }
    }
    // The pixels look at less than the film: what falls between them counts for none.
    FilterSampler const narrow(BoxFilter{{0.25f, 0.25f}});
    CHECK(narrow.choose_pixel({10.1f, 10.5f}, {0.5f, 0.5f}).weight == 0);
    CHECK(narrow.choose_pixel({10.4f, 10.5f}, {0.5f, 0.5f}).weight == doctest::Approx(4));
    for (float const u : {0.0f, 0x1p-32f, 1 - 0x1p-24f})
        CHECK(FilterSampler(MitchellFilter{}).choose_pixel({3.3f, 4.4f}, {u, u}).weight != 0);
}
