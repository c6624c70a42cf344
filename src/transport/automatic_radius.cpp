// Radii of the first pass. A pilot shoots a few thousand paths, and photons of it are counted where the camera looks: r_k, the distance
// of the k-th nearest, tells how far apart they lie there, and since photons on surfaces grow as the squared radius, the radius that holds
// n of the m times as many photons of a pass is r_k sqrt(n / (k m)).
#include "light_walk.h"
#include "photon_plan.h"
#include "scene/match.h"
#include "transport/photon_map.h"
#include "transport/shooting.h"

#include <algorithm>
#include <vector>

namespace nephroid {

namespace {

constexpr std::uint64_t kPilotPaths = 16384;
constexpr std::uint32_t kNeighbours = 8;
constexpr int kLooks = 24;             // by as many, over the picture
constexpr std::size_t kMostAt = 2048;  // photons at which the caustic map is asked

struct Seen {
    std::vector<Vec3> places;       // the first surfaces that keep photons
    std::vector<float> footprints;  // of pixels there
};

Vec2 size_of(RenderJob const& job) {
    Vec2i const r = job.settings().film.resolution;
    return {static_cast<float>(r.x), static_cast<float>(r.y)};
}

/// Along a grid of pixels' centres, through whatever is specular.
Seen look_around(RenderJob const& job) {
    Seen seen;
    // The whole picture, whatever the crop window: a pixel is the same in either.
    Vec2 const size = size_of(job);
    RayStats uncounted;
    constexpr int kMostBounces = 16;
    for (int j = 0; j < kLooks; ++j)
        for (int i = 0; i < kLooks; ++i) {
            PathSampler sampler(job.sequence(), stream::kPilot, static_cast<std::uint64_t>(j * kLooks + i),
                                0);
            Vec2 const share{(static_cast<float>(i) + 0.5f) / kLooks,
                             (static_cast<float>(j) + 0.5f) / kLooks};
            Vec2 const film = share * size;
            PathContext c{job, job.world(), job.pass_wavelengths(0), sampler, uncounted};
            Walk walk = Walk::from_camera(c, job.camera().ray(film, {0.5f, 0.5f}).ray);
            Vertex v;
            Spectrum unseen;
            for (int bounce = 0; bounce < kMostBounces; ++bounce) {
                if (!advance(c, walk, EmissionWeight::None, v, unseen) || !prepare(c, walk, v)) break;
                if (!v.is.near_specular) {
                    seen.places.push_back(v.hit.s.p);
                    seen.footprints.push_back(job.camera().pixel_spread() * (walk.cone + v.hit.t));
                    break;
                }
                if (!scatter(c, walk, v)) break;
            }
        }
    return seen;
}

float median(std::vector<float> values) {
    if (values.empty()) return 0;
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The median distance of the k-th nearest photon, k being kNeighbours or the number of photons; 0 where there is none.
float spacing(PhotonMap const& map, std::vector<Vec3> const& places, std::uint32_t k) {
    NearestPhotons nearest;
    std::vector<float> distances;
    for (Vec3 const p : places) {
        map.nearest(p, k, kInfinity, nearest);
        float farthest = 0;
        for (FoundPhoton const& f : nearest.found) farthest = max(farthest, f.distance2);
        if (farthest > 0.0f) distances.push_back(std::sqrt(farthest));
    }
    return median(std::move(distances));
}

/// Caustics are bright in few places: they are asked about where they are, as far as the camera might see it.
std::vector<Vec3> where_photons_are(RenderJob const& job, PhotonMap const& map) {
    std::vector<Vec3> in_view, all;
    Vec2 const size = size_of(job);
    std::size_t const step = std::max<std::size_t>(1, map.size() / kMostAt);
    for (std::size_t i = 0; i < map.size(); i += step) {
        Vec3 const p = map[i].p();
        all.push_back(p);
        auto const raster = job.camera().project(p);
        if (raster && raster->x >= 0.0f && raster->x < size.x && raster->y >= 0.0f && raster->y < size.y)
            in_view.push_back(p);
    }
    return in_view.size() >= 32 ? in_view : all;
}

}  // namespace

void find_radii(RenderJob const& job, PhotonPlan& plan) {
    if (plan.global_radius > 0 && plan.caustic_radius > 0 && plan.further_radius > 0) return;
    int const nused = match(job.settings().integrator, [](auto const& i) {
        if constexpr (requires { i.estimates; }) return i.estimates.nused;
        return 0;
    });
    // All photons within a radius: some dozens of them, of which other sides and walls take a third. The nearest few: a bound that is
    // seldom reached.
    float const wanted = nused == 0 ? 32.0f : static_cast<float>(nused);
    float const room = nused == 0 ? 1.0f : 4.0f;
    Bounds3 const& b = job.world().bounds();
    float const size = length(b.hi - b.lo);
    Seen const seen = look_around(job);
    // No finer than what a pixel shows.
    float const least = median(seen.footprints);
    // A share of the paths of a pass. Where photons of both kinds lie in one map, it has to be the same of either.
    auto const share_of = [](std::uint64_t paths) {
        return paths > kPilotPaths ? static_cast<double>(kPilotPaths) / static_cast<double>(paths) : 1.0;
    };
    bool const in_one = plan.further_in_global || plan.caustics_in_global;
    std::uint64_t const most = std::max(plan.global_paths, plan.caustic_paths);
    double const global_share = share_of(in_one ? most : plan.global_paths);
    double const caustic_share = share_of(in_one ? most : plan.caustic_paths);
    auto const pilot = [&](ShotKind kind, std::uint64_t paths, double share) {
        auto const n = static_cast<std::uint64_t>(std::ceil(static_cast<double>(paths) * share - 1e-6));
        return std::move(*shoot(job, kind, kPilotPass, n, {}));
    };
    auto const radius = [&](std::vector<Photon> photons, double share, bool where_they_are) {
        float r = 0;
        if (!photons.empty()) {
            PhotonMap const map(std::move(photons));
            auto const k = static_cast<std::uint32_t>(std::min<std::size_t>(kNeighbours, map.size()));
            // A photon is not its own neighbour.
            std::uint32_t const self = where_they_are ? 1 : 0;
            r = spacing(map, where_they_are ? where_photons_are(job, map) : seen.places, k + self) *
                std::sqrt(wanted * static_cast<float>(share) / static_cast<float>(k));
        }
        if (!(r > 0.0f && std::isfinite(r))) r = std::isfinite(size) && size > 0 ? 0.01f * size : 1.0f;
        return max(r, least) * room;
    };
    Shot caustic = pilot(ShotKind::Caustic, plan.caustic_paths, caustic_share);
    if (!(plan.global_radius > 0)) {
        std::vector<Photon> photons = pilot(plan.global_kind, plan.global_paths, global_share).photons;
        if (plan.further_in_global)
            photons.insert(photons.end(), caustic.further.begin(), caustic.further.end());
        if (plan.caustics_in_global)
            photons.insert(photons.end(), caustic.photons.begin(), caustic.photons.end());
        plan.global_radius = radius(std::move(photons), global_share, false);
    }
    if (!(plan.further_radius > 0))
        plan.further_radius = radius(std::move(caustic.further), caustic_share, true);
    if (!(plan.caustic_radius > 0))
        plan.caustic_radius = plan.caustic_paths > 0 ? radius(std::move(caustic.photons), caustic_share, true)
                                                     : plan.global_radius;
}

}  // namespace nephroid
