// The arithmetic of the page, from measurements that are made up: medians, rounds, bridges, what is met, what cannot be trusted.
#include "support.h"

#include "peers_page.h"
#include "targets.h"
#include "yardsticks.h"

using namespace nephroid;
using namespace nephroid::peers;
using namespace nephroid::test;

namespace {

Result result(char const* name, std::vector<double> seconds, std::vector<double> errors, int samples = 64,
              double mean = 0.5) {
    Result r;
    r.renderer = name;
    r.path_tracer = std::string(name) != kSppm && std::string(name) != kPovray;
    r.reference = "own";
    r.mean = mean;
    r.samples = samples;
    r.seconds = r.process_seconds = r.seconds64 = r.process_seconds64 = std::move(seconds);
    r.errors = std::move(errors);
    r.picture = Image(PixelFormat::Float, 400, 400, {"R", "G", "B"});
    return r;
}
SceneResult scene(char const* name, std::vector<Result> results) {
    return {name, "", {400, 400}, 12, 1, std::move(results)};
}
Target target(std::vector<Target> const& all, std::string const& what) {
    for (Target const& t : all)
        if (t.what.find(what) != std::string::npos) return t;
    FAIL("there is no target: " << what);
    return {};
}

}  // namespace

TEST_CASE("the median of odd and even counts") {
    CHECK(median({5, 1, 3}) == 3);
    CHECK(median({4, 1, 3, 2}) == 2.5);
    CHECK(median({}) == 0);
}

TEST_CASE("efficiency is 1 / (relMSE s), round by round") {
    CHECK(efficiencies(result(kPath, {2, 4}, {0.25, 0.5})) == std::vector<double>{2, 0.5});
    CHECK(efficiencies(result(kPath, {2, 4}, {0.25, 0})).empty());
}

TEST_CASE("ratios are of one round each, and their median decides") {
    auto us = result(kPath, {1, 2, 4}, {0.1, 0.1, 0.1}), them = result(kCycles, {3, 5, 10}, {0.2, 0.4, 0.1});
    auto t = target(targets({scene("cornell", {us, them})}), "time of Cycles / ours");
    CHECK(t.rounds == std::vector<double>{3, 2.5, 2.5});
    CHECK(t.bound == 2.8);
    CHECK_FALSE(t.met());
    them.seconds64 = {3, 6, 10};
    CHECK(target(targets({scene("cornell", {us, them})}), "time of Cycles / ours").met());
    auto const e = target(targets({scene("cornell", {us, them})}), "efficiency of ours / Cycles'");
    REQUIRE(e.rounds.size() == 3);
    CHECK(e.rounds[0] == doctest::Approx(6));    // 10 against 1 / 0.6
    CHECK(e.rounds[1] == doctest::Approx(10));   // 5 against 0.5
    CHECK(e.rounds[2] == doctest::Approx(2.5));  // 2.5 against 1
    CHECK(e.met());
    them.seconds64.pop_back();  // rounds that do not pair
    auto const broken = target(targets({scene("cornell", {us, them})}), "time of Cycles / ours");
    CHECK(broken.rounds.empty());
    CHECK_FALSE(broken.met());
}

TEST_CASE("at most is at most") {
    auto const us = result(kPath, {2}, {0.1});
    auto slow = result(kSpectral, {2.4}, {0.1});
    CHECK(target(targets({scene("cornell", {us, slow})}), "spectral / rgb").met());
    slow.seconds64 = {2.6};
    auto const t = target(targets({scene("cornell", {us, slow})}), "spectral / rgb");
    CHECK_FALSE(t.least);
    CHECK(t.rounds[0] == doctest::Approx(1.3));
    CHECK_FALSE(t.met());
}

TEST_CASE("a time a sample where samples differ") {
    auto const us = result(kPath, {4}, {0.1}, 80), them = result(kCycles, {4}, {0.1}, 32);
    CHECK(target(targets({scene("ball", {us, them})}), "a sample").rounds[0] == doctest::Approx(2.5));
}

TEST_CASE("bridged rows scale what others took by Cycles, which is on both machines") {
    // Here everything takes twice as long as there, where we would take 2 s for what Cycles takes 10.1, and sppm 5.
    auto us = result(kPath, {4}, {0.1}), them = result(kCycles, {20.2}, {0.1}),
         sppm = result(kSppm, {10}, {0.001});
    us.seconds64 = sppm.seconds64 = {0.001};  // whole processes count, as theirs do
    auto const all = targets({scene("cornell_glass", {us, them, sppm})});
    auto const mitsuba = target(all, "Mitsuba 3 llvm path / our path");
    CHECK(mitsuba.bridged);
    CHECK(mitsuba.rounds[0] == doctest::Approx(4.0 / 2));
    CHECK(target(all, "pbrt-v4 path / our path").rounds[0] == doctest::Approx(29.5 / 2));
    CHECK(target(all, "Tungsten path / our path").rounds[0] == doctest::Approx(9.8 / 2));
    auto const pbrt = target(all, "pbrt-v4 sppm / our sppm"),
               tungsten = target(all, "Tungsten progressive photon map / our sppm"),
               seconds = target(all, "seconds of sppm");
    CHECK(pbrt.rounds[0] == doctest::Approx(55.6 / 5));
    CHECK(pbrt.bound == 10);
    CHECK(pbrt.met());
    CHECK(tungsten.rounds[0] == doctest::Approx(13.9 / 5));
    CHECK(tungsten.bound == 2.5);
    CHECK(seconds.rounds[0] == doctest::Approx(5));
    CHECK(seconds.bound == 5.5);
    CHECK(seconds.met());
    CHECK_FALSE(target(all, "time of Cycles / ours").bridged);
    // Without Cycles there is no bridge.
    for (Target const& t : targets({scene("cornell_glass", {us, sppm})})) CHECK_FALSE(t.bridged);
    // Nor at another size than theirs.
    auto small = scene("cornell_glass", {us, them, sppm});
    small.resolution = {200, 200};
    for (Target const& t : targets({small})) CHECK_FALSE(t.bridged);
    // cornell has its own.
    CHECK(target(targets({scene("cornell", {us, them})}), "Mitsuba").rounds[0] ==
          doctest::Approx(3.6 / 8.3 * 20.2 / 4));
}

TEST_CASE("photons are to be fifty times as efficient") {
    auto const us = result(kPath, {1}, {1}), them = result(kCycles, {1}, {2}),
               sppm = result(kSppm, {1}, {0.019});
    auto const all = targets({scene("cup", {us, them, sppm})});
    CHECK(target(all, "sppm / our path").rounds[0] == doctest::Approx(1 / 0.019));
    CHECK(target(all, "sppm / our path").met());
    CHECK(target(all, "sppm / Cycles'").rounds[0] == doctest::Approx(2 / 0.019));
    for (Target const& t : targets({scene("interior", {us, them, sppm})}))
        CHECK(t.what.find("sppm") == std::string::npos);
}

TEST_CASE("what failed, or is another picture, is complained of") {
    auto const us = result(kPath, {1}, {1}), same = result(kCycles, {1}, {1}, 64, 0.52),
               other = result("pbrt-v4", {1}, {1}, 64, 0.53), dark = result("Tungsten", {1}, {1}, 64, 0.47);
    CHECK(complaints({scene("cup", {us, same})}).empty());
    CHECK(complaints({scene("cup", {us, other, dark})}).size() == 2);
    auto const povray = result(kPovray, {1}, {1}, 1, 0.7);
    CHECK(complaints({scene("cup", {us, povray})}).empty());  // it is no path tracer
    auto failed = same;
    failed.failure = "exit code 1";
    auto const said = complaints({scene("cup", {us, failed})});
    REQUIRE(said.size() == 1);
    CHECK(said[0] == "cup: Cycles failed");
    CHECK(
        complaints({scene("cup", {result(kCycles, {1}, {1}, 64, 0.1)})}).empty());  // nothing to compare with
}

TEST_CASE("the page says what is met, what is not, what differs and what failed") {
    PeersFolder const folder;
    auto us = result(kPath, {1, 1, 1}, {0.1, 0.2, 0.1}),
         them = result(kCycles, {3, 2.9, 3.5}, {0.2, 0.2, 0.2}),
         spectral = result(kSpectral, {2, 2, 2}, {0.1, 0.1, 0.1}),
         other = result("pbrt-v4", {9, 9, 9}, {0.1, 0.1, 0.1}, 64, 0.6);
    us.curve = {{0.5, 0.2}, {1, 0.1}};
    Result failed;
    failed.renderer = "Tungsten";
    failed.failure = "there is no such file";
    write_peers_page(folder.path(), {scene("cornell", {us, spectral, them, other, failed})},
                     {{"cycles", kCycles, "Blender 9.9", true, {}}}, Plan{}, 2, true);
    std::string const page = text_of(folder.path() / "peers.md");
    auto const row = [&](std::string const& what) {
        auto const at = page.find("| " + what);
        REQUIRE(at != std::string::npos);
        return page.substr(at, page.find('\n', at) - at);
    };
    auto const says = [](std::string const& text, std::string const& part) {
        INFO(text);
        return text.find(part) != std::string::npos;
    };
    CHECK(says(row("cornell: time of Cycles / ours"), "≥ 2.80 | 3.00 (2.90 to 3.50) | met"));
    CHECK(says(row("cornell: time of spectral / rgb"), "| **not met** |"));
    CHECK(says(row("*bridged* cornell: time of Mitsuba"), "| 1.30 (1.26 to 1.52) | met"));
    CHECK(says(row("cornell | Cycles"), "agrees"));
    CHECK(says(row("cornell | pbrt-v4"), "+20.00% | **differs**"));
    CHECK(says(row("Tungsten"), "failed"));
    CHECK(says(row("nephroid path, rgb | 64 | 1.00 (1.00 to 1.00)"), "10.0 (5.00 to 10.0)"));
    CHECK(says(page, "Blender 9.9"));
    CHECK(says(page, "A quick run"));
    CHECK(std::filesystem::exists(folder.path() / "peers/cornell.svg"));
    CHECK(std::filesystem::exists(folder.path() / "peers/cornell.jpg"));
}
