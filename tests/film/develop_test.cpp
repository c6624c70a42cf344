#include "film/develop.h"

#include "image/read.h"
#include "math/error.h"
#include "random_film.h"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>

using namespace nephroid;

namespace {

struct Sample {
    Vec3 v;
    float w;
};

Film pixel_of(std::vector<Sample> const& samples) {
    Film film({1, 1}, {0, 1, 0, 1}, true, test_identity());
    for (Sample const& s : samples) film.add(0, 0, s.v, s.w);
    return film;
}

double channel(ExrFile const& file, std::string const& name, std::size_t i = 0) {
    ExrChannel const* c = file.find(name);
    REQUIRE_MESSAGE(c != nullptr, name);
    return c->type == ExrChannel::Type::Uint ? c->uints[i] : static_cast<double>(c->data[i]);
}

}  // namespace

TEST_CASE("a pixel is the sum over the weight, negative weights among them") {
    Image const image = develop(pixel_of({{{1, 2, 3}, 2}, {{4, 4, 4}, -0.5f}, {{0, 0, 8}, 0.5f}}));
    CHECK(image.get(0, 0, 0) == 0.0f);
    CHECK(image.get(0, 0, 1) == 1.0f);
    CHECK(image.get(0, 0, 2) == 4.0f);
    CHECK(image.chromaticities == kRec709);
    Image const nothing = develop(pixel_of({{{1, 2, 3}, 1}, {{4, 4, 4}, -1}}));
    for (int c = 0; c < 3; ++c) CHECK(nothing.get(0, 0, c) == 0.0f);  // no weight
    CHECK(develop(pixel_of({})).get(0, 0, 0) == 0.0f);
    CHECK_THROWS_AS(develop(Film{}), Error);
}

TEST_CASE("the variance is that of the samples' mean") {
    // Against the definition, from the samples themselves.
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0.0f, 3.0f);
    for (bool const is_signed : {false, true}) {
        std::vector<Sample> samples;
        for (int i = 0; i < 200; ++i)
            samples.push_back(
                {{uniform(random), 100 + uniform(random), 0.5f}, is_signed && i % 7 == 0 ? -1.25f : 1.25f});
        Film const film = pixel_of(samples);
        for (int c = 0; c < 3; ++c) {
            double sum = 0, weight = 0, squares = 0;
            for (Sample const& s : samples) sum += double{s.w} * double{s.v[c]}, weight += double{s.w};
            for (Sample const& s : samples)
                squares += std::pow(double{s.w} * (double{s.v[c]} - sum / weight), 2);
            double const expected = 200.0 / 199.0 * squares / (weight * weight);
            CHECK(double{develop_variance(film).get(0, 0, c)} == doctest::Approx(expected).epsilon(1e-6));
        }
        CHECK(develop_variance(film).get(0, 0, 2) < 1e-15f);
    }
    CHECK(develop_variance(pixel_of({{{1, 2, 3}, 1}})).get(0, 0, 1) == 4.0f);
    CHECK(develop_variance(pixel_of({})).get(0, 0, 1) == 0.0f);
}

TEST_CASE("the variance of signed weights predicts the scatter of pixels") {
    // 4000 pixels of 64 samples each with w = 1 or -1/2: the mean of their variances is the variance of their means.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform;
    double sum = 0, squares = 0, predicted = 0;
    int const n = 4000;
    for (int i = 0; i < n; ++i) {
        Film film({1, 1}, {0, 1, 0, 1}, false, {});
        for (int k = 0; k < 64; ++k)
            film.add(0, 0, Vec3(1 + uniform(random)), uniform(random) < 0.2f ? -0.5f : 1.0f);
        double const m = double{develop(film).get(0, 0, 0)};
        sum += m, squares += m * m, predicted += double{develop_variance(film).get(0, 0, 0)};
    }
    double const actual = (squares - sum * sum / n) / (n - 1);
    CHECK(predicted / n == doctest::Approx(actual).epsilon(0.1));  // 1 sigma of `actual` is 2.2%
}

TEST_CASE("layers of an EXR file") {
    Film film({4, 3}, {1, 3, 1, 2}, true, test_identity());
    film.add(1, 1, {1, 2, 3}, 1), film.add(1, 1, {3, 2, 1}, 1);
    AovSample hit{{0.5f, 0.25f, 1}, {0, 0, 1}, {0, 1, 0}, {7, 8, 9}, 70000, true, 5};
    hit.light = {Vec3{0.5f, 1, 1}, Vec3{0.5f, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 1, 0}};
    hit.estimated = true, hit.radius = 0.25f, hit.photons = 80000;
    film.add_aov(1, 1, 3, hit, 1);
    film.add_aov(1, 1, 4, AovSample{.light = {Vec3{3, 2, 1}}}, 1);
    film.finish_pass(3), film.finish_pass(4);
    ExrFile const file = develop_exr(film, {.metadata = {{"comments", "a test"}}});
    CHECK(file.width == 2);
    CHECK(file.height == 1);
    CHECK(file.data_x0 == 1);
    CHECK(file.data_y0 == 1);
    CHECK(file.display_width == 4);
    CHECK(file.display_height == 3);
    CHECK(file.chromaticities == kRec709);
    CHECK(file.attributes.at("comments") == "a test");
    CHECK(file.attributes.at("nephroid.passes") == "3:5");
    CHECK(file.attributes.at("nephroid.scene") == "scene-hash");
    CHECK(channel(file, "R") == 2);
    CHECK(channel(file, "variance.R") == 1);
    CHECK(channel(file, "variance.G") == 0);
    CHECK(channel(file, "albedo.R") == 0.25);
    CHECK(channel(file, "Ns.Z") == 0.5);
    CHECK(channel(file, "N.Y") == 0.5);
    CHECK(channel(file, "P.X") == 7);  // over the samples that hit
    CHECK(channel(file, "Z") == 70000);
    CHECK(channel(file, "material.id") == 5);
    CHECK(channel(file, "direct.R") == 1.75);
    CHECK(channel(file, "caustic.R") == 0.25);
    CHECK(channel(file, "indirect.B") == 0.5);
    CHECK(channel(file, "specular.G") == 0.5);
    for (char const* c : {"R", "G", "B"}) {
        double sum = 0;
        for (char const* layer : {"direct.", "caustic.", "indirect.", "specular."})
            sum += channel(file, std::string(layer) + c);
        CHECK(sum == channel(file, c));
    }
    CHECK(channel(file, "radius") == 0.25);  // over the samples with an estimate
    CHECK(channel(file, "photons") == 80000);
    CHECK(file.find("photons")->type == ExrChannel::Type::Float);
    CHECK(channel(file, "material.id", 1) == 0xFFFFFFFFu);
    CHECK(file.find("R")->type == ExrChannel::Type::Half);
    CHECK(file.find("Z")->type == ExrChannel::Type::Float);
    CHECK(develop_exr(film, {.half_float = false}).find("R")->type == ExrChannel::Type::Float);
    Film const plain({4, 3}, {1, 3, 1, 2}, false, {});
    CHECK(develop_exr(plain, {}).channels.size() == 6);
    // Nobody asked for photons: there are no layers of them.
    Film const unasked({4, 3}, {1, 3, 1, 2}, true, {});
    CHECK(develop_exr(unasked, {}).find("direct.G"));
    CHECK_FALSE(develop_exr(unasked, {}).find("radius"));
    CHECK_FALSE(develop_exr(unasked, {}).find("photons"));

    TestFolder const folder;
    write_picture(folder / "a.exr", film, {.metadata = {{"comments", "a test"}}});
    ExrFile const back = read_exr(folder / "a.exr");
    CHECK(back.attributes.at("comments") == "a test");
    CHECK(channel(back, "P.Z") == 9);
    CHECK(back.data_x0 == 1);
}

TEST_CASE("ways of light are summed as the beauty is, radii by |w|; what is not finite stays out") {
    Film film({1, 1}, {0, 1, 0, 1}, true, {});
    for (float const w : {1.5f, -0.5f}) {
        AovSample sample;
        sample.light = {Vec3(w + 1), Vec3(2), Vec3(0), Vec3(w)};
        sample.estimated = true, sample.radius = w + 1, sample.photons = 10;
        film.add(0, 0, Vec3(2 * w + 3), w);
        film.add_aov(0, 0, 0, sample, w);
    }
    AovSums const before = film.aov(0, 0);
    AovSample broken;
    broken.light[2].y = std::numeric_limits<float>::quiet_NaN();
    film.add_aov(0, 0, 0, broken, 1);
    broken = AovSample{.radius = std::numeric_limits<float>::infinity()};
    film.add_aov(0, 0, 0, broken, 1);
    CHECK(std::memcmp(&before, &film.aov(0, 0), sizeof(AovSums)) == 0);
    ExrFile const file = develop_exr(film, {.half_float = false});
    CHECK(channel(file, "direct.R") == 3.5);  // (1.5 * 2.5 - 0.5 * 0.5) / 1
    CHECK(channel(file, "caustic.R") == 2);
    CHECK(channel(file, "specular.R") == 2.5);
    CHECK(channel(file, "R") == 8);
    CHECK(channel(file, "radius") == 2);  // (1.5 * 2.5 + 0.5 * 0.5) / 2
    CHECK(channel(file, "photons") == 10);
}

TEST_CASE("the material is that of the earliest pass, in whatever order passes come") {
    auto const film_with = [](std::uint64_t pass, std::uint32_t material) {
        Film film({1, 1}, {0, 1, 0, 1}, true, {});
        film.add_aov(0, 0, pass, {.hit = true, .material = material}, 1);
        film.finish_pass(pass);
        return film;
    };
    Film const early = film_with(2, 20), late = film_with(9, 90);
    CHECK(merge(early, late).aov(0, 0).material == 20);
    CHECK(merge(late, early).aov(0, 0).material == 20);
}

TEST_CASE("pictures are written by extension, 8-bit ones exposed and encoded") {
    TestFolder const folder;
    Film const film = pixel_of({{{0.25f, 0.5f, 2}, 1}});
    for (char const* name : {"a.png", "a.JPG", "a.jpeg", "a.pfm", "a.hdr", "a.exr"}) {
        write_picture(folder / name, film, {.exposure = 1});
        CHECK(std::filesystem::exists(folder / name));
    }
    Image const png = read_image(folder / "a.png");
    CHECK(png.u8()[0] == linear_to_srgb_byte(0.5f));
    CHECK(png.u8()[2] == 255);
    CHECK(read_image(folder / "a.pfm").get(0, 0, 2) == 2.0f);  // light as it is
    CHECK(read_image(folder / "a.exr").get(0, 0, 2) == 2.0f);
    CHECK_THROWS_AS(write_picture(folder / "a.gif", film, {}), Error);
    CHECK_THROWS_AS(write_picture(folder / "a", film, {}), Error);
}

TEST_CASE("a layer that leaves the range of halves is written as floats, and said") {
    TestFolder const folder;
    Film film({4, 1}, {0, 4, 0, 1}, true, test_identity());
    for (int x = 0; x < 4; ++x) {
        film.add(x, 0, {1, x == 2 ? 70000.0f : 2.0f, 3}, 1);
        film.add_aov(x, 0, 0, AovSample{}, 1);
    }
    film.finish_pass(0);
    ExrFile const file = develop_exr(film, {});
    for (char const* name : {"R", "G", "B"}) CHECK(file.find(name)->type == ExrChannel::Type::Float);
    CHECK(file.find("albedo.R")->type == ExrChannel::Type::Half);
    CHECK(write_picture(folder / "a.exr", film, {}) == std::vector<std::string>{"G"});
    CHECK(read_exr(folder / "a.exr").find("G")->data[2] == 70000.0f);
    // Nothing to say when floats were asked for, or halves are enough.
    CHECK(write_picture(folder / "b.exr", film, {.half_float = false}).empty());
    film.pixel(2, 0).rgb[1] = 65504;
    CHECK(write_picture(folder / "c.exr", film, {}).empty());
}
