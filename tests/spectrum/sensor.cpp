#include "spectrum/sensor.h"

#include "quadrature.h"
#include "spectrum/runtime.h"

#include <doctest/doctest.h>

using namespace nephroid;

TEST_CASE("sensor: exposure scales") {
    auto const w = Wavelengths::spectral(0.4f);
    Spectrum const light{1, 2, 3, 4};
    CHECK(max_component(abs(sensor_rgb(Sensor{}, light, w) - to_linear_srgb(light, w))) < 1e-4f);
    CHECK(max_component(abs(sensor_rgb(Sensor{2.5f}, light, w) - 2.5f * to_linear_srgb(light, w))) < 1e-3f);
}

TEST_CASE("sensor: white balance turns its daylight gray") {
    SpectrumStore store;
    struct {
        char const* name;
        float kelvin;
    } const cases[] = {{"stdillum-D65", 6500}, {"stdillum-A", 2854.4f}};
    for (auto const& c : cases) {
        auto const light = store.compile(NamedSpd{c.name}, SpectrumRole::Illuminant)
                               .scaled(static_cast<float>(1 / photometric(NamedSpd{c.name})));
        Sensor const sensor(1, c.kelvin);
        CAPTURE(std::string(c.name));
        Vec3 const spectral =
            mean_over_wavelengths([&](auto const& w) { return sensor(light.sample(w), w); });
        Vec3 const rgb = sensor(light.sample(Wavelengths::rgb()), Wavelengths::rgb());
        for (int i = 0; i < 3; ++i) {
            CHECK(spectral[i] == doctest::Approx(1).epsilon(0.01));
            CHECK(rgb[i] == doctest::Approx(1).epsilon(0.01));
        }
    }
}

TEST_CASE("sensor: names") {
    CHECK(is_known_sensor_name("cie1931"));
    CHECK(is_known_sensor_name("nikon_d850"));
    CHECK(!is_known_sensor_name("box brownie"));
}
