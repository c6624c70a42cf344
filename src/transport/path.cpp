// Path tracing (Kajiya 1986) with next-event estimation and multiple importance sampling; PBRT 4th ed., 13.4. Paths of a batch go in step, a
// vertex at a time: each is what it would be by itself, but their numbers are drawn together, their shadow rays are traced together, and
// what happens to them at diffuse surfaces is worked out eight at a time.
#include "diffuse_lanes.h"
#include "path_in_flight.h"

#include <algorithm>

namespace nephroid {

namespace {

using Paths = std::span<PathInFlight*>;

/// The numbers of one use at the vertices where the paths are, which are as far along all of them.
void draw(Paths paths, std::uint32_t use, Vec2 Drawn::*numbers) {
    draw_2d(paths, dimension::of(paths.front()->walk.vertex, use),
            [&](PathInFlight& path) -> Vec2& { return path.v.drawn.*numbers; });
}

/// Those for which `goes_on` is true, in their order.
template <class F>
Paths keep(Paths paths, F goes_on) {
    std::size_t n = 0;
    for (PathInFlight* path : paths)
        if (goes_on(*path)) paths[n++] = path;
    return paths.first(n);
}

/// f(eight of them), and what is left.
template <class F>
void by_lanes(Paths paths, F f) {
    for (std::size_t first = 0; first < paths.size(); first += kLanes)
        f(paths.subspan(first, std::min(kLanes, paths.size() - first)));
}

/// Russian roulette: survives() of each.
Paths survivors(Paths paths, Roulette const& roulette) {
    std::array<float, kMostInStep> chance;
    std::array<float, kMostInStep> drawn;
    std::array<PathSampler*, kMostInStep> samplers;
    std::size_t n = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        chance[i] = survival(paths[i]->walk, roulette);
        if (chance[i] < 1.0f) samplers[n++] = &paths[i]->c.sampler;
    }
    if (n == 0) return paths;
    draw_1d({samplers.data(), n}, roulette_dimension(paths.front()->walk), drawn.data());
    float const* u = drawn.data();
    float const* q = chance.data();
    return keep(paths, [&](PathInFlight& path) {
        float const survival = *q++;
        if (!(survival < 1.0f)) return true;
        if (*u++ >= survival) return false;
        path.walk.beta /= survival;
        return true;
    });
}

}  // namespace

void follow_paths(PathIntegrator const& p, std::span<PathInFlight*> paths) {
    EmissionWeight const weight = !p.sample_lights    ? EmissionWeight::All
                                  : p.sample_bsdf_mis ? EmissionWeight::Mis
                                                      : EmissionWeight::SpecularOnly;
    auto const most = static_cast<std::uint32_t>(p.max_depth);
    if (paths.empty()) return;
    PathContext const& any = paths.front()->c;
    bool const lanes =
        !any.trace && !any.world.encloses() && p.hemisphere == HemisphereSampling::Cosine;
    bool const light_in_lanes = any.world.has_lone_flat_light() && !any.world.passes_partly();
    while (!paths.empty()) {
        // The ray finds a surface, and what that surface (or the environment) emits.
        paths = keep(paths, [&](PathInFlight& path) {
            auto& [c, walk, met, v, seen, aov] = path;
            if (!advance(c, walk, weight, v, seen[walk.path_class.ends_on_light()])) return false;
            v.in_lanes = lanes && prepare_in_lanes(c, v);
            bool const scatters = v.in_lanes || prepare(c, walk, v);
            if (aov) record_first_hit(c, walk, scatters, v, aov);
            // A path of max_depth bounces has max_depth + 1 segments; emission at its end is in already.
            return scatters && walk.vertex < most;
        });
        if (paths.empty()) return;
        Paths const together{paths.begin(), std::partition(paths.begin(), paths.end(), [](PathInFlight* path) {
                                 return path->v.in_lanes;
                             })};
        Paths const singly = paths.subspan(together.size());
        // Next-event estimation: one more segment, aimed at a light.
        if (p.sample_lights) {
            draw(paths, dimension::kLight, &Drawn::light);
            auto const one = [&](PathInFlight& path) {
                if (!path.v.is.delta)
                    add_direct(path.c, path.walk, path.v, p.sample_bsdf_mis, path.seen);
            };
            if (light_in_lanes) {
                by_lanes(together, [&](Paths eight) { DiffuseLanes(eight).add_direct(p.sample_bsdf_mis); });
            } else {
                for (PathInFlight* path : together) orient(path->walk, path->v), one(*path);
            }
            for (PathInFlight* path : singly) one(*path);
        }
        // The path goes on by scattering, and ends by chance.
        draw(paths, dimension::kDirection, &Drawn::direction);
        std::size_t n = 0;
        by_lanes(together, [&](Paths eight) {
            LaneMask const going = DiffuseLanes(eight).scatter();
            for (std::size_t i = 0; i < eight.size(); ++i)
                if ((going >> i & 1u) != 0) paths[n++] = eight[i];
        });
        for (PathInFlight* path : singly)
            if (scatter(path->c, path->walk, path->v)) paths[n++] = path;
        // A traced path says what chance decided.
        if (any.trace)
            paths = keep(paths.first(n), [&](PathInFlight& path) { return survives(path.c, path.walk, p.roulette); });
        else
            paths = survivors(paths.first(n), p.roulette);
    }
}

}  // namespace nephroid
