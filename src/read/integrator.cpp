#include "options.h"

#include <algorithm>
#include <array>

namespace nephroid {

namespace {

/// "maxdepth", or "segments" N of the course's tracers: N path segments are N - 1 bounces.
int max_depth(Params& p) {
    int depth = p.integer("maxdepth", 5);
    if (p.find("segments")) {
        if (p.find("maxdepth")) p.fail("give either \"maxdepth\" or \"segments\", not both");
        int const segments = p.integer("segments", 1);
        if (segments < 1) p.fail("\"segments\" must be at least 1");
        depth = segments - 1;
    }
    if (depth < 0) p.fail("\"maxdepth\" must not be negative");
    return depth;
}

Roulette roulette(Params& p, RouletteKind otherwise) {
    constexpr std::array kKinds{RouletteKind::Throughput, RouletteKind::Fixed, RouletteKind::None};
    Roulette r;
    r.kind =
        kKinds[p.choice("roulette", {"throughput", "fixed", "none"}, static_cast<std::size_t>(otherwise))];
    r.alpha = p.number("alpha", r.alpha);
    if (!(r.alpha > 0 && r.alpha <= 1)) p.fail("\"alpha\" must be above 0 and at most 1");
    return r;
}

HemisphereSampling hemisphere(Params& p) {
    return p.choice("hemisphere", {"cosine", "uniform"}, 0) == 0 ? HemisphereSampling::Cosine
                                                                 : HemisphereSampling::Uniform;
}

/// pbrt's "lightsampler", and where on a shape it draws.
LightSampling light_sampling(Params& p) {
    constexpr std::array kChoices{LightChoice::Bvh, LightChoice::Power, LightChoice::Uniform,
                                  LightChoice::Bvh};
    constexpr std::array kShapes{ShapeSampling::SolidAngle, ShapeSampling::Area, ShapeSampling::VisibleArea,
                                 ShapeSampling::Projected, ShapeSampling::VisibleUnweighed};
    LightSampling l;
    std::size_t const choice = p.choice("lightsampler", {"bvh", "power", "uniform", "exhaustive"}, 0);
    if (choice == 3) p.note("light sampler \"exhaustive\" is not built: \"bvh\" stands in");
    l.choice = kChoices[choice];
    l.shapes = kShapes[p.choice("shapesampling",
                                {"solidangle", "area", "visiblearea", "projected", "visibleunweighed"}, 0)];
    return l;
}

PathIntegrator path(Params& p) {
    PathIntegrator i;
    i.max_depth = max_depth(p);
    i.roulette = roulette(p, RouletteKind::Throughput);
    i.sample_lights = p.boolean("samplelights", true);
    i.sample_bsdf_mis = p.boolean("mis", true);
    i.hemisphere = hemisphere(p);
    if (p.boolean("regularize", false)) p.note("\"regularize\" is not supported yet and changes nothing");
    i.lights = light_sampling(p);
    return i;
}

/// pbrt's tutorial tracers: no roulette, no MIS.
PathIntegrator simple_path(Params& p) {
    PathIntegrator i;
    i.max_depth = max_depth(p);
    i.roulette = roulette(p, RouletteKind::None);
    i.sample_lights = p.boolean("samplelights", true);
    i.sample_bsdf_mis = false;
    // pbrt's chooses lights uniformly; how they are chosen changes noise alone.
    i.lights = light_sampling(p);
    i.hemisphere = p.boolean("samplebsdf", true) ? HemisphereSampling::Cosine : HemisphereSampling::Uniform;
    return i;
}

DirectIntegrator direct(Params& p) {
    constexpr std::array kStrategies{DirectStrategy::Mis, DirectStrategy::Light, DirectStrategy::Bsdf,
                                     DirectStrategy::Mis, DirectStrategy::Mis};
    DirectIntegrator i;
    i.max_depth = max_depth(p);
    // "all" and "one" are pbrt-v3's: every light at each hit, or one of them. Both converge to the same.
    i.strategy = kStrategies[p.choice("strategy", {"mis", "light", "bsdf", "all", "one"}, 0)];
    i.hemisphere = hemisphere(p);
    i.lights = light_sampling(p);
    return i;
}

PathIntegrator random_walk(Params& p) {
    PathIntegrator i;
    i.max_depth = max_depth(p);
    i.roulette = roulette(p, RouletteKind::None);
    i.sample_lights = false;
    i.hemisphere = HemisphereSampling::Uniform;
    return i;
}

/// A number of things, at least `least`; or `otherwise`, which may be -1 for what follows from something else.
int count(Params& p, char const* name, int otherwise, int least) {
    int const n = p.integer(name, otherwise);
    if (n < least && n != otherwise)
        p.fail(std::string("\"") + name + "\" must be at least " + std::to_string(least));
    return n;
}
float radius(Params& p, char const* name) {
    float const r = p.number(name, 0);
    if (!(r >= 0)) p.fail(std::string("\"") + name + "\" must be above 0, or 0 for one that suits the scene");
    return r;
}
/// One parameter of two names.
char const* either(Params& p, char const* name, char const* other) {
    if (p.find(name) && p.find(other))
        p.fail(std::string("give either \"") + name + "\" or \"" + other + "\", not both");
    return p.find(other) ? other : name;
}

/// What both photon integrators read; names of pbrt-v2's photonmap where it has one.
template <class PhotonIntegrator>
void photon_parameters(Params& p, PhotonIntegrator& i) {
    constexpr std::array kKernels{Kernel::Box, Kernel::Cone, Kernel::Epanechnikov, Kernel::Gaussian};
    constexpr std::array kViews{PhotonView::None, PhotonView::Global, PhotonView::Caustic, PhotonView::Both,
                                PhotonView::Radiance};
    i.shooting.caustic_paths = count(p, "causticphotons", i.shooting.caustic_paths, 0);
    i.shooting.max_depth = count(p, "maxphotondepth", i.shooting.max_depth, 0);
    i.shooting.aim = p.boolean("aim", i.shooting.aim);
    i.estimates.nused = count(p, "nused", i.estimates.nused, 0);
    if (i.estimates.nused == 1)
        p.fail(
            "\"nused\" is 1, and the farthest photon of an estimate only tells its radius: give 0 for all "
            "within "
            "the radius, or at least 2");
    i.estimates.caustic_radius = radius(p, "causticradius");
    i.estimates.kernel = kKernels[p.choice("kernel", {"box", "cone", "epanechnikov", "gaussian"},
                                           static_cast<std::size_t>(i.estimates.kernel))];
    i.estimates.edge_correction = p.boolean("edgecorrection", i.estimates.edge_correction);
    i.alpha = p.number("alpha", i.alpha);
    if (!(i.alpha > 0 && i.alpha <= 1)) p.fail("\"alpha\" must be above 0 and at most 1");
    i.visualize = kViews[p.choice("visualize", {"none", "global", "caustic", "both", "radiance"}, 0)];
    i.lights = light_sampling(p);
}

/// pbrt-v2's. There causticphotons and indirectphotons are to be stored, and shooting goes on until they are; here they are the
/// paths that a pass emits, which the law asks for.
PhotonMapIntegrator photon_map(Params& p) {
    PhotonMapIntegrator i;
    i.max_depth = count(p, either(p, "maxspeculardepth", "maxdepth"), i.max_depth, 0);
    i.shooting.global_paths = count(p, "indirectphotons", i.shooting.global_paths, 0);
    i.estimates.radius = radius(p, either(p, "radius", "maxdist"));
    photon_parameters(p, i);
    i.final_gather = p.boolean("finalgather", i.final_gather);
    i.gather_samples = count(p, "finalgathersamples", i.gather_samples, 1);
    i.passes = count(p, "passes", i.passes, 1);
    if (p.find("gatherangle"))
        p.note("\"gatherangle\" changes nothing: gather rays follow the surface alone");
    return i;
}

/// pbrt-v4's. Its radius is 1 unless it is given; here one that suits the scene.
SppmIntegrator sppm(Params& p) {
    SppmIntegrator i;
    i.max_depth = max_depth(p);
    i.shooting.max_depth = i.max_depth;
    // 0 is pbrt's other word for as many as there are pixels.
    int const paths = count(p, "photonsperiteration", i.shooting.global_paths, 0);
    i.shooting.global_paths = paths == 0 ? -1 : paths;
    i.estimates.radius = radius(p, "radius");
    photon_parameters(p, i);
    return i;
}

LightPathIntegrator light_path(Params& p) {
    LightPathIntegrator i;
    i.max_depth = max_depth(p);
    i.paths = count(p, "lightpaths", i.paths, 1);
    i.lights = light_sampling(p);
    return i;
}

}  // namespace

Integrator make_integrator(std::string const& type, Params& p) {
    // Media have notes of their own, so volpath says nothing more.
    if (type == "path" || type == "volpath") return path(p);
    if (type == "simplepath") return simple_path(p);
    if (type == "randomwalk") return random_walk(p);
    if (type == "whitted") return WhittedIntegrator{max_depth(p), light_sampling(p)};
    if (type == "direct" || type == "directlighting") return direct(p);
    if (type == "photonmap") return photon_map(p);
    if (type == "sppm") return sppm(p);
    if (type == "lightpath") return light_path(p);
    constexpr std::array<std::string_view, 6> kKnown{"bdpt",     "mlt",          "ao", "ambientocclusion",
                                                     "function", "simplevolpath"};
    bool const known = std::find(kKnown.begin(), kKnown.end(), type) != kKnown.end();
    p.note((known ? "is not available yet: \"path\" stands in" : "is unknown: \"path\" stands in") +
           did_you_mean(type, {"path", "volpath", "simplepath", "randomwalk", "whitted", "direct",
                               "photonmap", "sppm", "lightpath"}));
    p.ignore_all();
    PathIntegrator i;
    i.max_depth = max_depth(p);
    return i;
}

}  // namespace nephroid
