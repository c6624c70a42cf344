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
    bool divided;  // paths that begin specularly are the caustic shot's
    float onward;  // the share of its paths that go on where they have landed

    Shoot(RenderJob const& j, PhotonPlan const& p, ShotKind k, std::uint64_t pass, std::uint64_t n);

    /// The numbers of path i.
    [[nodiscard]] PathSampler sampler(std::uint64_t i) const {
        std::uint64_t const which =
            kind == ShotKind::Caustic ? stream::kCausticPhotons : stream::kGlobalPhotons;
        return PathSampler(job.light_sequence(), which, 0, first + i);
    }
    /// Whether the first surface is one at which a photon is left.
    [[nodiscard]] bool keeps_direct() const { return kind == ShotKind::Global || kind == ShotKind::Others; }
    /// Once the path was scattered: is it for this shot to follow?
    [[nodiscard]] bool follows(PathClass path) const {
        if (kind == ShotKind::Caustic) return path.began_specular();
        return !(divided && path.began_specular());
    }
    /// The chance to go on after a scattering, of paths that have not lost power by it.
    [[nodiscard]] float share_that_goes_on(PathClass path) const {
        return kind == ShotKind::Caustic && path.just_landed() ? onward : 1.0f;
    }
    /// Of a photon that is kept: is it one of Shot::further?
    [[nodiscard]] bool leaves_further(bool caustic) const { return kind == ShotKind::Caustic && !caustic; }
};

/// The photon that a path leaves at a vertex.
PhotonRecord photon_of(PathContext const& c, Walk const& walk, Vertex const& v, std::uint32_t light,
                       bool caustic);

}  // namespace nephroid
