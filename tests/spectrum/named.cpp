#include "spectrum/named.h"

#include "math/error.h"
#include "spectrum/runtime.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace nephroid;

namespace {

/// Reflectance at normal incidence, nm.
float reflectance(SpectrumStore& store, std::string const& metal, float lambda) {
    float const n = store.compile(NamedSpd{"metal-" + metal + "-eta"}, SpectrumRole::Unbounded).at(lambda);
    float const k = store.compile(NamedSpd{"metal-" + metal + "-k"}, SpectrumRole::Unbounded).at(lambda);
    return (sqr(n - 1) + k * k) / (sqr(n + 1) + k * k);
}

}  // namespace

TEST_CASE("named: all names are there, sorted, positive and reach all visible wavelengths") {
    auto const& names = named_spectrum_names();
    CHECK(std::is_sorted(names.begin(), names.end()));
    CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
    for (auto const& name : names) {
        CAPTURE(name);
        CHECK(is_named_spectrum(name));
        auto const t = named_spectrum(name);
        REQUIRE(t);
        CHECK(std::is_sorted(t->lambda.begin(), t->lambda.end(), std::less_equal<>{}));
        CHECK(t->lambda.front() <= 360);
        CHECK(t->lambda.back() >= 830);
        for (float v : t->value) CHECK(v >= 0);
        CHECK(interpolate(*t, 360) >= 0);
        CHECK(interpolate(*t, 250) == 0);
    }
    for (char const* name :
         {"metal-Ag-eta",   "metal-Al-k",   "metal-Au-eta", "metal-Cu-k",  "metal-CuZn-eta", "metal-MgO-k",
          "metal-TiO2-eta", "glass-BK7",    "glass-BAF10",  "glass-FK51A", "glass-LASF9",    "glass-F5",
          "glass-F10",      "glass-F11",    "glass-SF5",    "glass-SF10",  "glass-SF11",     "glass-N-BK7",
          "glass-N-SF10",   "glass-N-SF11", "glass-F2",     "stdillum-A",  "stdillum-D50",   "stdillum-D65",
          "stdillum-F1",    "stdillum-F12", "illum-acesD60"}) {
        CAPTURE(name);
        CHECK(is_named_spectrum(name));
    }
    CHECK(!is_named_spectrum("metal-Unobtainium-eta"));
    CHECK(!named_spectrum(""));
}

TEST_CASE("named: spot values") {
    CHECK(interpolate(*named_spectrum("stdillum-D65"), 560) == doctest::Approx(100));
    CHECK(interpolate(*named_spectrum("glass-F11"), 370) == doctest::Approx(1.87002));
    CHECK(named_spectrum("glass-SF11")->value == named_spectrum("glass-F11")->value);
    CHECK(interpolate(*named_spectrum("metal-Ag-k"), 855.063) == doctest::Approx(5.72062));
    // Constant where the measurement ends: F lamps stop at 780 nm.
    CHECK(interpolate(*named_spectrum("stdillum-F2"), 820) == doctest::Approx(0.27));
}

TEST_CASE("named: Sellmeier glasses") {
    struct {
        char const* glass;
        double lambda, n;
    } const cases[] = {{"glass-N-BK7", 400.00, 1.530848538},   {"glass-N-BK7", 486.1327, 1.52237629},
                       {"glass-N-BK7", 550.00, 1.518522388},   {"glass-N-BK7", 587.5618, 1.516800035},
                       {"glass-N-BK7", 656.2725, 1.514322347}, {"glass-N-BK7", 700.00, 1.513063997},
                       {"glass-N-SF11", 400.00, 1.845422227},  {"glass-N-SF11", 587.5618, 1.784719942},
                       {"glass-N-SF11", 700.00, 1.771750895},  {"glass-F2", 400.00, 1.65215474},
                       {"glass-F2", 587.5618, 1.620040137},    {"glass-F2", 700.00, 1.612591693},
                       {"glass-N-SF10", 400.00, 1.778259755},  {"glass-N-SF10", 587.5618, 1.728277066},
                       {"glass-N-SF10", 700.00, 1.717353849}};
    SpectrumStore store;
    for (auto const& c : cases) {
        CAPTURE(std::string(c.glass));
        auto const glass = sellmeier_glass(c.glass);
        REQUIRE(glass);
        CHECK(glass->index(c.lambda) == doctest::Approx(c.n).epsilon(1e-9));
        // What the renderer samples is the 1 nm table, good to float rounding.
        auto const s = store.compile(NamedSpd{c.glass}, SpectrumRole::Unbounded);
        CHECK(s.at(static_cast<float>(c.lambda)) == doctest::Approx(c.n).epsilon(5e-7));
    }
    CHECK(!sellmeier_glass("glass-BK7"));
    // pbrt's measured BK7 is the same glass.
    CHECK(interpolate(*named_spectrum("glass-BK7"), 587.56) == doctest::Approx(1.5168).epsilon(2e-4));
}

TEST_CASE("named: metals have their colours") {
    SpectrumStore store;
    CHECK(reflectance(store, "Au", 650) > 0.93f);
    CHECK(reflectance(store, "Au", 450) < 0.5f);
    CHECK(reflectance(store, "Cu", 650) > 0.9f);
    CHECK(reflectance(store, "Cu", 500) < 0.7f);
    CHECK(reflectance(store, "CuZn", 600) > reflectance(store, "CuZn", 450) + 0.1f);
    for (float l : {450.0f, 550.0f, 650.0f}) {
        CHECK(reflectance(store, "Ag", l) > 0.91f);
        CHECK(reflectance(store, "Al", l) > 0.88f);
    }
}
