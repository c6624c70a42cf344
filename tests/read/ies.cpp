// IES files: what the numbers mean, which symmetries there are, and what is said about files that are not right.
#include "helpers.h"

#include <algorithm>
#include <cmath>

using namespace nephroid;
using namespace nephroid::test;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

std::string scene_with(std::filesystem::path const& file) {
    return "LightSource \"goniometric\" \"string filename\" \"" + file.string() +
           "\" \"float scale\" 2 \"float power\" 900";
}
/// The text is written to lamp.ies.
Scene lamp(std::string const& text) {
    Folder const folder;
    return read_world(scene_with(folder.write("lamp.ies", text)));
}
IntensityTable table(std::string const& text) {
    return as<MeasuredLight>(lamp(text).lights.at(0).kind).table;
}
/// From the name of the file on.
std::string error_with(std::string const& text) {
    auto const e = error_of([&] { lamp(text); });
    auto const at = e.find("lamp.ies:");
    return at == std::string::npos ? e : e.substr(at);
}

std::string const kHead = "IESNA:LM-63-2002\n[TEST] by hand\n[MANUFAC] nobody\nTILT=NONE\n";
/// Three vertical angles, and the horizontal ones given; numbers of each plane.
std::string file(std::string const& horizontal, int planes, std::string const& candela) {
    return kHead + "1 1000 1 3 " + std::to_string(planes) + " 1 2 0 0 0\n1 1 50\n0 45 90\n" + horizontal +
           "\n" + candela + "\n";
}

/// cd at angles in degrees, bilinear; all the way around.
double at(IntensityTable const& t, double vertical, double horizontal) {
    auto const interval = [](std::vector<float> const& list, double x) {
        std::size_t i = 0;
        while (i + 2 < list.size() && static_cast<double>(list[i + 1]) <= x) ++i;
        return i;
    };
    double const a = vertical * kDegree, b = horizontal * kDegree;
    std::size_t const i = interval(t.vertical, a), j = interval(t.horizontal, b), n = t.vertical.size();
    auto const share = [](std::vector<float> const& list, std::size_t k, double x) {
        auto const lo = static_cast<double>(list[k]), hi = static_cast<double>(list[k + 1]);
        return (x - lo) / (hi - lo);
    };
    double const v = share(t.vertical, i, a), h = share(t.horizontal, j, b);
    auto const value = [&](std::size_t k, std::size_t l) {
        return static_cast<double>(t.candela.at(k * n + l));
    };
    return (1 - h) * ((1 - v) * value(j, i) + v * value(j, i + 1)) +
           h * ((1 - v) * value(j + 1, i) + v * value(j + 1, i + 1));
}
/// Lumens.
double flux(IntensityTable const& t) {
    double sum = 0;
    int const n = 720;
    double const top = static_cast<double>(t.vertical.front()) / kDegree,
                 bottom = static_cast<double>(t.vertical.back()) / kDegree;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            double const v = top + (bottom - top) * (i + 0.5) / n;
            sum += at(t, v, 360.0 * (j + 0.5) / n) * std::sin(v * kDegree);
        }
    return sum * (bottom - top) * kDegree * 360 * kDegree / (n * n);
}

}  // namespace

TEST_CASE("an IES file becomes candela by angles, with its factors") {
    auto const scene =
        lamp(kHead + "2 1450 1.5 3 1 1 1 0.85 4.04 .292\n0.9, 0.8 63.7\n0 45\n90 0\n100,200\n 0");
    REQUIRE(scene.lights.size() == 1);
    auto const& l = as<MeasuredLight>(scene.lights[0].kind);
    CHECK(notes(scene).empty());
    CHECK(l.scale == 2);
    CHECK(l.power == 900);
    REQUIRE(l.table.vertical.size() == 3);
    CHECK(static_cast<double>(l.table.vertical[1]) == doctest::Approx(45 * kDegree));
    CHECK(static_cast<double>(l.table.vertical[2]) == doctest::Approx(90 * kDegree));
    REQUIRE(l.table.horizontal.size() == 2);
    CHECK(l.table.horizontal[0] == 0);
    CHECK(l.table.horizontal[1] == kTwoPi);
    double const factor = 1.5 * 0.9 * 0.8;
    for (double const h : {0.0, 77.0, 300.0}) {
        CHECK(at(l.table, 0, h) == doctest::Approx(100 * factor));
        CHECK(at(l.table, 22.5, h) == doctest::Approx(150 * factor));
        CHECK(at(l.table, 90, h) < 1e-3);
    }
    validate(scene);
}

TEST_CASE("IES headers of all years, line ends and separators") {
    std::string const numbers = "1 1000 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n10 20\n";
    for (char const* const head :
         {"IESNA:LM-63-2002\n[TEST] a\nTILT=NONE\n", "IESNA:LM-63-1995\nTILT=NONE\n",
          "IESNA91\n[TEST] TILT\nTILT=NONE\n", "a lamp of 1986, without a header\nTILT=NONE\n", "TILT=NONE\n",
          "IESNA:LM-63-2002\n tilt = none \n"}) {
        CAPTURE(std::string(head));
        auto const t = table(head + numbers);
        CHECK(t.candela == std::vector<float>{10, 20, 10, 20});
    }
    std::string dos;
    for (char const c : "IESNA91\nTILT=NONE\n" + numbers)
        dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(table(dos + "\x1a").candela == std::vector<float>{10, 20, 10, 20});
    CHECK(notes(lamp(dos + "\x1a")).empty());
}

TEST_CASE("IES symmetries: one plane, a quarter, either half, all around, and a circle that is not closed") {
    auto const check = [](IntensityTable const& t, std::vector<std::pair<double, double>> const& wanted) {
        CHECK(t.horizontal.front() == 0);
        CHECK(t.horizontal.back() == kTwoPi);
        CHECK(std::is_sorted(t.horizontal.begin(), t.horizontal.end(), std::less_equal<float>{}));
        REQUIRE(t.candela.size() == t.vertical.size() * t.horizontal.size());
        for (auto const& want : wanted) {
            double const angle = want.first;
            double const cd = want.second;
            CAPTURE(angle);
            CHECK(at(t, 45, angle) == doctest::Approx(cd).epsilon(1e-4));
            CHECK(at(t, 22.5, angle) == doctest::Approx((100 + cd) / 2).epsilon(1e-4));
        }
    };
    check(table(file("0", 1, "100 30 0")), {{0, 30}, {123, 30}, {359, 30}});
    // The same lamp, folded in four ways: I(45 deg, h) = 20 at 0, 40 at 90.
    check(
        table(file("0 90", 2, "100 20 0 100 40 0")),
        {{0, 20}, {45, 30}, {90, 40}, {135, 30}, {180, 20}, {225, 30}, {270, 40}, {315, 30}, {359.999, 20}});
    check(table(file("0 90 180", 3, "100 20 0 100 40 0 100 80 0")),
          {{0, 20}, {90, 40}, {135, 60}, {180, 80}, {225, 60}, {270, 40}, {315, 30}, {360, 20}});
    check(table(file("90 180 270", 3, "100 20 0 100 40 0 100 80 0")),
          {{90, 20}, {135, 30}, {180, 40}, {225, 60}, {270, 80}, {315, 60}, {0, 40}, {45, 30}});
    // … whose plane at 0 is between two of the file's where 180 is.
    check(table(file("90 170 190 270", 4, "100 20 0 100 40 0 100 60 0 100 80 0")),
          {{90, 20}, {10, 40}, {350, 60}, {0, 50}, {180, 50}, {270, 80}});
    check(table(file("0 90 180 270 360", 5, "100 20 0 100 40 0 100 60 0 100 80 0 100 20 0")),
          {{0, 20}, {45, 30}, {90, 40}, {180, 60}, {270, 80}, {315, 50}, {360, 20}});
    std::string const open = file("0 90 180 270", 4, "100 20 0 100 40 0 100 60 0 100 80 0");
    check(table(open), {{0, 20}, {90, 40}, {270, 80}, {315, 50}, {360, 20}});
    CHECK(contains(notes(lamp(open)),
                   "lamp.ies:9: the horizontal angles end before 360: the first plane closes the circle"));
}

TEST_CASE("what of an IES file is approximated is noted") {
    auto const included = lamp(
        "IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.95 0.9\n1 1000 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n10 20\n");
    CHECK(contains(notes(included), "t.pbrt:2: "));
    CHECK(
        contains(notes(included), "lamp.ies:6: the factors of a tilted lamp (TILT=INCLUDE) are not applied"));
    CHECK(as<MeasuredLight>(included.lights[0].kind).table.candela == std::vector<float>{10, 20, 10, 20});
    CHECK(
        notes(
            lamp("IESNA91\nTILT=INCLUDE\n1\n2\n0 90\n1 1\n1 1000 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n10 20\n"))
            .empty());
    CHECK(contains(notes(lamp(file("0", 1, "1 2 3 4"))),
                   "lamp.ies:9: what follows the intensities was left out"));
    CHECK(contains(notes(lamp(file("0", 1, "0 0 0"))), "the light is dark"));
    CHECK(contains(notes(lamp(kHead + "1 1000 1 2 1 1 2 0 0 0\n1 0 50\n0 90\n0\n10 20\n")),
                   "lamp.ies:6: a ballast-lamp photometric factor of 0 counts as not given"));
}

TEST_CASE("IES files that are not right are refused with the line and what to do") {
    auto const numbers = [](std::string const& n) { return kHead + n; };
    CHECK(error_with("") == "lamp.ies:0: there is no line \"TILT=\"; is it an IES file?");
    CHECK(error_with("IESNA91\nhello\n") == "lamp.ies:2: there is no line \"TILT=\"; is it an IES file?");
    CHECK(contains(error_with("IESNA91\nTILT=lamp.tlt\n1 1"),
                   "lamp.ies:2: TILT=lamp.tlt names another file, which is not read"));
    CHECK(contains(error_with(kHead),
                   "lamp.ies:4: the file ends where the number of lamps should be; it is cut off"));
    CHECK(contains(error_with(file("0", 1, "1 2")),
                   "lamp.ies:9: the file ends where intensity 3 of 3 should be"));
    CHECK(contains(error_with(file("0", 1, "1 x 3")),
                   "lamp.ies:9: \"x\" is not a finite number; here should be intensity 2 of 3"));
    CHECK(contains(error_with(file("0", 1, "1 nan 3")), "is not a finite number"));
    CHECK(contains(error_with(file("0", 1, "1 inf 3")), "is not a finite number"));
    CHECK(contains(error_with(file("0", 1, "1 -2 3")), "an intensity is negative"));
    CHECK(contains(error_with(file("0 90 45", 3, "1 2 3 1 2 3 1 2 3")),
                   "lamp.ies:8: a horizontal angle does not increase"));
    CHECK(contains(error_with(file("0 45", 2, "1 2 3 1 2 3")), "horizontal angles must be 0 alone"));
    CHECK(contains(error_with(file("0 361", 2, "1 2 3 1 2 3")), "a horizontal angle is outside 0 to 360"));
    CHECK(contains(error_with(numbers("1 1 1 2 1 1 1 0 0 0 1 1 1\n90 -90\n0\n1 1")),
                   "lamp.ies:6: a vertical angle is outside 0 to 180"));
    CHECK(contains(error_with(numbers("1 1 1 2 1 1 1 0 0 0 1 1 1\n45 45\n0\n1 1")),
                   "a vertical angle does not increase"));
    CHECK(contains(error_with(numbers("1 1 1 2 1 2 1 0 0 0 1 1 1\n0 90\n0\n1 1")),
                   "photometric type B is not read; convert the file to type C"));
    CHECK(contains(error_with(numbers("1 1 1 2 1 3 1 0 0 0 1 1 1\n0 90\n0\n1 1")),
                   "photometric type A is not read"));
    CHECK(contains(error_with(numbers("1 1 0 2 1 1 1 0 0 0 1 1 1\n0 90\n0\n1 1")),
                   "the candela multiplier must be above 0"));
    CHECK(contains(error_with(numbers("1 1 1 2 1 1 1 0 0 0 0 1 1\n0 90\n0\n1 1")),
                   "the ballast factor must be above 0"));
    CHECK(contains(error_with(numbers("1 1 1 1 1 1 1 0 0 0 1 1 1\n0\n0\n1")),
                   "the number of vertical angles must be a whole number from 2 on"));
    CHECK(contains(error_with(numbers("1 1 1 2.5 1 1 1 0 0 0 1 1 1\n0\n0\n1")), "must be a whole number"));
    // Counts that lie are not believed: nothing is made room for.
    CHECK(contains(error_with(numbers("1 1 1 2000000000 1 1 1 0 0 0 1 1 1\n0")),
                   "is more than is read (10000)"));
    CHECK(contains(error_with(numbers("1 1 1 9999 9999 1 1 0 0 0 1 1 1\n0")),
                   "9999 x 9999 intensities are more than are read"));
    CHECK(contains(error_with(numbers("1 1 1 1000 1000 1 1 0 0 0 1 1 1\n0")),
                   "the file ends where a vertical angle should be"));
    CHECK(
        contains(error_with(numbers("1 1 1e38 2 1 1 1 0 0 0 1 1 1\n0 90\n0\n1 1e38")), "beyond all numbers"));
    CHECK(contains(error_in_world("LightSource \"goniometric\" \"string filename\" \"/nonexistent/a.IES\""),
                   "IES file \"/nonexistent/a.IES\""));
}

TEST_CASE("scenes with a table that is not one are refused") {
    auto const refused = [](IntensityTable t) {
        Scene scene = read_world("");
        scene.add(Light{MeasuredLight{RgbIlluminantSpd{{1, 1, 1}}, std::move(t), 1, -1}, {}, {}});
        return error_of([&] { validate(scene); });
    };
    IntensityTable const good{{0, 1}, {0, kTwoPi}, {1, 2, 1, 2}};
    CHECK(refused(good) == "no error");
    auto const with = [&](auto const& change) {
        IntensityTable t = good;
        change(t);
        return refused(t);
    };
    CHECK(contains(with([](auto& t) { t.vertical = {1, 0}; }), "vertical angles must increase"));
    CHECK(contains(with([](auto& t) { t.vertical = {0}; }), "at least two"));
    CHECK(contains(with([](auto& t) { t.vertical = {0, 4}; }), "within their range"));
    CHECK(contains(with([](auto& t) { t.horizontal = {0, 3}; }), "all the way around"));
    CHECK(contains(with([](auto& t) { t.horizontal = {}; }), "at least two"));
    CHECK(contains(with([](auto& t) { t.candela.pop_back(); }), "one intensity for each pair"));
    CHECK(contains(with([](auto& t) { t.candela[1] = -1; }), "negative intensity"));
    CHECK(contains(with([](auto& t) { t.candela[1] = kInfinity; }), "not finite"));
    CHECK(contains(with([](auto& t) { t.vertical[1] = std::nanf(""); }), "not finite"));
    Scene scene = read_world("");
    scene.add(Light{GoniometricLight{}, {}, {}});
    CHECK(contains(error_of([&] { validate(scene); }), "needs a picture"));
    scene.lights[0].kind.emplace<ProjectionLight>();
    CHECK(contains(error_of([&] { validate(scene); }), "needs a picture"));
    scene.images.push_back({"/a.png", "", {}});
    scene.lights[0].kind.emplace<ProjectionLight>(ProjectionLight{ImageId{0}, kPi, 1, -1});
    CHECK(contains(error_of([&] { validate(scene); }), "fov"));
    scene.lights[0].kind.emplace<ProjectionLight>(ProjectionLight{ImageId{0}, 1, -1, -1});
    CHECK(contains(error_of([&] { validate(scene); }), "scale"));
    // Another table is another scene.
    Scene other = read_world("");
    auto const hash_of = [&](float cd) {
        other.lights.clear();
        IntensityTable t = good;
        t.candela[3] = cd;
        other.add(Light{MeasuredLight{RgbIlluminantSpd{{1, 1, 1}}, t, 1, -1}, {}, {}});
        return hash(other);
    };
    CHECK(hash_of(1) == hash_of(1));
    CHECK(hash_of(1) != hash_of(2));
}

TEST_CASE("real lamps: the share of their lamps' light that comes out") {
    auto const data = shared_data();
    if (data.empty()) return;
    struct Lamp {
        char const* name;
        double lamp_lumens;  // as the file says
        double efficiency;   // of the luminaire: computed apart from this reader, plane by plane
        double peak;         // cd, its greatest number
        std::size_t vertical, horizontal;
    };
    for (Lamp const& l : {Lamp{"ASA_15M_R2.ies", 13000, 0.73545, 6019, 37, 145},
                          Lamp{"radiance_examp1.ies", 2 * 2900, 0.91322, 1065.2, 73, 17}}) {
        auto const path = data / "ies" / l.name;
        if (!std::filesystem::exists(path)) {
            MESSAGE("SKIPPED: no ", path.string());
            continue;
        }
        CAPTURE(std::string(l.name));
        auto const scene = read_world(scene_with(path));
        CHECK(notes(scene).empty());
        validate(scene);
        auto const& t = as<MeasuredLight>(scene.lights.at(0).kind).table;
        CHECK(t.vertical.size() == l.vertical);
        CHECK(t.horizontal.size() == l.horizontal);  // unfolded: 73 planes of a half, 5 of a quarter
        double const peak = static_cast<double>(*std::max_element(t.candela.begin(), t.candela.end()));
        CHECK(peak == doctest::Approx(l.peak));
        double const lumens = flux(t);
        MESSAGE(std::string(l.name), ": ", lumens, " lm of the lamps' ", l.lamp_lumens, ", peak ", peak,
                " cd");
        CHECK(lumens / l.lamp_lumens == doctest::Approx(l.efficiency).epsilon(0.001));
    }
}
