// What stays the same over all passes of a photon integrator: how many paths are shot, whereto, and the radii of pass 0.
#pragma once

#include "aim.h"
#include "transport/render_pass.h"
#include "transport/shooting.h"

#include <memory>

namespace nephroid {

class PhotonPlan {
  public:
    Aim aim;                                      // of caustic paths
    std::uint64_t global_paths = 0;               // per pass
    std::uint64_t caustic_paths = 0;              // per pass; 0 where nothing casts caustics
    float global_radius = 0, caustic_radius = 0;  // of pass 0; scene units
    float further_radius = 0;                     // … where there is a map of Shot::further
    /// The global map is made of the photons of this shot …
    ShotKind global_kind = ShotKind::Global;
    /// … and of those that caustic paths leave further on, where it is to hold all light, or they weigh as much as the others. Else they
    /// have a map of their own: they may weigh a thousandth of the others, and lie so much closer.
    bool further_in_global = false;
    /// … and of the caustics themselves, where it is to hold all light.
    bool caustics_in_global = false;
    /// The share of caustic paths that go on where they have landed (onward.cpp); 0 where nobody asks for what they leave there.
    float onward = 0;

    /// r_i of pass i: r_1 shrinks as r^2_{i+1} = r^2_i (i + alpha) / (i + 1) (Knaus & Zwicker 2011, eq. 20), i counted from 1.
    [[nodiscard]] static float shrunk(float radius, float alpha, std::uint64_t pass);
};

/// Null where the settings' integrator shoots no photons. Radii that are not given are left 0.
std::shared_ptr<PhotonPlan> make_photon_plan(RenderJob const& job);

/// Sets the share of caustic paths that go on, where any do, to what is worth their time, and whether what they leave lies with the
/// others (onward.cpp): a pure function of the job, which has to have the plan already.
void find_onward(RenderJob const& job, PhotonPlan& plan);

/// Sets radii that are 0 to what suits the scene, by the pixels' footprints where the camera looks and by how far apart photons land
/// there (automatic_radius.cpp): a pure function of the job, which grows with the scene. The job has to have the plan already.
void find_radii(RenderJob const& job, PhotonPlan& plan);

}  // namespace nephroid
