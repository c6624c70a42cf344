#include "in_step.h"

namespace nephroid {

void trace_rays(Paths paths) {
    for (PathInFlight* path : paths) {
        Walk& walk = path->walk;
        bool const of_camera = walk.vertex == 0 && walk.mode == Mode::Radiance;
        if (!of_camera)
            path->c.world.intersect(walk.ray, kInfinity, RayKind::Bounce, path->c.stats, path->met);
        walk.met = &path->met;
    }
}

bool reach(PathInFlight& path, EmissionWeight weight, bool in_lanes) {
    auto& [c, walk, met, v, seen, aov] = path;
    bool const records = aov && walk.vertex == 0;
    v.mesh = in_lanes && !records ? c.world.plain_mesh(met) : nullptr;
    if (!v.mesh) return advance(c, walk, weight, v, seen[walk.path_class.ends_on_light()]);
    // Most of what paths meet: no more is asked of the surface by itself.
    walk.met = nullptr;
    v.hit.t = met.t;
    return true;
}

bool prepare(PathInFlight& path, bool in_lanes) {
    auto& [c, walk, met, v, seen, aov] = path;
    if (v.mesh) {
        v.in_lanes = true;
        make_plain_bsdf(v.mesh->reflectance, c.lambda, v.bsdf);
        v.is = {};
        return true;
    }
    bool const records = aov && walk.vertex == 0;
    v.in_lanes = in_lanes && !records && prepare_plain(c, v);
    bool const scatters = v.in_lanes || prepare(c, walk, v);
    if (records) record_first_hit(c, walk, scatters, v, aov);
    return scatters;
}

Split split(Paths paths) {
    std::array<PathInFlight*, kMostInStep> others;
    std::size_t together = 0;
    std::size_t singly = 0;
    for (PathInFlight* path : paths) {
        bool const in_lanes = path->v.in_lanes;
        paths[together] = path;
        others[singly] = path;
        together += in_lanes ? 1 : 0;
        singly += in_lanes ? 0 : 1;
    }
    std::copy_n(others.begin(), singly, paths.begin() + static_cast<std::ptrdiff_t>(together));
    return {paths.first(together), paths.subspan(together)};
}

Paths joined(Split const& split) {
    auto const end = split.together.end();
    if (split.singly.begin() == end) return {split.together.begin(), split.singly.end()};
    return {split.together.begin(), std::copy(split.singly.begin(), split.singly.end(), end)};
}

void complete_hits(Paths paths) {
    for (std::size_t first = 0; first < paths.size(); first += kLanes)
        DiffuseLanes(paths.subspan(first, std::min(kLanes, paths.size() - first))).complete_hits();
}

}  // namespace nephroid
