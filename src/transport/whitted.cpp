// Whitted 1980, "An Improved Illumination Model for Shaded Display": a tree of rays. At mirrors and glass both branches are
// followed; at other surfaces light is sampled and the tree ends. Emission counts where it is seen, directly or by mirrors.
#include "path_trace.h"
#include "sampling/hash.h"
#include "walk.h"

namespace nephroid {

namespace {

/// The number of a node's first or second child (`which` is 0 or 1), which is at `depth`: as in a heap, whose root is 1, down to
/// depth 27. A node owns eight of the sampler's 2^32 dimensions: below, nodes share the other half of them by a hash, in which two
/// of a thousand nodes meet in one tree of 500, and have the same random numbers then.
std::uint32_t child_of(std::uint32_t node, std::uint32_t which, int depth) {
    constexpr std::uint32_t kHeap = 1u << 28;
    static_assert(dimension::kPerVertex == 8 &&
                  dimension::kFirstVertex == 8);  // the last dimension is 2^32 - 9
    std::uint32_t const child = 2 * node + which;
    if (child < kHeap) return child;
    return kHeap +
           static_cast<std::uint32_t>(hash_keys(child, static_cast<std::uint64_t>(depth)) % (kHeap - 2));
}

/// `node` is the number of this branch in the tree, and names its random numbers.
SeenLight trace(WhittedIntegrator const& p, PathContext& c, Walk walk, int depth, std::uint32_t node,
                AovSample* aov) {
    SeenLight seen;
    walk.vertex = depth == 0 ? 0 : node;
    Vertex v;
    if (!advance(c, walk, EmissionWeight::All, v, seen[walk.path_class.ends_on_light()])) return seen;
    bool const scatters = prepare(c, walk, v);
    if (aov) record_first_hit(c, walk, scatters, v, aov);
    if (!scatters || depth >= p.max_depth) return seen;
    if (!v.is.delta) add_direct(c, walk, v, false, seen);

    DeltaBranches const branches = delta_branches(v.bsdf, v.wo_local, Mode::Radiance);
    int const here = c.trace ? c.trace->at() : 0;
    std::uint32_t which = 0;
    for (auto const& branch : {branches.reflected, branches.transmitted}) {
        Walk next = walk;
        if (c.trace) c.trace->back_to(here);
        if (branch && follow(c, next, v, *branch))
            seen += trace(p, c, next, depth + 1, child_of(node, which, depth + 1), nullptr);
        ++which;
    }
    return seen;
}

}  // namespace

SeenLight radiance(WhittedIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov) {
    return trace(p, c, Walk::from_camera(c, ray), 0, 1, aov);
}

}  // namespace nephroid
