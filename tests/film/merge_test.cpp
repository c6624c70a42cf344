#include "random_film.h"

#include "math/error.h"

#include <doctest/doctest.h>

#include <limits>

using namespace nephroid;

namespace {

/// Every sum within a few roundings of its counterpart.
void close(Film const& a, Film const& b) {
    CHECK(a.passes() == b.passes());
    CHECK(a.dropped() == b.dropped());
    auto const near = [](double x, double y) { return std::abs(x - y) <= 1e-13 * (1 + std::abs(x)); };
    bool all = true;
    auto const [x0, x1, y0, y1] = a.crop();
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            PixelSums const &p = a.pixel(x, y), &q = b.pixel(x, y);
            all = all && near(p.weight, q.weight) && near(p.weight_square, q.weight_square) &&
                  p.samples == q.samples;
            for (std::size_t c = 0; c < 3; ++c)
                all = all && near(p.rgb[c], q.rgb[c]) && near(p.square[c], q.square[c]) &&
                      near(p.cross[c], q.cross[c]);
            AovSums const &s = a.aov(x, y), &t = b.aov(x, y);
            all = all && near(s.depth, t.depth) && near(s.hits, t.hits) && near(s.position[1], t.position[1]);
            all = all && s.material == t.material && s.material_pass == t.material_pass;
        }
    CHECK(all);
}

void refused(Film const& a, Film const& b, std::string const& why) {
    Film copy = a;
    try {
        merge_into(copy, b);
        FAIL_CHECK("merged: " << why);
    } catch (Error const& e) {
        CHECK(e.kind() == ErrorKind::Input);
        CHECK(std::string(e.what()).find(why) != std::string::npos);
    }
    CHECK(same_bits(copy, a));
}

}  // namespace

TEST_CASE("merging is commutative and associative to rounding") {
    Film const a = film_of({0, 5}), b = film_of({5, 6}), c = film_of({6, 13});
    CHECK(same_bits(merge(a, b), merge(b, a)));  // x + y = y + x holds for doubles, too
    close(merge(merge(a, b), c), merge(a, merge(b, c)));
    close(merge(merge(c, a), b), film_of({0, 13}));
}

TEST_CASE("merging is exact where the sums are") {
    Film const whole = film_of({0, 12}, true);
    CHECK(
        same_bits(merge(merge(film_of({8, 12}, true), film_of({0, 3}, true)), film_of({3, 8}, true)), whole));
    Film permuted = empty_film();
    for (std::uint64_t const i : {7u, 2u, 11u, 0u, 5u, 9u, 1u, 10u, 3u, 8u, 4u, 6u})
        render_test_pass(permuted, i, true);
    CHECK(same_bits(permuted, whole));
}

TEST_CASE("an empty film is neutral") {
    Film const a = film_of({0, 3});
    CHECK(same_bits(merge(Film{}, a), a));
    CHECK(same_bits(merge(a, Film{}), a));
    CHECK(same_bits(merge(a, empty_film()), a));
}

TEST_CASE("films of different renders and shared passes are refused, and nothing changes") {
    Film const a = film_of({0, 3});
    refused(a, film_of({2, 4}), "passes 2:3");
    refused(a, a, "passes 0:3");
    FilmIdentity scene = test_identity(), settings = test_identity(), seed = test_identity();
    scene.scene_hash = "other", settings.settings_hash = "other", seed.seed = 8;
    refused(a, Film({12, 9}, {2, 10, 1, 8}, true, scene), "different scenes");
    refused(a, Film({12, 9}, {2, 10, 1, 8}, true, settings), "different settings");
    refused(a, Film({12, 9}, {2, 10, 1, 8}, true, seed), "--seed is 7 in one and 8 in the other");
    refused(a, Film({12, 9}, {2, 9, 1, 8}, true, test_identity()), "--crop is 2,1,10,8 in one and 2,1,9,8");
    refused(a, Film({12, 10}, {2, 10, 1, 8}, true, test_identity()),
            "--size is 12x9 in one and 12x10 in the other");
    refused(a, empty_film(false), "--aovs is given in one and left out in the other");
}

TEST_CASE("a sample that is not finite counts as black, and is reported") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    Film film({1, 1}, {0, 1, 0, 1}, false, {});
    CHECK(film.add(0, 0, {1, 2, 3}, 1));
    for (Vec3 const bad : {Vec3(nan, 0, 0), Vec3(0, kInfinity, 0), Vec3(0, 0, -kInfinity)})
        CHECK(!film.add(0, 0, bad, 1));
    CHECK(film.pixel(0, 0).rgb == std::array<double, 3>{1, 2, 3});
    CHECK(film.pixel(0, 0).weight == 4);
    CHECK(film.pixel(0, 0).samples == 4);
    CHECK(!film.add(0, 0, {1, 1, 1}, nan));
    CHECK(!film.add(0, 0, {1, 1, 1}, kInfinity));
    CHECK(film.pixel(0, 0).weight == 4);
    CHECK(film.dropped() == 0);  // the caller's business
    // The largest floats do not overflow the sums.
    float const huge = std::numeric_limits<float>::max();
    for (int i = 0; i < 1000; ++i) CHECK(film.add(0, 0, {huge, -huge, huge}, huge));
    CHECK(std::isfinite(film.pixel(0, 0).square[0]));
}

TEST_CASE("settings that differ are named by the option that sets them") {
    FilmIdentity other = test_identity();
    other.settings_hash = "another";
    Film a = film_of({0, 3});
    Film b({12, 9}, {2, 10, 1, 8}, true, other);
    a.describe({{"--color", "rgb"}, {"--integrator", "path"}});
    b.describe({{"--color", "spectral"}, {"--integrator", "path"}});
    refused(a, b, "--color is rgb in one and spectral in the other");
    CHECK(difference(a.header(), a.header()).empty());
}

TEST_CASE("rays that were refused are counted, and taint a sum") {
    Film a = film_of({0, 1}), b = film_of({2, 3});
    CHECK_FALSE(a.tainted());
    b.add_rejected(3);
    merge_into(a, b);
    CHECK(a.rejected() == 3);
    CHECK(a.tainted());
}

TEST_CASE("impossible films are refused") {
    CHECK_THROWS_AS(Film({10, 10}, {0, 11, 0, 10}, false, {}), Error);
    CHECK_THROWS_AS(Film({10, 10}, {-1, 5, 0, 10}, false, {}), Error);
    CHECK_THROWS_AS(Film({10, 10}, {5, 5, 0, 10}, false, {}), Error);
    CHECK_THROWS_AS(Film({65536, 65536}, {0, 65536, 0, 65536}, false, {}), Error);
    CHECK(Film({4, 4}, {0, 4, 0, 4}, false, {}).bytes() == 16 * sizeof(PixelSums));
}
