#include "photon_plan.h"

#include "scene/match.h"
#include "transport/shooting.h"

#include <cmath>

namespace nephroid {

float PhotonPlan::shrunk(float radius, float alpha, std::uint64_t pass) {
    // prod over j = 1 … pass of (j + alpha) / (j + 1) = Gamma(pass + 1 + alpha) / (Gamma(1 + alpha) Gamma(pass + 2)).
    auto const n = static_cast<double>(pass);
    auto const a = static_cast<double>(alpha);
    // Far out the difference of the logarithms would be all rounding: Gamma(n + 1 + a) / Gamma(n + 2) is (n + 1 + a / 2)^(a - 1) there,
    // but for a share of 1 / n^2.
    constexpr double kFar = 1e4;
    double const log_ratio =
        n < kFar ? std::lgamma(n + 1 + a) - std::lgamma(n + 2) : (a - 1) * std::log(n + 1 + a / 2);
    double const log_square = log_ratio - std::lgamma(1 + a);
    return static_cast<float>(static_cast<double>(radius) * std::exp(0.5 * log_square));
}

namespace {

/// What the integrator's global map holds. Gather rays see all light that falls on surfaces, and so does who looks at photons; where
/// the map is read at what the camera sees, direct light is sampled, and caustics have their map.
template <class I>
void fill_global_map(I const& integrator, PhotonPlan& plan) {
    bool gathers = false;
    if constexpr (requires { integrator.final_gather; }) gathers = integrator.final_gather;
    PhotonView const view = integrator.visualize;
    bool const direct = gathers || view != PhotonView::None;
    plan.global_kind = direct ? ShotKind::Others : ShotKind::Indirect;
    // Who looks at caustics, or shoots nothing else, wants no other light.
    bool const caustics_alone = view == PhotonView::Caustic || plan.global_paths == 0;
    plan.onward = plan.caustic_paths > 0 && !caustics_alone ? 1.0f : 0.0f;
    plan.further_in_global = direct;
    plan.caustics_in_global =
        direct && view != PhotonView::Both && !(plan.caustic_paths > 0 && caustics_alone);
}

}  // namespace

std::shared_ptr<PhotonPlan> make_photon_plan(RenderJob const& job) {
    Settings const& s = job.settings();
    std::uint64_t const pixels =
        static_cast<std::uint64_t>(s.film.resolution.x) * static_cast<std::uint64_t>(s.film.resolution.y);
    return match(s.integrator, [&](auto const& i) -> std::shared_ptr<PhotonPlan> {
        if constexpr (requires { i.shooting; }) {
            auto plan = std::make_shared<PhotonPlan>();
            PhotonShooting const& shooting = i.shooting;
            auto const count = [](int n, std::uint64_t otherwise) {
                return n < 0 ? otherwise : static_cast<std::uint64_t>(n);
            };
            plan->global_paths = count(shooting.global_paths, pixels);
            plan->aim = Aim(job.world());
            plan->caustic_paths = plan->aim.casts() ? count(shooting.caustic_paths, plan->global_paths) : 0;
            float const given = i.estimates.radius, given_caustic = i.estimates.caustic_radius;
            plan->global_radius = plan->further_radius = given;
            plan->caustic_radius = given_caustic > 0 ? given_caustic : given;
            fill_global_map(i, *plan);
            return plan;
        } else {
            return nullptr;
        }
    });
}

ShotKind global_shot(RenderJob const& job) { return job.photon_plan()->global_kind; }

std::uint64_t paths_of_pass(RenderJob const& job, ShotKind kind) {
    PhotonPlan const* plan = job.photon_plan();
    if (!plan) return 0;
    return kind == ShotKind::Caustic ? plan->caustic_paths : plan->global_paths;
}

}  // namespace nephroid
