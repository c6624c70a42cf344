// Photons before pixels: what each pass shoots, and keeps until its tiles are done.
#include "light_path_image.h"
#include "photon_maps.h"
#include "photon_plan.h"
#include "scene/match.h"
#include "transport/shooting.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace nephroid {

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

void add(std::vector<PhotonCounts>& a, std::vector<PhotonCounts> const& b) {
    if (a.size() < b.size()) a.resize(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) a[i].add(b[i]);
}

/// The rule for pass i: what shrinks is the radius, or the share of what the k-th gives.
EstimateRule rule_of(PhotonEstimates const& e, float first_radius, float alpha, std::uint64_t pass) {
    float const shrunk = PhotonPlan::shrunk(1.0f, alpha, pass);
    EstimateRule rule{e.kernel, static_cast<std::uint32_t>(e.nused), first_radius, 1, e.edge_correction};
    (rule.k == 0 ? rule.radius : rule.shrink) *= shrunk;
    return rule;
}

void append(std::vector<Photon>& to, std::vector<Photon> const& photons) {
    to.insert(to.end(), photons.begin(), photons.end());
}

/// All maps: shot, sorted out, and put in order.
bool make_maps(RenderJob const& job, std::uint64_t pass, PrepareControl const& control, PhotonMaps& maps,
               PhotonReport& report) {
    PhotonPlan const& plan = *job.photon_plan();
    auto const begun = Clock::now();
    auto global = shoot(job, plan.global_kind, pass, plan.global_paths, control);
    if (!global) return false;
    auto caustic = shoot(job, ShotKind::Caustic, pass, plan.caustic_paths, control);
    if (!caustic) return false;
    auto const shot_at = Clock::now();
    report.global = std::move(global->by_source);
    report.caustic = std::move(caustic->by_source);
    report.rays.add(global->rays);
    report.rays.add(caustic->rays);
    global->photons.reserve(global->photons.size() + (plan.further_in_global ? caustic->further.size() : 0) +
                            (plan.caustics_in_global ? caustic->photons.size() : 0));
    if (plan.further_in_global) append(global->photons, std::exchange(caustic->further, {}));
    if (plan.caustics_in_global) append(global->photons, caustic->photons);
    auto const map_of = [](std::vector<Photon> photons, EstimateRule const& rule) {
        return PhotonMap(std::move(photons), rule.k == 0 ? rule.radius : 0);
    };
    maps.global = map_of(std::move(global->photons), maps.global_rule);
    maps.further = map_of(std::move(caustic->further), maps.further_rule);
    maps.caustic = map_of(std::move(caustic->photons), maps.caustic_rule);
    report.shooting_seconds += std::chrono::duration<double>(shot_at - begun).count();
    report.building_seconds += since(shot_at);
    return true;
}

}  // namespace

void PhotonReport::add(PhotonReport const& b) {
    nephroid::add(global, b.global);
    nephroid::add(caustic, b.caustic);
    bytes = std::max(bytes, b.bytes);
    shooting_seconds += b.shooting_seconds;
    building_seconds += b.building_seconds;
    rays.add(b.rays);
}

std::optional<PassWork> prepare_pass(RenderJob const& job, std::uint64_t i, PrepareControl const& control) {
    std::optional<PassWork> work(std::in_place);
    if (std::holds_alternative<LightPathIntegrator>(job.settings().integrator)) {
        auto image = draw_light_paths(job, i, control, work->report.rays);
        if (!image) return std::nullopt;
        work->report.bytes = image->bytes();
        work->light_paths = std::make_shared<LightPathImage>(std::move(*image));
        return work;
    }
    PhotonPlan const* plan = job.photon_plan();
    if (!plan) return work;
    auto maps = std::make_shared<PhotonMaps>();
    bool const done = match(job.settings().integrator, [&](auto const& integrator) {
        if constexpr (requires { integrator.shooting; }) {
            maps->global_rule = rule_of(integrator.estimates, plan->global_radius, integrator.alpha, i);
            maps->caustic_rule = rule_of(integrator.estimates, plan->caustic_radius, integrator.alpha, i);
            maps->further_rule = rule_of(integrator.estimates, plan->further_radius, integrator.alpha, i);
            if (!make_maps(job, i, control, *maps, work->report)) return false;
            if (plan->caustics_in_global && plan->caustic_paths == 0 && plan->aim.casts()) {
                maps->caustics_from_global = true;
                maps->caustic_rule = maps->global_rule;
                maps->caustic_rule.only_caustics = true;
            }
            auto const begun = Clock::now();
            if constexpr (requires { integrator.final_gather; })
                if ((integrator.final_gather && integrator.visualize == PhotonView::None) ||
                    integrator.visualize == PhotonView::Radiance)
                    maps->irradiance =
                        IrradianceMap(job.world(), maps->global, maps->global_rule, work->report.rays);
            maps->shortest_gather = maps->irradiance.typical_radius();
            work->report.building_seconds += since(begun);
        }
        return true;
    });
    if (!done) return std::nullopt;
    work->report.bytes =
        maps->global.bytes() + maps->caustic.bytes() + maps->further.bytes() + maps->irradiance.bytes();
    work->photons = std::move(maps);
    return work;
}

}  // namespace nephroid
