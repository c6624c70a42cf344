// Whitted 1980, "An Improved Illumination Model for Shaded Display": a tree of rays. At mirrors and glass both branches are
// followed; at other surfaces light is sampled and the tree ends. Emission counts where it is seen, directly or by mirrors.
#include "walk.h"

namespace nephroid {

namespace {

/// `node` numbers the tree as a heap, and names the random numbers of this branch.
SeenLight trace(WhittedIntegrator const& p, PathContext& c, Walk walk, int depth, std::uint32_t node,
                AovSample* aov) {
    SeenLight seen;
    walk.vertex = depth == 0 ? 0 : node;
    Vertex v;
    if (!advance(c, walk, EmissionWeight::All, v, seen[walk.path_class.ends_on_light()])) return seen;
    bool const scatters = prepare(c, walk, v);
    if (aov) record_first_hit(c, walk, scatters, v, aov);
    if (!scatters || depth >= p.max_depth) return seen;
    if (!v.is.delta)
        seen[walk.path_class.ends_after(v.is.near_specular)] += walk.beta * sample_direct(c, walk, v, false);

    DeltaBranches const branches = delta_branches(v.bsdf, v.wo_local, Mode::Radiance);
    std::uint32_t child = 2 * node;
    for (auto const& branch : {branches.reflected, branches.transmitted}) {
        Walk next = walk;
        if (branch && follow(c, next, v, *branch)) seen += trace(p, c, next, depth + 1, child, nullptr);
        ++child;
    }
    return seen;
}

}  // namespace

SeenLight radiance(WhittedIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov) {
    return trace(p, c, Walk::from_camera(c, ray), 0, 1, aov);
}

}  // namespace nephroid
