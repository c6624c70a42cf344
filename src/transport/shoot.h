// What the paths of a shot have in common, and what they leave.
#pragma once

#include "light_walk.h"
#include "photon_plan.h"
#include "transport/shooting.h"

namespace nephroid {

/// What all paths of a shot have in common.
struct Shoot {
    RenderJob const& job;
    ShotKind kind;
    Wavelengths lambda;
    std::uint64_t first, paths;  // numbers of the pass's block of the sequence
    std::uint32_t max_depth;
    Aim const* aim;
    bool sorts_caustics;  // a map of their own has them

    Shoot(RenderJob const& j, PhotonPlan const& p, ShotKind k, std::uint64_t pass, std::uint64_t n);

    /// The numbers of path i.
    [[nodiscard]] PathSampler sampler(std::uint64_t i) const {
        std::uint64_t const which =
            kind == ShotKind::Caustic ? stream::kCausticPhotons : stream::kGlobalPhotons;
        return PathSampler(job.light_sequence(), which, 0, first + i);
    }
    [[nodiscard]] bool keeps(Walk const& walk, bool caustic) const {
        switch (kind) {
            case ShotKind::Global:
                return true;
            case ShotKind::Caustic:
                return caustic;
            case ShotKind::Others:
                return !(caustic && sorts_caustics);
            case ShotKind::Indirect:
                break;
        }
        return walk.vertex > 0 && !(caustic && sorts_caustics);
    }
};

/// How a path ended: a member of PhotonCounts.
using End = std::uint64_t PhotonCounts::*;

/// The photon that a path leaves at a vertex.
PhotonRecord photon_of(PathContext const& c, Walk const& walk, Vertex const& v, std::uint32_t light,
                       bool caustic);

/// Path `i` of a shot, from its light to its end. `visit` is told where it goes: begins(ray), meets(point), lands(photon),
/// leaves(ray).
template <class Visit>
End follow_light(Shoot const& s, std::uint64_t i, std::uint32_t& light, RayStats& stats, Visit& visit) {
    PathSampler sampler = s.sampler(i);
    PathContext c{s.job, s.job.world(), s.lambda, sampler, stats};
    auto start = emit(c, s.aim, s.paths, &light);
    if (!start) return c.tainted ? &PhotonCounts::broken : &PhotonCounts::dark;
    Walk& walk = start->walk;
    visit.begins(walk.ray);
    Vertex v;
    Spectrum unseen;
    for (;;) {
        if (!advance(c, walk, EmissionWeight::None, v, unseen)) {
            visit.leaves(walk.ray);
            return &PhotonCounts::escaped;
        }
        visit.meets(v.hit.s.p);
        if (!walk.beta.is_finite()) return &PhotonCounts::broken;
        // Light that an absorbing medium has swallowed to the last float is no photon.
        if (walk.beta.is_black() || !prepare(c, walk, v)) return &PhotonCounts::absorbed;
        bool const caustic = walk.vertex > 0 && walk.path_class.all_specular();
        if (!v.is.near_specular && s.keeps(walk, caustic)) visit.lands(photon_of(c, walk, v, light, caustic));
        if (walk.vertex >= s.max_depth) return &PhotonCounts::too_long;
        Spectrum const before = walk.beta;
        if (!scatter(c, walk, v)) return c.tainted ? &PhotonCounts::broken : &PhotonCounts::absorbed;
        // Here, before roulette: what was scattered by such a surface has landed, whatever would have become of it.
        if (s.kind == ShotKind::Caustic && !walk.path_class.all_specular()) return &PhotonCounts::landed;
        if (!survives_with_power(c, walk, before)) return &PhotonCounts::absorbed;
    }
}

}  // namespace nephroid
