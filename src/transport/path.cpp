// Path tracing (Kajiya 1986) with next-event estimation and multiple importance sampling; PBRT 4th ed., 13.4. Paths of a batch go in step, a
// vertex at a time: each is what it would be by itself, but their numbers are drawn together, and so are their shadow rays traced.
#include "path_in_flight.h"

namespace nephroid {

namespace {

/// The numbers of one use at the vertices where the paths are, which are as far along all of them.
void draw(std::span<PathInFlight* const> paths, std::uint32_t use, Vec2 Drawn::*numbers) {
    draw_2d(paths, dimension::of(paths.front()->walk.vertex, use),
            [&](PathInFlight& path) -> Vec2& { return path.v.drawn.*numbers; });
}

/// Those for which `goes_on` is true, in their order.
template <class F>
std::span<PathInFlight*> keep(std::span<PathInFlight*> paths, F goes_on) {
    std::size_t n = 0;
    for (PathInFlight* path : paths)
        if (goes_on(*path)) paths[n++] = path;
    return paths.first(n);
}

}  // namespace

void follow_paths(PathIntegrator const& p, std::span<PathInFlight*> paths) {
    EmissionWeight const weight = !p.sample_lights    ? EmissionWeight::All
                                  : p.sample_bsdf_mis ? EmissionWeight::Mis
                                                      : EmissionWeight::SpecularOnly;
    auto const most = static_cast<std::uint32_t>(p.max_depth);
    while (!paths.empty()) {
        // The ray finds a surface, and what that surface (or the environment) emits.
        paths = keep(paths, [&](PathInFlight& path) {
            auto& [c, walk, met, v, seen, aov] = path;
            if (!advance(c, walk, weight, v, seen[walk.path_class.ends_on_light()])) return false;
            bool const scatters = prepare(c, walk, v);
            if (aov) record_first_hit(c, walk, scatters, v, aov);
            // A path of max_depth bounces has max_depth + 1 segments; emission at its end is in already.
            return scatters && walk.vertex < most;
        });
        if (paths.empty()) return;
        // Next-event estimation: one more segment, aimed at a light.
        if (p.sample_lights) {
            draw(paths, dimension::kLight, &Drawn::light);
            for (PathInFlight* path : paths)
                if (!path->v.is.delta)
                    add_direct(path->c, path->walk, path->v, p.sample_bsdf_mis, path->seen);
        }
        // The path goes on by scattering, and ends by chance.
        draw(paths, dimension::kDirection, &Drawn::direction);
        paths = keep(paths, [&](PathInFlight& path) {
            return scatter(path.c, path.walk, path.v) && survives(path.c, path.walk, p.roulette);
        });
    }
}

}  // namespace nephroid
