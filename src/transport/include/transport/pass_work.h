// What a pass makes before its first pixel: photon maps, or the picture that light paths drew.
#pragma once

#include "world/hit.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace nephroid {

struct PhotonMaps;     // photon_maps.h
class LightPathImage;  // light_path_image.h

/// What became of the light paths of one light.
struct PhotonCounts {
    std::uint64_t emitted = 0;  // paths, whether or not their first ray carried anything
    std::uint64_t stored = 0;   // photons
    std::uint64_t further = 0;  // … and by caustic paths that went on (Shot::further)
    // How paths ended.
    std::uint64_t escaped = 0;    // left the scene
    std::uint64_t absorbed = 0;   // by chance (roulette), or where nothing is scattered
    std::uint64_t too_long = 0;   // at the limit of bounces
    std::uint64_t landed = 0;     // caustic paths: where they left a caustic, but for the share that goes on
    std::uint64_t elsewhere = 0;  // what would follow is found by the paths of the other shot
    std::uint64_t dark = 0;       // the light sent nothing that way
    std::uint64_t broken = 0;     // the power was not a number

    void add(PhotonCounts const& b) {
        emitted += b.emitted;
        stored += b.stored;
        further += b.further;
        escaped += b.escaped;
        absorbed += b.absorbed;
        too_long += b.too_long;
        landed += b.landed;
        elsewhere += b.elsewhere;
        dark += b.dark;
        broken += b.broken;
    }
};

/// Of the shots of one pass or of many.
struct PhotonReport {
    std::vector<PhotonCounts> global, caustic;  // by World::light_sources()
    std::uint64_t bytes = 0;                    // of the maps of a pass, at most
    double shooting_seconds = 0, building_seconds = 0;
    RayStats rays;

    void add(PhotonReport const& b);
};

/// Shared by the tiles of one pass. Empty for integrators that need nothing.
struct PassWork {
    std::shared_ptr<PhotonMaps const> photons;
    std::shared_ptr<LightPathImage const> light_paths;
    PhotonReport report;
};

/// How long work is watched.
struct PrepareControl {
    std::atomic<bool> const* stop = nullptr;  // set from outside: give up
    std::function<void(double)> on_progress;  // share done, from one thread at a time

    [[nodiscard]] bool stopped() const { return stop && stop->load(std::memory_order_relaxed); }
};

}  // namespace nephroid
