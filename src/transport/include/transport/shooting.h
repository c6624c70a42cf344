// Shooting: the light paths of a pass, and the photons that they leave (Jensen 2001, chapter 5).
#pragma once

#include "transport/photon.h"
#include "transport/render_pass.h"

#include <optional>
#include <vector>

namespace nephroid {

/// Which paths are shot, and which of their photons are kept. Where there is a caustic map, paths are divided by what scatters them
/// first: those of the caustic shot (L S ...) can be aimed at mirrors and glass, and all light that went there is theirs; the others
/// have the rest (L D ...). So no light is found twice.
enum class ShotKind : std::uint8_t {
    Global,  // L (S|D)* D: every hit on a surface that is not (near-)specular, whether or not there is a caustic map
    Others,    // … of the paths that are not the caustic shot's
    Indirect,  // … and without direct light, L D: what is read where the camera looks
    Caustic    // L S+ D: the first such hit, of paths that were thrown there by specular surfaces alone
};

struct Shot {
    std::vector<Photon> photons;  // in the order of the paths
    /// L S+ D (S|D)* D, of a caustic shot: left by the share of its paths that goes on (PhotonPlan::onward). No caustics, so that they
    /// are for the global map.
    std::vector<Photon> further;
    std::vector<PhotonCounts> by_source;  // by World::light_sources()
    std::uint64_t paths = 0;
    RayStats rays;
};

/// The paths of pass i: a pure function of (world, settings, seed, i), the same on any number of threads. Nothing when stopped.
std::optional<Shot> shoot(RenderJob const& job, ShotKind kind, std::uint64_t pass, std::uint64_t paths,
                          PrepareControl const& control);

/// The numbers of this pass are those of none that is rendered: what is to be known beforehand is shot in it.
inline constexpr std::uint64_t kPilotPass = std::uint64_t{1} << 40;
/// Photons that a path leaves, in the mean over the first so many of the pilot's; 0 where there is nothing to shoot.
struct PhotonsPerPath {
    double photons = 0, further = 0;  // as in a Shot
};
PhotonsPerPath photons_per_path(RenderJob const& job, ShotKind kind, std::uint64_t paths = 16384);
/// … and that the maps of a pass are going to hold, about.
double expected_photons(RenderJob const& job);

/// Which shot the global map of a job is made of, which has to shoot photons.
ShotKind global_shot(RenderJob const& job);
/// How many paths a pass of the job shoots into the global or the caustic map: 0 where it makes none.
std::uint64_t paths_of_pass(RenderJob const& job, ShotKind kind);

/// How a path ended: a member of PhotonCounts.
using End = std::uint64_t PhotonCounts::*;

/// One path of a shot, vertex by vertex, as pictures and files show them.
struct TracedPath {
    std::uint32_t light = 0;
    std::vector<Vec3> vertices;         // from the light on
    std::vector<PhotonRecord> photons;  // what it left
    std::vector<PhotonRecord> further;  // … where a caustic path went on
    End end = &PhotonCounts::dark;
};
TracedPath trace_light_path(RenderJob const& job, ShotKind kind, std::uint64_t pass, std::uint64_t path,
                            std::uint64_t paths);

}  // namespace nephroid
