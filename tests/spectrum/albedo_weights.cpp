// Colours of tabulated reflectances as sums of weights.
#include "spectrum/albedo_weights.h"

#include "spectrum/runtime.h"
#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;

TEST_CASE("the weights of a table make the colour that compiling it makes") {
    std::vector<float> const nodes{350, 400, 437.5f, 500, 560, 570, 700, 900};
    auto const w = albedo_to_srgb_weights(nodes);
    REQUIRE(w.size() == nodes.size());
    Vec3 white{0, 0, 0};
    for (Vec3 const& x : w) white += x;
    for (int i = 0; i < 3; ++i) CHECK(white[i] == doctest::Approx(1).epsilon(1e-5));
    test::Random r(1);
    for (int k = 0; k < 20; ++k) {
        TabulatedSpd spd;
        spd.lambda = nodes;
        Vec3 sum{0, 0, 0};
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            spd.value.push_back(static_cast<float>(r.uniform(0.4, 0.6)));  // within sRGB
            sum += spd.value.back() * w[i];
        }
        SpectrumStore store;
        Vec3 const rgb = store.compile(spd, SpectrumRole::Albedo).rgb();
        for (int i = 0; i < 3; ++i) CHECK(sum[i] == doctest::Approx(rgb[i]).epsilon(1e-4));
    }
    // One node is a constant.
    CHECK(albedo_to_srgb_weights(std::vector<float>{500})[0].y == doctest::Approx(1).epsilon(1e-5));
}
