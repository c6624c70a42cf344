// Path tracing (Kajiya 1986) with next-event estimation and multiple importance sampling; PBRT 4th ed., 13.4. Paths of a batch go in step, a
// vertex at a time: each is what it would be by itself, but their numbers are drawn together, their shadow rays are traced together, and
// what happens to them at diffuse surfaces is worked out eight at a time.
#include "diffuse_lanes.h"
#include "path_in_flight.h"

#include <algorithm>

namespace nephroid {

namespace {

using Paths = std::span<PathInFlight*>;

/// One number, or two, for every path.
template <class T>
using Numbers = std::array<T, kMostInStep>;

/// Where paths draw their numbers.
class Samplers {
  public:
    void add(PathInFlight& path) { samplers_[n_++] = &path.c.sampler; }
    [[nodiscard]] std::span<PathSampler* const> all() const { return {samplers_.data(), n_}; }

  private:
    Numbers<PathSampler*> samplers_;
    std::size_t n_ = 0;
};

/// The numbers of one use at the vertices where the paths are, which are as far along all of them.
void draw(Paths paths, std::uint32_t use, Vec2 Drawn::*numbers) {
    if (paths.empty()) return;
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

/// Russian roulette: survives() of each.
Paths survivors(Paths paths, Roulette const& roulette) {
    Numbers<float> chance;
    Numbers<float> drawn;
    Samplers samplers;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        chance[i] = survival(paths[i]->walk, roulette);
        if (chance[i] < 1.0f) samplers.add(*paths[i]);
    }
    if (samplers.all().empty()) return paths;
    draw_1d(samplers.all(), roulette_dimension(paths.front()->walk), drawn.data());
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

/// The ray finds a surface, and what that surface (or the environment) emits. False where the path ends.
bool arrive(PathInFlight& path, EmissionWeight weight, bool in_lanes) {
    auto& [c, walk, met, v, seen, aov] = path;
    bool const records = aov && walk.vertex == 0;
    v.mesh = in_lanes && !records ? c.world.plain_mesh(met) : nullptr;
    v.in_lanes = v.mesh != nullptr;
    if (v.mesh) {
        // Most of what paths meet: no more is asked of the surface by itself.
        walk.met = nullptr;
        v.hit.t = met.t;
        make_plain_bsdf(v.mesh->reflectance, c.lambda, v.bsdf);
        v.is = {};
        return true;
    }
    if (!advance(c, walk, weight, v, seen[walk.path_class.ends_on_light()])) return false;
    v.in_lanes = in_lanes && prepare_in_lanes(c, v);
    bool const scatters = v.in_lanes || prepare(c, walk, v);
    if (records) record_first_hit(c, walk, scatters, v, aov);
    return scatters;
}

/// Next-event estimation: one more segment, aimed at a light.
void add_direct(PathInFlight& path, bool mis) {
    if (!path.v.is.delta) add_direct(path.c, path.walk, path.v, mis, path.seen);
}

/// Light sampling and scattering, a path at a time. Those that go on.
Paths scatter_singly(PathIntegrator const& p, Paths paths) {
    if (p.sample_lights) {
        draw(paths, dimension::kLight, &Drawn::light);
        for (PathInFlight* path : paths) add_direct(*path, p.sample_bsdf_mis);
    }
    draw(paths, dimension::kDirection, &Drawn::direction);
    return keep(paths, [](PathInFlight& path) { return scatter(path.c, path.walk, path.v); });
}

/// … of those that are `in_lanes`, eight at a time.
Paths scatter_together(PathIntegrator const& p, Paths paths) {
    if (paths.empty()) return paths;
    World const& world = paths.front()->c.world;
    bool const light_in_lanes = world.has_lone_flat_light() && !world.passes_partly();
    std::uint32_t const vertex = paths.front()->walk.vertex;
    Samplers samplers;
    for (PathInFlight* path : paths) samplers.add(*path);
    Numbers<Vec2> light;
    Numbers<Vec2> direction;
    if (p.sample_lights) draw_2d(samplers.all(), dimension::of(vertex, dimension::kLight), light.data());
    draw_2d(samplers.all(), dimension::of(vertex, dimension::kDirection), direction.data());
    std::size_t n = 0;
    for (std::size_t first = 0; first < paths.size(); first += kLanes) {
        Paths const eight = paths.subspan(first, std::min(kLanes, paths.size() - first));
        DiffuseLanes const vertices(eight);
        if (p.sample_lights && light_in_lanes) {
            vertices.add_direct(&light[first], p.sample_bsdf_mis);
        } else if (p.sample_lights) {
            vertices.complete_hits();
            for (std::size_t i = 0; i < eight.size(); ++i) {
                PathInFlight& path = *eight[i];
                orient(path.walk, path.v);
                path.v.drawn.light = light[first + i];
                add_direct(path, p.sample_bsdf_mis);
            }
        }
        LaneMask const going = vertices.scatter(&direction[first]);
        for (std::size_t i = 0; i < eight.size(); ++i)
            if ((going >> i & 1u) != 0) paths[n++] = eight[i];
    }
    return paths.first(n);
}

}  // namespace

void follow_paths(PathIntegrator const& p, std::span<PathInFlight*> paths) {
    if (paths.empty()) return;
    EmissionWeight const weight = !p.sample_lights    ? EmissionWeight::All
                                  : p.sample_bsdf_mis ? EmissionWeight::Mis
                                                      : EmissionWeight::SpecularOnly;
    auto const most = static_cast<std::uint32_t>(p.max_depth);
    PathContext const& any = paths.front()->c;
    // A path that is traced says what happens to it, step by step.
    bool const lanes =
        !any.trace && !any.world.encloses() && p.hemisphere == HemisphereSampling::Cosine;
    for (std::uint32_t vertex = 0; !paths.empty(); ++vertex) {
        // The camera's rays have been traced.
        for (PathInFlight* path : paths) {
            if (vertex > 0)
                any.world.intersect(path->walk.ray, kInfinity, RayKind::Bounce, path->c.stats, path->met);
            path->walk.met = &path->met;
        }
        // A path of max_depth bounces has max_depth + 1 segments; emission at its end is in already.
        paths = keep(paths, [&](PathInFlight& path) { return arrive(path, weight, lanes) && vertex < most; });
        // It goes on by scattering, and ends by chance.
        auto const by_itself = std::partition(paths.begin(), paths.end(),
                                              [](PathInFlight const* path) { return path->v.in_lanes; });
        Paths const singly = scatter_singly(p, {by_itself, paths.end()});
        Paths const together = scatter_together(p, {paths.begin(), by_itself});
        auto const end = std::copy(singly.begin(), singly.end(), together.end());
        paths = {paths.begin(), end};
        if (any.trace) {
            paths = keep(paths,
                         [&](PathInFlight& path) { return survives(path.c, path.walk, p.roulette); });
        } else {
            paths = survivors(paths, p.roulette);
        }
    }
}

}  // namespace nephroid
