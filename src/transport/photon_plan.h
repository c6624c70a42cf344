// What stays the same over all passes of a photon integrator: how many paths are shot, whereto, and the radii of pass 0.
#pragma once

#include "aim.h"
#include "transport/render_pass.h"

#include <memory>

namespace nephroid {

class PhotonPlan {
  public:
    Aim aim;                                      // of caustic paths
    std::uint64_t global_paths = 0;               // per pass
    std::uint64_t caustic_paths = 0;              // per pass; 0 where nothing casts caustics
    float global_radius = 0, caustic_radius = 0;  // of pass 0; scene units

    /// r_i of pass i: r_1 shrinks as r^2_{i+1} = r^2_i (i + alpha) / (i + 1) (Knaus & Zwicker 2011, eq. 20), i counted from 1.
    [[nodiscard]] static float shrunk(float radius, float alpha, std::uint64_t pass);
};

/// Null where the settings' integrator shoots no photons.
std::shared_ptr<PhotonPlan const> make_photon_plan(RenderJob const& job);

/// Radii that suit the scene, from the pixels' footprints where the camera looks and from how far apart photons land there
/// (initial_radius.cpp). A pure function of the job; scale-free. `caustic`: of the caustic map.
float automatic_radius(RenderJob const& job, PhotonPlan const& plan, bool caustic);

}  // namespace nephroid
