// Path tracing (Kajiya 1986) with next-event estimation and multiple importance sampling; PBRT 4th ed., 13.4. Many paths in step.
#include "in_step.h"

namespace nephroid {

namespace {

/// Russian roulette: survives() of each.
Paths survivors(Paths paths, Roulette const& roulette) {
    std::array<float, kMostInStep> chance;
    std::array<float, kMostInStep> drawn{};
    std::array<PathInFlight*, kMostInStep> asking;
    std::size_t n = 0;
    // Chance is what no branch can be predicted by: there is none but for the lucky case that nobody takes any.
    for (std::size_t i = 0; i < paths.size(); ++i) {
        chance[i] = survival(paths[i]->walk, roulette);
        asking[n] = paths[i];
        n += takes_chance(chance[i]) ? 1 : 0;
    }
    if (n == 0) return paths;
    draw_1d(Paths{asking.data(), n}, roulette_dimension(paths.front()->walk), drawn.data());
    float const* u = drawn.data();
    float const* q = chance.data();
    return keep(paths, [&](PathInFlight& path) {
        bool const takes = takes_chance(*q);
        float const survival = takes ? *q : 1.0f;
        bool const dies = takes & (*u >= survival);
        ++q;
        u += takes ? 1 : 0;
        path.walk.beta /= survival;
        return !dies;
    });
}

}  // namespace

void follow_paths(PathIntegrator const& p, std::span<PathInFlight*> paths) {
    if (paths.empty()) return;
    EmissionWeight const weight = !p.sample_lights    ? EmissionWeight::All
                                  : p.sample_bsdf_mis ? EmissionWeight::Mis
                                                      : EmissionWeight::SpecularOnly;
    auto const most = static_cast<std::uint32_t>(p.max_depth);
    bool const traced = paths.front()->c.trace != nullptr;
    bool const lanes = goes_in_lanes(paths.front()->c);
    AtVertices const what{p.sample_lights, p.sample_bsdf_mis};
    for (std::uint32_t vertex = 0; !paths.empty(); ++vertex) {
        trace_rays(paths);
        // A path of max_depth bounces has max_depth + 1 segments; emission at its end is in already.
        paths = keep(paths, [&](PathInFlight& path) { return arrive(path, weight, lanes) && vertex < most; });
        // Light is sampled; the path goes on by scattering, and ends by chance.
        auto const [together, singly] = split(paths);
        paths = joined(
            {scatter_together(together, what, NothingElse{}), scatter_singly(singly, what, NothingElse{})});
        paths = traced
                    ? keep(paths, [&](PathInFlight& path) { return survives(path.c, path.walk, p.roulette); })
                    : survivors(paths, p.roulette);
    }
}

}  // namespace nephroid
