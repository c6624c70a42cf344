// Integrators that shoot photons: names and defaults of pbrt-v2 and pbrt-v4, colours, and what is refused.
#include "helpers.h"

#include <limits>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Settings settings_of(std::string const& text) { return read(text + "\nWorldBegin").settings; }
PhotonMapIntegrator photon_map(std::string const& parameters) {
    return as<PhotonMapIntegrator>(settings_of("Integrator \"photonmap\" " + parameters).integrator);
}
SppmIntegrator sppm(std::string const& parameters) {
    return as<SppmIntegrator>(settings_of("Integrator \"sppm\" " + parameters).integrator);
}

}  // namespace

TEST_CASE("photonmap has pbrt-v2's names") {
    auto const p =
        photon_map(R"("integer causticphotons" 30000 "integer indirectphotons" 70000 "integer nused" 88
        "float maxdist" 0.25 "bool finalgather" false "integer finalgathersamples" 7 "integer maxphotondepth" 4
        "integer maxspeculardepth" 9 "integer passes" 3 "float causticradius" 0.125 "float alpha" 0.5
        "string kernel" "cone" "bool edgecorrection" false "bool aim" false "string visualize" "caustic")");
    CHECK(p.shooting.caustic_paths == 30000);
    CHECK(p.shooting.global_paths == 70000);
    CHECK(p.shooting.max_depth == 4);
    CHECK_FALSE(p.shooting.aim);
    CHECK(p.estimates.nused == 88);
    CHECK(p.estimates.radius == 0.25f);
    CHECK(p.estimates.caustic_radius == 0.125f);
    CHECK(p.estimates.kernel == Kernel::Cone);
    CHECK_FALSE(p.estimates.edge_correction);
    CHECK_FALSE(p.final_gather);
    CHECK(p.gather_samples == 7);
    CHECK(p.max_depth == 9);
    CHECK(p.passes == 3);
    CHECK(p.alpha == 0.5f);
    CHECK(p.visualize == PhotonView::Caustic);
    CHECK(photon_map("\"float radius\" 2").estimates.radius == 2);
    CHECK(photon_map("\"integer maxdepth\" 3").max_depth == 3);
    CHECK(photon_map("\"integer indirectphotons\" 0").shooting.global_paths == 0);
    CHECK(photon_map("\"integer nused\" 2").estimates.nused == 2);
    auto const scene = read("\nIntegrator \"photonmap\" \"float gatherangle\" 10 WorldBegin");
    CHECK(notes(scene) ==
          "t.pbrt:2: Integrator \"photonmap\": \"gatherangle\" changes nothing: gather rays follow the "
          "surface alone\n");
    CHECK(contains(notes(read("Integrator \"photonmap\" \"integer causticphoton\" 10 WorldBegin")),
                   "did you mean \"causticphotons\"?"));
}

TEST_CASE("defaults are those of the settings") {
    auto const p = photon_map("");
    PhotonMapIntegrator const d;
    CHECK(p.shooting.global_paths == d.shooting.global_paths);
    CHECK(p.shooting.caustic_paths == -1);
    CHECK(p.estimates.radius == 0);  // automatic
    CHECK(p.estimates.edge_correction);
    CHECK(p.estimates.kernel == Kernel::Epanechnikov);
    CHECK(p.final_gather);
    CHECK(p.passes == 1);
    CHECK(p.visualize == PhotonView::None);
    auto const s = sppm("");
    CHECK(s.max_depth == 5);
    CHECK(s.shooting.max_depth == 5);
    CHECK(s.shooting.global_paths == -1);
    CHECK(s.estimates.radius == 0);  // pbrt-v4's 1 is not taken
    CHECK(s.estimates.nused == 0);
    CHECK(s.alpha == 2.0f / 3.0f);
}

TEST_CASE("sppm and lightpath have pbrt-v4's names") {
    auto const scene = read(R"(Sampler "zsobol" "integer pixelsamples" 64
        Integrator "sppm" "integer maxdepth" 8 "float radius" 0.03 "integer photonsperiteration" 160000
        "integer seed" 11 WorldBegin)");
    CHECK(notes(scene).empty());
    auto const& s = as<SppmIntegrator>(scene.settings.integrator);
    CHECK(s.max_depth == 8);
    CHECK(s.shooting.max_depth == 8);
    CHECK(s.shooting.global_paths == 160000);
    CHECK(s.estimates.radius == 0.03f);
    CHECK(scene.settings.seed == 11);
    CHECK(scene.settings.spp == 64);
    CHECK(wanted_passes(scene.settings) == 64);
    CHECK(samples_per_pass(scene.settings) == 1);
    // 0 and -1 are pbrt's words for as many as pixels; a sampler's seed is the whole picture's.
    CHECK(sppm("\"integer photonsperiteration\" 0").shooting.global_paths == -1);
    CHECK(sppm("\"integer photonsperiteration\" -1").shooting.global_paths == -1);
    CHECK(sppm("\"integer maxphotondepth\" 3").shooting.max_depth == 3);
    CHECK(settings_of("Sampler \"sobol\" \"integer seed\" 7 Integrator \"sppm\" \"integer seed\" 3").seed ==
          7);
    CHECK(settings_of("Option \"seed\" 5 Integrator \"sppm\" \"integer seed\" 3").seed == 3);
    CHECK(contains(notes(read("Integrator \"path\" \"integer seed\" 3 WorldBegin")), "seed"));

    auto const l = as<LightPathIntegrator>(
        settings_of("Integrator \"lightpath\" \"integer maxdepth\" 4 \"integer lightpaths\" 99").integrator);
    CHECK(l.max_depth == 4);
    CHECK(l.paths == 99);
    CHECK(as<LightPathIntegrator>(settings_of("Integrator \"lightpath\"").integrator).paths == -1);
}

TEST_CASE("colours follow the integrator unless they are chosen") {
    CHECK(settings_of("Integrator \"photonmap\"").color == ColorMode::Rgb);
    CHECK(settings_of("Integrator \"sppm\"").color == ColorMode::Spectral);
    CHECK(settings_of("Integrator \"lightpath\"").color == ColorMode::Spectral);
    CHECK(settings_of("Integrator \"path\"").color == ColorMode::Spectral);
    // In either order, and whatever the number of passes.
    CHECK(settings_of("Option \"color\" \"spectral\" Integrator \"photonmap\"").color == ColorMode::Spectral);
    CHECK(
        settings_of("Integrator \"photonmap\" \"integer passes\" 500 Option \"color\" \"spectral\"").color ==
        ColorMode::Spectral);
    CHECK(settings_of("Integrator \"photonmap\" \"integer passes\" 500").color == ColorMode::Rgb);
    CHECK(settings_of("Option \"color\" \"rgb\" Integrator \"sppm\"").color == ColorMode::Rgb);
    CHECK(settings_of("Integrator \"photonmap\" Integrator \"path\"").color == ColorMode::Spectral);
}

TEST_CASE("the samples of a pixel are shared out among the passes of photonmap") {
    auto const shared = [](std::string const& spp, std::string const& passes) {
        auto const s = settings_of("Sampler \"sobol\" \"integer pixelsamples\" " + spp +
                                   " Integrator \"photonmap\" \"integer passes\" " + passes);
        return std::pair(samples_per_pass(s), wanted_passes(s));
    };
    CHECK(shared("16", "1") == std::pair(16, 1));
    CHECK(shared("16", "4") == std::pair(4, 4));
    CHECK(shared("17", "4") == std::pair(5, 4));
    CHECK(shared("2", "4") == std::pair(1, 4));
    CHECK(shared("2147483647", "2147483647") == std::pair(1, 2147483647));
    // What a pass is does not depend on how many there are.
    auto const hash_of = [](std::string const& spp, std::string const& passes) {
        auto s = settings_of("Sampler \"sobol\" \"integer pixelsamples\" " + spp +
                             " Integrator \"photonmap\" \"integer passes\" " + passes);
        s.integrator_where = s.sampler_where = {};
        return hash(s);
    };
    CHECK(hash_of("8", "2") == hash_of("16", "4"));
    CHECK(hash_of("8", "2") != hash_of("8", "4"));
    auto given = settings_of("Integrator \"sppm\"");
    auto const before = hash(given);
    given.color_given = true;
    CHECK(hash(given) == before);
}

TEST_CASE("odd values of photon integrators are refused with their place") {
    auto const refused = [](std::string const& text, std::string const& message) {
        auto const error = error_in("\nIntegrator " + text + " WorldBegin");
        CAPTURE(text);
        CAPTURE(error);
        CHECK(error.starts_with("t.pbrt:2: Integrator "));
        CHECK(contains(error, message));
    };
    for (std::string const name :
         {"causticphotons", "indirectphotons", "nused", "maxphotondepth", "maxspeculardepth"})
        refused("\"photonmap\" \"integer " + name + "\" -2", "\"" + name + "\" must be at least 0");
    for (std::string const name : {"finalgathersamples", "passes"})
        for (char const* n : {"0", "-1"})
            refused("\"photonmap\" \"integer " + name + "\" " + n, "\"" + name + "\" must be at least 1");
    for (std::string const name : {"radius", "maxdist", "causticradius"})
        refused("\"photonmap\" \"float " + name + "\" -1", "\"" + name + "\" must be above 0, or 0");
    refused("\"photonmap\" \"float radius\" 1 \"float maxdist\" 1", "not both");
    refused("\"photonmap\" \"integer maxdepth\" 1 \"integer maxspeculardepth\" 1", "not both");
    for (char const* alpha : {"0", "-1", "1.5"})
        refused(std::string("\"sppm\" \"float alpha\" ") + alpha, "\"alpha\" must be above 0 and at most 1");
    refused("\"sppm\" \"integer photonsperiteration\" -2", "\"photonsperiteration\" must be at least 0");
    refused("\"sppm\" \"integer maxdepth\" -1", "must not be negative");
    refused("\"sppm\" \"string kernel\" \"epanechnikow\"",
            "use one of \"box\", \"cone\", \"epanechnikov\", \"gaussian\"");
    refused("\"sppm\" \"string visualize\" \"photons\"", "use one of \"none\", \"global\"");
    refused("\"lightpath\" \"integer lightpaths\" 0", "\"lightpaths\" must be at least 1");
    CHECK(
        contains(error_in("\nIntegrator \"sppm\" \"float photonsperiteration\" 5 WorldBegin"), "t.pbrt:2: "));
}

TEST_CASE("what no file can say is refused as well") {
    auto const refused = [](Integrator const& integrator, std::string const& message) {
        auto scene = read("\nIntegrator \"sppm\" WorldBegin");
        scene.settings.integrator = integrator;
        auto const error = error_of([&] { validate(scene); });
        CAPTURE(error);
        CHECK(error.starts_with("t.pbrt:2: "));
        CHECK(contains(error, message));
    };
    validate(read("Integrator \"photonmap\" WorldBegin"));
    validate(read("Integrator \"lightpath\" WorldBegin"));
    float const nan = std::numeric_limits<float>::quiet_NaN();
    SppmIntegrator s;
    s.shooting.global_paths = -2, refused(s, "photon paths must not be negative"), s = {};
    s.shooting.caustic_paths = -2, refused(s, "photon paths must not be negative"), s = {};
    s.shooting.max_depth = -1, refused(s, "maxphotondepth"), s = {};
    s.estimates.nused = -1, refused(s, "nused"), s = {};
    s.estimates.nused = 1, refused(s, "at least 2"), s = {};
    s.estimates.nused = 1 << 30, refused(s, "2^24 photons"), s = {};
    s.estimates.radius = -1, refused(s, "radius"), s = {};
    s.estimates.caustic_radius = nan, refused(s, "not finite"), s = {};
    s.estimates.radius = kInfinity, refused(s, "not finite"), s = {};
    s.alpha = 0, refused(s, "alpha"), s = {};
    s.alpha = nan, refused(s, "not finite"), s = {};
    s.max_depth = -1, refused(s, "maxdepth");
    PhotonMapIntegrator p;
    p.gather_samples = 0, refused(p, "finalgathersamples"), p = {};
    p.passes = 0, refused(p, "passes");
    LightPathIntegrator l;
    l.paths = 0, refused(l, "lightpaths");
    l.paths = -2, refused(l, "lightpaths");
}
