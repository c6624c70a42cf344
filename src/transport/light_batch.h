// Light paths of a shot in step (docs/decisions/0011-vertices-in-lanes.md). Each is follow_light()'s, which is their definition.
#pragma once

#include "in_step.h"
#include "shoot.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace nephroid {

/// The photons of some paths, path by path, and how these ended, by source.
struct PhotonChunk {
    std::vector<Photon> photons, further;  // as a Shot's
    struct Path {
        std::uint32_t light = 0, stored = 0, further = 0;
        End end = &PhotonCounts::dark;
    };
    std::vector<Path> paths;
    RayStats rays;
};

class LightBatch {
  public:
    /// What is followed is added to `chunk`.
    LightBatch(Shoot const& shoot, PhotonChunk& chunk)
        : LightBatch(shoot, chunk, std::make_index_sequence<kMostInStep>{}) {}
    // Its paths know where its other parts are.
    LightBatch(LightBatch const&) = delete;
    LightBatch& operator=(LightBatch const&) = delete;

    /// Paths `first` to first + n - 1 of the shot; n is at most kMostInStep.
    void follow(std::uint64_t first, std::size_t n);

  private:
    template <std::size_t... I>
    LightBatch(Shoot const& s, PhotonChunk& chunk, std::index_sequence<I...>)
        : shoot_(s),
          chunk_(chunk),
          paths_{
              PathInFlight{{s.job, s.job.world(), s.lambda, samplers_[I], chunk.rays}, {}, {}, {}, {}}...} {
        for (std::size_t i = 0; i < kMostInStep; ++i) {
            paths_[i].c.path = static_cast<std::uint32_t>(i);
            paths_[i].v.drawn_ahead = true;
        }
    }
    /// Those that set off.
    Paths emit(std::size_t n);
    bool begin(PathInFlight& path, Ray const& ray, Spectrum power);
    /// Whether there is a surface that scatters.
    bool arrive(PathInFlight& path, bool in_lanes);
    void land(PathInFlight const& path);
    /// survives_with_power() of each.
    Paths survivors(Paths paths);
    /// Puts what landed in the order of the paths.
    void append_landed(std::size_t n);
    [[nodiscard]] PhotonChunk::Path& told(PathInFlight const& path) {
        return chunk_.paths[begun_ + path.c.path];
    }
    bool ends(PathInFlight const& path, End how) {
        told(path).end = how;
        return false;
    }

    /// A photon, and which path left it.
    struct Landed {
        std::uint32_t path;
        bool further;
        Photon photon;
    };

    Shoot const& shoot_;
    PhotonChunk& chunk_;
    std::size_t begun_ = 0;  // paths of the chunk before this batch
    std::array<PathSampler, kMostInStep> samplers_;
    std::array<PathInFlight, kMostInStep> paths_;
    std::array<PathInFlight*, kMostInStep> going_;
    std::array<Spectrum, kMostInStep> before_;  // beta before the last scattering
    std::vector<Landed> landed_;
};

}  // namespace nephroid
