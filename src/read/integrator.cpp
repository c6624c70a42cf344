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

PathIntegrator path(Params& p) {
    PathIntegrator i;
    i.max_depth = max_depth(p);
    i.roulette = roulette(p, RouletteKind::Throughput);
    i.sample_lights = p.boolean("samplelights", true);
    i.sample_bsdf_mis = p.boolean("mis", true);
    i.hemisphere = p.choice("hemisphere", {"cosine", "uniform"}, 0) == 0 ? HemisphereSampling::Cosine
                                                                         : HemisphereSampling::Uniform;
    if (p.boolean("regularize", false)) p.note("\"regularize\" is not supported yet and changes nothing");
    // How lights are chosen changes noise alone.
    p.find("lightsampler", {ParamType::String});
    return i;
}

/// pbrt's tutorial tracers: no roulette, no MIS.
PathIntegrator simple_path(Params& p) {
    PathIntegrator i;
    i.max_depth = max_depth(p);
    i.roulette = roulette(p, RouletteKind::None);
    i.sample_lights = p.boolean("samplelights", true);
    i.sample_bsdf_mis = false;
    i.hemisphere = p.boolean("samplebsdf", true) ? HemisphereSampling::Cosine : HemisphereSampling::Uniform;
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

}  // namespace

Integrator make_integrator(std::string const& type, Params& p) {
    // Media have notes of their own, so volpath says nothing more.
    if (type == "path" || type == "volpath") return path(p);
    if (type == "simplepath") return simple_path(p);
    if (type == "randomwalk") return random_walk(p);
    if (type == "whitted") return WhittedIntegrator{max_depth(p)};
    if (type == "direct" || type == "directlighting") {
        p.find("strategy");
        return DirectIntegrator{max_depth(p)};
    }
    constexpr std::array<std::string_view, 9> kKnown{
        "bdpt",     "mlt",           "sppm",     "lightpath", "ao", "ambientocclusion",
        "function", "simplevolpath", "photonmap"};
    bool const known = std::find(kKnown.begin(), kKnown.end(), type) != kKnown.end();
    p.note((known ? "is not available yet: \"path\" stands in" : "is unknown: \"path\" stands in") +
           did_you_mean(type, {"path", "volpath", "simplepath", "randomwalk", "whitted", "direct"}));
    p.ignore_all();
    PathIntegrator i;
    i.max_depth = max_depth(p);
    return i;
}

}  // namespace nephroid
