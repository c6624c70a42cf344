// What integrators share that follow many paths in step, a vertex at a time: each path is what it would be by itself, but numbers are
// drawn together, shadow rays are traced together, and what happens at diffuse surfaces is worked out eight at a time.
#pragma once

#include "diffuse_lanes.h"
#include "path_in_flight.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

namespace nephroid {

using Paths = std::span<PathInFlight*>;

/// Those for which `goes_on` is true, in their order. No branch for what nobody can predict.
template <class F>
Paths keep(Paths paths, F goes_on) {
    std::size_t n = 0;
    for (PathInFlight* path : paths) {
        bool const goes = goes_on(*path);
        paths[n] = path;
        n += goes ? 1 : 0;
    }
    return paths.first(n);
}

/// Whether vertices may be `in_lanes` at all. A path that is traced says what happens to it, step by step.
inline bool goes_in_lanes(PathContext const& c) {
    return !c.trace && !c.world.encloses() && c.hemisphere == HemisphereSampling::Cosine;
}

/// Finds what the paths' rays meet. Those of the camera have been traced.
void trace_rays(Paths paths);
/// The surface that was met by the path's ray, and what that (or the environment) emits. False where there is none.
bool reach(PathInFlight& path, EmissionWeight weight, bool in_lanes);
/// Scattering there; false where there is none.
bool prepare(PathInFlight& path, bool in_lanes);
/// Both.
inline bool arrive(PathInFlight& path, EmissionWeight weight, bool in_lanes) {
    return reach(path, weight, in_lanes) && prepare(path, in_lanes);
}

/// The paths at vertices that are `in_lanes`, and the others.
struct Split {
    Paths together, singly;
};
Split split(Paths paths);
/// What is left of both, one after the other as they were.
Paths joined(Split const& split);

/// Fills what has been left out of hits that are `in_lanes`.
void complete_hits(Paths paths);

/// The numbers of one use at the vertices where the paths are, which are as far along all of them.
template <class To>
void draw(Paths paths, std::uint32_t use, To to) {
    if (!paths.empty()) draw_2d(paths, dimension::of(paths.front()->walk.vertex, use), to);
}

/// Next-event estimation: one more segment, aimed at a light.
inline void add_direct(PathInFlight& path, bool mis) {
    if (!path.v.is.delta) add_direct(path.c, path.walk, path.v, mis, path.seen);
}

/// What is done at vertices.
struct AtVertices {
    bool sample_lights = true, mis = true;
};
/// An integrator that asks nothing else at a vertex.
struct NothingElse {
    void operator()(PathInFlight const&) const {}
};

/// Light sampling, what `estimate` does at a vertex, and scattering, a path at a time. Those that go on.
template <class Estimate>
Paths scatter_singly(Paths paths, AtVertices what, Estimate const& estimate) {
    if (what.sample_lights)
        draw(paths, dimension::kLight, [](PathInFlight& path) -> Vec2& { return path.v.drawn.light; });
    draw(paths, dimension::kDirection, [](PathInFlight& path) -> Vec2& { return path.v.drawn.direction; });
    return keep(paths, [&](PathInFlight& path) {
        if (what.sample_lights) add_direct(path, what.mis);
        estimate(path);
        return scatter(path.c, path.walk, path.v);
    });
}

/// Eight by eight. (Made one at a time: an array of optional ones is filled with zeros by g++, tens of KB.)
class VerticesOfBatch {
  public:
    DiffuseLanes& add(Paths eight) {
        eights_[count_] = ::new (&room_[count_ * sizeof(DiffuseLanes)]) DiffuseLanes(eight);
        return *eights_[count_++];
    }
    [[nodiscard]] DiffuseLanes const& operator[](std::size_t i) const { return *eights_[i]; }

  private:
    static constexpr std::size_t kMost = kMostInStep / kLanes;
    static_assert(std::is_trivially_destructible_v<DiffuseLanes>);
    alignas(DiffuseLanes) std::array<std::byte, kMost * sizeof(DiffuseLanes)> room_;
    std::array<DiffuseLanes*, kMost> eights_;
    std::size_t count_ = 0;
};

/// … of those that are `in_lanes`, eight at a time.
template <class Estimate>
Paths scatter_together(Paths paths, AtVertices what, Estimate const& estimate) {
    if (paths.empty()) return paths;
    World const& world = paths.front()->c.world;
    bool const light_in_lanes = world.has_lone_flat_light() && !world.passes_partly();
    bool const light_singly = what.sample_lights && !light_in_lanes;
    constexpr bool kEstimates = !std::is_same_v<Estimate, NothingElse>;
    std::array<Vec2, kMostInStep> light;
    std::array<Vec2, kMostInStep> direction;
    auto const to = [&](std::array<Vec2, kMostInStep>& numbers) {
        return [next = numbers.begin()](PathInFlight const&) mutable -> Vec2& { return *next++; };
    };
    if (what.sample_lights) draw(paths, dimension::kLight, to(light));
    draw(paths, dimension::kDirection, to(direction));
    VerticesOfBatch eights;
    WaitingReceivers waiting;
    for (std::size_t first = 0; first < paths.size(); first += kLanes) {
        DiffuseLanes& vertices = eights.add(paths.subspan(first, std::min(kLanes, paths.size() - first)));
        if (what.sample_lights && light_in_lanes) vertices.sample_light(&light[first], waiting);
    }
    world.sample_waiting(waiting);
    std::size_t n = 0;
    for (std::size_t first = 0; first < paths.size(); first += kLanes) {
        Paths const eight = paths.subspan(first, std::min(kLanes, paths.size() - first));
        DiffuseLanes const& vertices = eights[first / kLanes];
        if (what.sample_lights && light_in_lanes) vertices.add_direct(what.mis);
        if (kEstimates || light_singly) vertices.complete_hits();
        for (std::size_t i = 0; i < eight.size() && light_singly; ++i) {
            orient(eight[i]->walk, eight[i]->v);
            eight[i]->v.drawn.light = light[first + i];
            add_direct(*eight[i], what.mis);
        }
        for (PathInFlight* path : eight) estimate(*path);
        LaneMask const going = vertices.scatter(&direction[first]);
        for (std::size_t i = 0; i < eight.size(); ++i)
            if ((going >> i & 1u) != 0) paths[n++] = eight[i];
    }
    return paths.first(n);
}

}  // namespace nephroid
