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

/// The photon that a path leaves at a vertex.
PhotonRecord photon_of(PathContext const& c, Walk const& walk, Vertex const& v, std::uint32_t light,
                       bool caustic);

}  // namespace nephroid
