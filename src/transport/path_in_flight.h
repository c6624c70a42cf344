// A path from the camera, between two vertices or at one: what the integrator that follows many of them in step keeps of each.
#pragma once

#include "walk.h"

#include <array>
#include <span>

namespace nephroid {

struct PathInFlight {
    PathContext c;
    Walk walk;
    RawHit met;  // what the camera's ray meets
    Vertex v;
    SeenLight seen;
    AovSample* aov = nullptr;  // of the first hit, where somebody asks
};

/// Draws the two numbers of one dimension for every path, into to(path), which is called in their order.
template <class To>
void draw_2d(std::span<PathInFlight* const> paths, std::uint32_t dimension, To to) {
    std::array<PathSampler*, kMostInStep> samplers;
    std::array<Vec2, kMostInStep> drawn;
    for (std::size_t i = 0; i < paths.size(); ++i) samplers[i] = &paths[i]->c.sampler;
    draw_2d(std::span<PathSampler* const>{samplers.data(), paths.size()}, dimension, drawn.data());
    for (std::size_t i = 0; i < paths.size(); ++i) to(*paths[i]) = drawn[i];
}

/// Draws the number of one dimension for every path.
inline void draw_1d(std::span<PathInFlight* const> paths, std::uint32_t dimension, float* drawn) {
    std::array<PathSampler*, kMostInStep> samplers;
    for (std::size_t i = 0; i < paths.size(); ++i) samplers[i] = &paths[i]->c.sampler;
    draw_1d(std::span<PathSampler* const>{samplers.data(), paths.size()}, dimension, drawn);
}

/// Radiance along the camera rays of `paths`, which is in their `seen` (and c.shadows) in the end. All are at their first ray, whose hit is
/// in `met`. The list is used up.
void follow_paths(PathIntegrator const& p, std::span<PathInFlight*> paths);
void follow_paths(SppmIntegrator const& p, std::span<PathInFlight*> paths);
template <class Integrator>
concept GoesInStep = requires(Integrator const& p, std::span<PathInFlight*> paths) {
    follow_paths(p, paths);
};

}  // namespace nephroid
