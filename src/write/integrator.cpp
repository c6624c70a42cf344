// Integrators, with all that is not as a reader takes it anyway.
#include "writer.h"

#include "scene/match.h"

namespace nephroid {

namespace {

template <class T, std::size_t N>
std::string_view name_in(std::array<std::string_view, N> const& names, T x) {
    return names[static_cast<std::size_t>(x)];
}

void parameters(ParamText& p, LightSampling const& l) {
    constexpr std::array<std::string_view, 3> kChoices{"bvh", "power", "uniform"};
    constexpr std::array<std::string_view, 5> kShapes{"solidangle", "area", "visiblearea", "projected",
                                                      "visibleunweighed"};
    p.choice("lightsampler", name_in(kChoices, l.choice), "bvh");
    p.choice("shapesampling", name_in(kShapes, l.shapes), "solidangle");
}
void parameters(ParamText& p, HemisphereSampling h) {
    p.choice("hemisphere", h == HemisphereSampling::Uniform ? "uniform" : "cosine", "cosine");
}

/// What both photon integrators have.
template <class Photons>
void write_photons(ParamText& p, Photons const& i) {
    Photons const standard;
    constexpr std::array<std::string_view, 4> kKernels{"box", "cone", "epanechnikov", "gaussian"};
    constexpr std::array<std::string_view, 5> kViews{"none", "global", "caustic", "both", "radiance"};
    p.number("radius", i.estimates.radius, 0);
    p.integer("causticphotons", i.shooting.caustic_paths, -1);
    p.boolean("aim", i.shooting.aim, true);
    p.integer("nused", i.estimates.nused, standard.estimates.nused);
    p.number("causticradius", i.estimates.caustic_radius, 0);
    p.choice("kernel", name_in(kKernels, i.estimates.kernel), "epanechnikov");
    p.boolean("edgecorrection", i.estimates.edge_correction, standard.estimates.edge_correction);
    p.number("alpha", i.alpha, standard.alpha);
    p.choice("visualize", name_in(kViews, i.visualize), "none");
    parameters(p, i.lights);
}

char const* parameters(ParamText& p, PathIntegrator const& i) {
    constexpr std::array<std::string_view, 3> kRoulettes{"throughput", "fixed", "none"};
    p.choice("roulette", name_in(kRoulettes, i.roulette.kind), "throughput");
    p.number("alpha", i.roulette.alpha, Roulette{}.alpha);
    p.boolean("samplelights", i.sample_lights, true);
    p.boolean("mis", i.sample_bsdf_mis, true);
    parameters(p, i.hemisphere);
    parameters(p, i.lights);
    return "path";
}
char const* parameters(ParamText& p, WhittedIntegrator const& i) {
    parameters(p, i.lights);
    return "whitted";
}
char const* parameters(ParamText& p, DirectIntegrator const& i) {
    constexpr std::array<std::string_view, 3> kStrategies{"mis", "light", "bsdf"};
    p.choice("strategy", name_in(kStrategies, i.strategy), "mis");
    parameters(p, i.hemisphere);
    parameters(p, i.lights);
    return "direct";
}
char const* parameters(ParamText& p, PhotonMapIntegrator const& i) {
    p.integer("indirectphotons", i.shooting.global_paths);
    p.integer("maxphotondepth", i.shooting.max_depth, PhotonShooting{}.max_depth);
    p.boolean("finalgather", i.final_gather, true);
    p.integer("finalgathersamples", i.gather_samples, 16);
    p.integer("passes", i.passes, 1);
    write_photons(p, i);
    return "photonmap";
}
char const* parameters(ParamText& p, SppmIntegrator const& i) {
    p.integer("photonsperiteration", i.shooting.global_paths, -1);
    p.integer("maxphotondepth", i.shooting.max_depth, i.max_depth);
    write_photons(p, i);
    return "sppm";
}
char const* parameters(ParamText& p, LightPathIntegrator const& i) {
    p.integer("lightpaths", i.paths, -1);
    parameters(p, i.lights);
    return "lightpath";
}

}  // namespace

void Writer::write_integrator() {
    Settings const& s = scene_.settings;
    auto const* map = std::get_if<PhotonMapIntegrator>(&s.integrator);
    if (map && map->shooting.global_paths < 0)
        refuse(s.integrator_where, "as many photon paths as pixels in photonmap (give a number)");
    auto const* sppm = std::get_if<SppmIntegrator>(&s.integrator);
    if (sppm && sppm->shooting.global_paths == 0) refuse(s.integrator_where, "sppm without photons");
    ParamText p;
    p.integer("maxdepth", match(s.integrator, [](auto const& i) { return i.max_depth; }));
    std::string type = match(s.integrator, [&](auto const& i) { return parameters(p, i); });
    // pbrt's path tracer knows no media.
    if (type == "path" && !media_.empty()) type = "volpath";
    head_ += "Integrator \"" + type + '"' + p.text() + '\n';
}

}  // namespace nephroid
